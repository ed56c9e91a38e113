// Where the page in one file finds the core: within itself, as text.

import wasm from "../../../build/wasm/lab.wasm?inline";
import type { CoreSource } from "../core/api";
import CoreWorker from "../core/worker?worker&inline";

/** Bytes of a data address. */
function bytesOf(address: string): Uint8Array<ArrayBuffer> {
  const text = atob(address.slice(address.indexOf(",") + 1));
  return Uint8Array.from(text, (letter) => letter.charCodeAt(0));
}

export const source = (): CoreSource => ({
  module: bytesOf(wasm),
  worker: () => new CoreWorker(),
});

/** The file itself is what is kept. */
export async function keepOffline(): Promise<void> {}
