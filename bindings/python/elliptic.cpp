// The elliptic functions over arrays. A modulus is given as k or as its complement.
#include "pendula/exact/elliptic.hpp"

#include <nanobind/stl/tuple.h>

#include <algorithm>
#include <array>
#include <chrono>

#include "arrays.hpp"
#include "pendula/exact/incomplete_F.hpp"

using namespace pendula_python;
using namespace nb::literals;

namespace {

pendula::modulus<double> modulus_of(double given, bool complement) {
  return complement ? pendula::modulus<double>::from_kc(given) : pendula::modulus<double>::from_k(given);
}

// work(i) from 0 to count by steps, with the lock of the interpreter released, and a look at signals now and then.
template <class Work>
void in_blocks(std::size_t count, std::size_t step, Work&& work) {
  using clock = std::chrono::steady_clock;
  nb::gil_scoped_release released;
  auto looked = clock::now();
  for (std::size_t i = 0; i < count; i += step) {
    work(i);
    if (clock::now() - looked < std::chrono::milliseconds(100)) continue;
    looked = clock::now();
    nb::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
  }
}

// f(modulus, i) over an array of moduli.
template <class Function>
array_out over_moduli(const array_in& moduli, bool complement, Function&& f) {
  new_array out({moduli.shape(0)});
  in_blocks(moduli.shape(0), 1, [&](std::size_t i) { out.data[i] = f(modulus_of(moduli.data()[i], complement), i); });
  return out.array;
}

void check_lengths(const array_in& moduli, const array_in& other) {
  if (moduli.shape(0) != other.shape(0)) throw nb::value_error("as many moduli as arguments");
}

array_out K(const array_in& moduli, bool complement) {
  return over_moduli(moduli, complement, [](const auto& m, std::size_t) { return pendula::complete_K(m); });
}

array_out E(const array_in& moduli, bool complement) {
  return over_moduli(moduli, complement, [](const auto& m, std::size_t) { return pendula::complete_E(m); });
}

array_out F(const array_in& phi, const array_in& moduli, bool complement) {
  check_lengths(moduli, phi);
  return over_moduli(moduli, complement,
                     [&](const auto& m, std::size_t i) { return pendula::incomplete_F(phi.data()[i], m); });
}

array_out K_series(const array_in& moduli, bool complement, long terms) {
  return over_moduli(moduli, complement, [terms](const auto& m, std::size_t) {
    return pendula::complete_elliptic_K_series(pendula::rounded(m.k), terms);
  });
}

using S = pendula::pack<double, 4>;

// Four numbers from place i on; where fewer are left, the last one again.
S four_from(const double* from, std::size_t i, std::size_t count) {
  S x;
  for (std::size_t l = 0; l < 4; ++l) x.set(static_cast<int>(l), from[std::min(i + l, count - 1)]);
  return x;
}

auto jacobi(const array_in& u, const array_in& moduli, bool complement) {
  check_lengths(moduli, u);
  const std::size_t count = u.shape(0);
  std::array<new_array, 4> out{new_array({count}), new_array({count}), new_array({count}), new_array({count})};
  in_blocks(count, 4, [&](std::size_t i) {
    const S k = four_from(moduli.data(), i, count), argument = four_from(u.data(), i, count);
    const auto m = complement ? pendula::modulus<S>::from_kc(k) : pendula::modulus<S>::from_k(k);
    const auto [am, sn, cn, dn] = pendula::jacobi_functions<S>(m)(argument);
    const std::array values{am, sn, cn, dn};
    for (std::size_t which = 0; which < 4; ++which)
      for (std::size_t l = 0; l < std::min<std::size_t>(4, count - i); ++l)
        out[which].data[i + l] = values[which][static_cast<int>(l)];
  });
  return std::tuple(out[0].array, out[1].array, out[2].array, out[3].array);
}

}  // namespace

void bind_elliptic(nb::module_& m) {
  m.def("elliptic_K", &K, "moduli"_a, "complement"_a, "The complete integral of the first kind.");
  m.def("elliptic_E", &E, "moduli"_a, "complement"_a, "The complete integral of the second kind.");
  m.def("elliptic_F", &F, "phi"_a, "moduli"_a, "complement"_a, "The incomplete integral of the first kind.");
  m.def("elliptic_K_series", &K_series, "moduli"_a, "complement"_a, "terms"_a,
        "The first terms of the power series of K.");
  m.def("jacobi", &jacobi, "u"_a, "moduli"_a, "complement"_a, "am, sn, cn and dn.");
}
