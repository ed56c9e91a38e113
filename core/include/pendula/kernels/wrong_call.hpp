// What ends a call that no checked request makes.
#pragma once

#include <string>

#ifdef __cpp_exceptions
#include <stdexcept>
#endif

namespace pendula {

// Throws std::invalid_argument; where there are no exceptions, as in WebAssembly, it ends the program.
[[noreturn]] inline void wrong_call([[maybe_unused]] const std::string& what) {
#ifdef __cpp_exceptions
  throw std::invalid_argument(what);
#else
  __builtin_trap();
#endif
}

}  // namespace pendula
