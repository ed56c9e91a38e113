/** What a pool and its workers say to one another. */
import type { Calls, Fault } from "./api";

/** To a worker: the module, once; then one question at a time. */
export type ToWorker =
  | { readonly kind: "open"; readonly module: WebAssembly.Module }
  | {
      readonly kind: "call";
      readonly id: number;
      readonly name: keyof Calls;
      readonly arguments_: readonly unknown[];
    };

/** From a worker. After "trapped" it answers no more. */
export type FromWorker =
  | { readonly kind: "ready" }
  | { readonly kind: "answer"; readonly id: number; readonly value: unknown }
  | { readonly kind: "refused"; readonly id: number; readonly fault: Fault }
  | { readonly kind: "failed"; readonly id: number; readonly message: string }
  | { readonly kind: "trapped"; readonly message: string };
