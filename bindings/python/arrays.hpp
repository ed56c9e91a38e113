// Numpy arrays in and out.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <initializer_list>
#include <memory>

namespace pendula_python {

namespace nb = nanobind;

using array_in = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using matrix_in = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using array_out = nb::ndarray<nb::numpy, double>;

// An array of doubles that numpy owns; its memory is not initialised.
struct new_array {
  double* data;
  array_out array;

  explicit new_array(std::initializer_list<std::size_t> shape) {
    std::size_t count = 1;
    for (std::size_t extent : shape) count *= extent;
    auto memory = std::make_unique_for_overwrite<double[]>(count);
    data = memory.get();
    nb::capsule owner(memory.release(), [](void* p) noexcept { delete[] static_cast<double*>(p); });
    array = array_out(data, shape, owner);
  }
};

}  // namespace pendula_python
