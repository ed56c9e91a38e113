// The closed-form solutions and the elliptic functions, over arrays.
#include <nanobind/stl/tuple.h>

#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/ellint_rg.hpp>

#include "arrays.hpp"
#include "pendula/exact/elliptic.hpp"
#include "pendula/exact/linear.hpp"
#include "pendula/exact/simple.hpp"

using namespace pendula_python;
using namespace nb::literals;
using pendula::modulus;

namespace {

// Boost's default promotes to long double, which is slow and differs between machines; errors become values.
using boost_policy =
    boost::math::policies::policy<boost::math::policies::promote_double<false>,
                                  boost::math::policies::domain_error<boost::math::policies::errno_on_error>,
                                  boost::math::policies::overflow_error<boost::math::policies::errno_on_error>,
                                  boost::math::policies::evaluation_error<boost::math::policies::errno_on_error>>;

template <class Solution>
array_out trajectory(const Solution& solution, const array_in& t) {
  new_array states({t.shape(0), 2});
  for (std::size_t i = 0; i < t.shape(0); ++i) solution.at(t.data()[i], states.data[2 * i], states.data[2 * i + 1]);
  return states.array;
}

// f(modulus) over arrays of k and kc, which belong together.
template <class Function>
array_out over_moduli(const array_in& k, const array_in& kc, Function&& f) {
  new_array out({k.shape(0)});
  for (std::size_t i = 0; i < k.shape(0); ++i) out.data[i] = f(modulus{k.data()[i], kc.data()[i]});
  return out.array;
}

// E = 2 R_G(0, kc², 1), DLMF 19.25.1; where kc² is lost beside 1, its first terms, DLMF 19.12.2.
double complete_E(modulus m) {
  if (m.kc == 0.0) return 1.0;
  if (m.kc < 0x1p-30) return 1.0 + 0.5 * m.kc * m.kc * (std::log(4.0 / m.kc) - 0.5);
  return 2.0 * boost::math::ellint_rg(0.0, m.kc * m.kc, 1.0, boost_policy());
}

// F = 2 n K + sin φ R_F(cos² φ, cos² φ + kc² sin² φ, 1) with φ within half a turn of n π: DLMF 19.2.10, 19.25.5.
double incomplete_F(double phi, modulus m) {
  if (!std::isfinite(phi) || std::isnan(m.k)) return phi + m.k;
  const double n = std::nearbyint(phi / std::numbers::pi), r = phi - n * std::numbers::pi;
  const double s = std::sin(r), c = std::cos(r), y = c * c + m.kc * m.kc * s * s;
  const double periods = n == 0.0 ? 0.0 : 2.0 * n * pendula::complete_elliptic_K(m);
  return periods + s * boost::math::ellint_rf(c * c, y, 1.0, boost_policy());
}

array_out incomplete_F_array(const array_in& phi, const array_in& k, const array_in& kc) {
  new_array out({phi.shape(0)});
  for (std::size_t i = 0; i < phi.shape(0); ++i) out.data[i] = incomplete_F(phi.data()[i], {k.data()[i], kc.data()[i]});
  return out.array;
}

auto jacobi_arrays(const array_in& u, const array_in& k, const array_in& kc) {
  new_array am({u.shape(0)}), sn({u.shape(0)}), cn({u.shape(0)}), dn({u.shape(0)});
  for (std::size_t i = 0; i < u.shape(0); ++i) {
    const auto values = pendula::jacobi({k.data()[i], kc.data()[i]})(u.data()[i]);
    am.data[i] = values.am;
    sn.data[i] = values.sn;
    cn.data[i] = values.cn;
    dn.data[i] = values.dn;
  }
  return std::tuple(am.array, sn.array, cn.array, dn.array);
}

auto moduli_of_amplitudes(const array_in& amplitude) {
  new_array k({amplitude.shape(0)}), kc({amplitude.shape(0)});
  for (std::size_t i = 0; i < amplitude.shape(0); ++i) {
    const auto each = pendula::modulus_of_amplitude(amplitude.data()[i]);
    k.data[i] = each.k;
    kc.data[i] = each.kc;
  }
  return std::tuple(k.array, kc.array);
}

array_out exact_linear(double length, double gravity, double theta0, double omega0, const array_in& t) {
  return trajectory(pendula::exact_linear(length, gravity, theta0, omega0), t);
}

array_out exact_simple(double length, double gravity, double theta0, const array_in& t) {
  return trajectory(pendula::exact_simple(length, gravity, theta0), t);
}

array_out complete_K(const array_in& k, const array_in& kc) {
  return over_moduli(k, kc, [](modulus each) { return pendula::complete_elliptic_K(each); });
}

array_out complete_K_series(const array_in& k, long terms) {
  return over_moduli(k, k, [terms](modulus each) { return pendula::complete_elliptic_K_series(each.k, terms); });
}

array_out complete_E_array(const array_in& k, const array_in& kc) { return over_moduli(k, kc, complete_E); }

}  // namespace

void bind_exact(nb::module_& m) {
  m.def("exact_linear", &exact_linear, "length"_a, "gravity"_a, "theta0"_a, "omega0"_a, "t"_a,
        "States (n, 2) of the linear pendulum at times t after the start.");
  m.def("exact_simple", &exact_simple, "length"_a, "gravity"_a, "theta0"_a, "t"_a,
        "States (n, 2) of the simple pendulum at times t after its release from rest.");
  m.def("elliptic_K", &complete_K, "k"_a, "kc"_a, "K by the arithmetic-geometric mean.");
  m.def("elliptic_K_series", &complete_K_series, "k"_a, "terms"_a, "The first terms of the power series of K.");
  m.def("elliptic_E", &complete_E_array, "k"_a, "kc"_a, "The complete integral of the second kind.");
  m.def("elliptic_F", &incomplete_F_array, "phi"_a, "k"_a, "kc"_a, "The incomplete integral of the first kind.");
  m.def("jacobi", &jacobi_arrays, "u"_a, "k"_a, "kc"_a, "am, sn, cn and dn.");
  m.def("modulus_of_amplitude", &moduli_of_amplitudes, "amplitude"_a,
        "k = |sin(amplitude/2)| and kc = |cos(amplitude/2)|.");
}
