// What the core and the libraries find elsewhere in an operating system.
#include <boost/throw_exception.hpp>
#include <cstdarg>

#include "pendula/kernels/machine.hpp"

namespace pendula {

machine machine_here() { return machine::plain; }  // the one that there is: two lanes

}  // namespace pendula

// There are no exceptions. What would throw one, in Boost or for want of memory, ends the instance; its worker is
// replaced.
namespace boost {

BOOST_NORETURN void throw_exception(const std::exception&) { __builtin_trap(); }
BOOST_NORETURN void throw_exception(const std::exception&, const source_location&) { __builtin_trap(); }

}  // namespace boost

// libc++ would print why it ends the program, which needs most of stdio.
_LIBCPP_BEGIN_NAMESPACE_STD
[[noreturn]] void __libcpp_verbose_abort(const char*, ...) noexcept { __builtin_trap(); }
_LIBCPP_END_NAMESPACE_STD
