// Numpy arrays in and out.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

namespace pendula_python {

namespace nb = nanobind;

using array_in = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using matrix_in = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using array_out = nb::ndarray<nb::numpy, double>;
using integers_out = nb::ndarray<nb::numpy, std::int64_t>;

inline std::span<const double> span_of(const array_in& a) { return {a.data(), a.shape(0)}; }
inline std::span<const double> span_of(const matrix_in& a) { return {a.data(), a.shape(0) * a.shape(1)}; }

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

// The numbers of a bound object's field as an array, which keeps the object alive.
template <class Owner>
array_out view(const Owner& owner, const std::vector<double>& numbers, std::initializer_list<std::size_t> shape) {
  return {const_cast<double*>(numbers.data()), shape, nb::find(owner)};
}
template <class Owner>
integers_out view(const Owner& owner, const std::vector<std::int64_t>& numbers) {
  return {const_cast<std::int64_t*>(numbers.data()), {numbers.size()}, nb::find(owner)};
}

}  // namespace pendula_python
