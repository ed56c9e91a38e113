// What long work looks up for: Python's signals, and whoever wants to know how far it is.
#pragma once

#include <nanobind/nanobind.h>

namespace pendula_python {

// Signal handlers run here, and progress is told; either ends the run by raising.
struct attendance {
  nanobind::object progress;

  template <class Measure>
  bool operator()(Measure done) const {
    nanobind::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) return false;
    if (progress.is_none()) return true;
    const auto answer = nanobind::steal(PyObject_CallOneArg(progress.ptr(), nanobind::cast(done).ptr()));
    return answer.is_valid();
  }
};

}  // namespace pendula_python
