# C++ to WebAssembly by the compiler in the Python package ziglang, which PENDULA_ZIG names.
set(CMAKE_SYSTEM_NAME WASI)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_CXX_COMPILER "${PENDULA_ZIG}" c++)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_CXX_COMPILER_FORCED TRUE)  # to try it would build another C++ library, without optimisation
