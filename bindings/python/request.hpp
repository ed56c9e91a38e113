// Requests and faults as Python's objects.
#pragma once

#include <nanobind/nanobind.h>

#include "pendula/kernels/fault.hpp"

namespace pendula_python {

inline nanobind::str text(std::string_view s) { return nanobind::str(s.data(), s.size()); }

}  // namespace pendula_python
