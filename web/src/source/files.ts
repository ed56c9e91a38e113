// Where the page finds the core: files beside it; and who keeps them for when there is no server.

import wasm from "../../../build/wasm/lab.wasm?url";
import type { CoreSource } from "../core/api";
import CoreWorker from "../core/worker?worker";

export const source = (): CoreSource => ({
  module: fetch(wasm),
  worker: () => new CoreWorker(),
});

/** Has the page kept; where the browser keeps none it works with its server alone. */
export async function keepOffline(): Promise<void> {
  try {
    await navigator.serviceWorker?.register("./service_worker.js");
  } catch {} // a sandboxed frame, a private window
}
