"""Run a WebAssembly program in the current folder, which it can read, and end with its exit code.

Usage: python scripts/run_wasm.py PROGRAM [ARGUMENT...]
"""

from __future__ import annotations

import sys

import wasmtime


def main(arguments: list[str]) -> int:
    """The exit code of the program."""
    engine = wasmtime.Engine()
    store, linker = wasmtime.Store(engine), wasmtime.Linker(engine)
    settings = wasmtime.WasiConfig()
    settings.argv = arguments
    settings.inherit_stdout()
    settings.inherit_stderr()
    settings.preopen_dir(".", ".")
    store.set_wasi(settings)
    linker.define_wasi()
    program = linker.instantiate(store, wasmtime.Module.from_file(engine, arguments[0]))
    try:
        program.exports(store)["_start"](store)
    except wasmtime.ExitTrap as ended:
        return ended.code
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
