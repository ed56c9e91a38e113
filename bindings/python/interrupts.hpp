// Checks Python's signals and reports progress while the core works.
#pragma once

#include <nanobind/nanobind.h>

#include "pendula/kernels/result.hpp"

namespace pendula_python {

// Signal handlers run here, and `progress` is called with the part that is done; either ends the work by raising. The
// caller has released the GIL.
inline pendula::watcher watching(nanobind::object progress) {
  return [progress = std::move(progress)](double done) {
    nanobind::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) return false;
    if (progress.is_none()) return true;
    const auto answer = nanobind::steal(PyObject_CallOneArg(progress.ptr(), nanobind::cast(done).ptr()));
    return answer.is_valid();
  };
}

}  // namespace pendula_python
