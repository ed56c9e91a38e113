#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/ellint_rg.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <boost/test/unit_test.hpp>

#include "pendula/exact/elliptic.hpp"
#include "pendula/exact/incomplete_F.hpp"
#include "truth.hpp"

using pendula::jacobi_functions, pendula::modulus;
using truth::number, truth::ulps;

namespace {

number complement_of(double k) { return sqrt((1 - number(k)) * (1 + number(k))); }

}  // namespace

BOOST_AUTO_TEST_CASE(complete_integrals_agree_with_sixty_digits) {
  for (double k : {0.0, 1e-9, 0.1, 0.5, 0.7, 0.9, 0.99, 0.999999, 1.0 - 1e-12, 1.0 - 0x1p-53}) {
    const auto m = modulus<double>::from_k(k);  // K = R_F(0, kc², 1), E = 2 R_G(0, kc², 1), DLMF 19.25.1
    const number kc = complement_of(k), y = kc * kc;
    BOOST_TEST(ulps(complete_K(m), boost::math::ellint_rf(number(0), y, number(1))) < pendula::complete_ulps, k);
    BOOST_TEST(ulps(complete_E(m), 2 * boost::math::ellint_rg(number(0), y, number(1))) < pendula::complete_ulps, k);
  }
}

BOOST_AUTO_TEST_CASE(K_from_a_tiny_complement) {  // K = ln(4/kc) + O(kc²), DLMF 19.12.1
  for (double kc : {1e-40, 1e-100, 1e-300})
    BOOST_TEST(ulps(complete_K(modulus<double>::from_kc(kc)), log(number(4)) - log(number(kc))) < 1.0, kc);
  BOOST_TEST(std::isinf(complete_K(modulus<double>::from_kc(0.0))));
}

BOOST_AUTO_TEST_CASE(K_by_its_series_converges_to_the_mean) {
  for (double k : {0.05, 0.3, 0.7, 0.95}) {
    const double K = complete_K(modulus<double>::from_k(k));
    BOOST_TEST(std::fabs(pendula::complete_elliptic_K_series(k, 100000) / K - 1.0) < 5e-15, k);
  }
  // one term is π/2, two terms π/2 (1 + k²/4)
  BOOST_TEST(pendula::complete_elliptic_K_series(0.6, 1) == std::numbers::pi / 2);
  BOOST_TEST(std::fabs(pendula::complete_elliptic_K_series(0.6, 2) - std::numbers::pi / 2 * 1.09) < 1e-15);
}

BOOST_AUTO_TEST_CASE(jacobi_functions_agree_with_sixty_digits) {
  for (double k : {0.1, 0.5, 0.9, 0.96, 0.999}) {
    const jacobi_functions<double> of(modulus<double>::from_k(k));
    for (double u = -30.0; u <= 30.0; u += 2.37) {
      const auto got = of(u);
      number cn, dn;
      const number sn = boost::math::jacobi_elliptic(number(k), number(u), &cn, &dn);
      const auto close = [](double value, const number& want) {
        const number scale = abs(want) < pendula::jacobi_floor ? number(pendula::jacobi_floor) : number(abs(want));
        return abs(value - want) < pendula::jacobi_epsilons * 0x1p-52 * scale;
      };
      BOOST_TEST(close(got.sn, sn), "sn " << k << " " << u);
      BOOST_TEST(close(got.cn, cn), "cn " << k << " " << u);
      BOOST_TEST(ulps(got.dn, dn) < pendula::jacobi_ulps, "dn " << k << " " << u);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_amplitude_counts_its_turns_and_inverts_F) {
  const auto m = modulus<double>::from_k(0.8);
  const double K = complete_K(m);
  for (int n = -5; n <= 5; ++n)
    BOOST_TEST(std::fabs(jacobi_functions<double>(m)(n * 2.0 * K).am - n * std::numbers::pi) < 1e-14, n);
  for (double phi : {0.3, -2.0, 40.0})
    BOOST_TEST(std::fabs(jacobi_functions<double>(m)(incomplete_F(phi, m)).am / phi - 1.0) < 2e-15, phi);
}

BOOST_AUTO_TEST_CASE(at_modulus_one_they_are_hyperbolic) {
  const auto [am, sn, cn, dn] = jacobi_functions<double>(modulus<double>::from_k(1.0))(0.7);
  BOOST_TEST(ulps(sn, tanh(number(0.7))) < 1.5);
  BOOST_TEST(ulps(cn, 1 / cosh(number(0.7))) < 1.5);
  BOOST_TEST(dn == cn);
  BOOST_TEST(std::fabs(std::sin(am) - sn) < 1e-15);
}
