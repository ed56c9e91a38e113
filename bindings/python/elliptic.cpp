// The elliptic functions over arrays. A modulus is given as k or as its complement.
#include "pendula/exact/elliptic.hpp"

#include <nanobind/stl/tuple.h>

#include "arrays.hpp"
#include "pendula/exact/incomplete_F.hpp"

using namespace pendula_python;
using namespace nb::literals;

namespace {

pendula::modulus<double> modulus_of(double given, bool complement) {
  return complement ? pendula::modulus<double>::from_kc(given) : pendula::modulus<double>::from_k(given);
}

// f(modulus, i) over an array of moduli.
template <class Function>
array_out over_moduli(const array_in& moduli, bool complement, Function&& f) {
  new_array out({moduli.shape(0)});
  nb::gil_scoped_release released;
  for (std::size_t i = 0; i < moduli.shape(0); ++i) out.data[i] = f(modulus_of(moduli.data()[i], complement), i);
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

auto jacobi(const array_in& u, const array_in& moduli, bool complement) {
  check_lengths(moduli, u);
  new_array am({u.shape(0)}), sn({u.shape(0)}), cn({u.shape(0)}), dn({u.shape(0)});
  {
    nb::gil_scoped_release released;
    for (std::size_t i = 0; i < u.shape(0); ++i) {
      const auto values = pendula::jacobi_functions<double>(modulus_of(moduli.data()[i], complement))(u.data()[i]);
      am.data[i] = values.am;
      sn.data[i] = values.sn;
      cn.data[i] = values.cn;
      dn.data[i] = values.dn;
    }
  }
  return std::tuple(am.array, sn.array, cn.array, dn.array);
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
