/** The worker's side: one instance, which answers one question after another. */
import { RefusedError } from "./api";
import { Instance } from "./instance";
import type { FromWorker, ToWorker } from "./messages";

const scope = globalThis as unknown as {
  onmessage: ((event: MessageEvent<ToWorker>) => void) | null;
  postMessage(message: FromWorker, transfer?: Transferable[]): void;
};

let instance: Instance | null = null;

scope.onmessage = async ({ data }) => {
  try {
    if (data.kind === "open") {
      instance = await Instance.open(data.module);
      scope.postMessage({ kind: "ready" });
      return;
    }
    const ask = instance?.[data.name] as (...values: readonly unknown[]) => unknown;
    const value = ask.apply(instance, data.arguments_ as unknown[]);
    scope.postMessage({ kind: "answer", id: data.id, value }, buffersIn(value));
  } catch (error) {
    scope.postMessage(told(error, data.kind === "call" ? data.id : null));
  }
};

function told(error: unknown, id: number | null): FromWorker {
  const message = error instanceof Error ? error.message : String(error);
  if (id === null || error instanceof WebAssembly.RuntimeError) return { kind: "trapped", message };
  if (error instanceof RefusedError) return { kind: "refused", id, fault: error.fault };
  return { kind: "failed", id, message };
}

/** The memory of all arrays in an answer, which is handed over and not copied. */
function buffersIn(value: unknown): ArrayBuffer[] {
  if (ArrayBuffer.isView(value)) return [value.buffer as ArrayBuffer];
  if (value === null || typeof value !== "object") return [];
  return Object.values(value).flatMap(buffersIn);
}
