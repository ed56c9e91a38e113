// Where the page finds the core: files beside it.

import wasm from "../../../build/wasm/lab.wasm?url";
import type { CoreSource } from "../core/api";
import CoreWorker from "../core/worker?worker";

export const source = (): CoreSource => ({
  module: fetch(wasm),
  worker: () => new CoreWorker(),
});
