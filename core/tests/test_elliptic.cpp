#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <boost/test/unit_test.hpp>

#include "pendula/exact/elliptic.hpp"
#include "pendula/exact/simple.hpp"

using pendula::jacobi, pendula::modulus;

namespace {

// Boost without its promotion to long double, which would be slower and no better a check.
using policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

double in_epsilons(double got, double want) { return std::fabs(got - want) / (0x1p-52 * std::fabs(want)); }

}  // namespace

BOOST_AUTO_TEST_CASE(K_by_the_agm_agrees_with_boost) {
  for (double k : {0.0, 1e-9, 0.1, 0.5, 0.7, 0.9, 0.99, 0.999999, 1.0 - 1e-12, 1.0 - 0x1p-53}) {
    const auto m = modulus::from_k(k);  // K = R_F(0, kc², 1), DLMF 19.25.1
    const double want = boost::math::ellint_rf(0.0, m.kc * m.kc, 1.0, policy());
    BOOST_TEST(in_epsilons(pendula::complete_elliptic_K(m), want) < 3.0, k);
  }
}

BOOST_AUTO_TEST_CASE(K_from_a_tiny_complement) {  // K = ln(4/kc) + O(kc²), DLMF 19.12.1
  for (double kc : {1e-10, 1e-100, 1e-300})
    BOOST_TEST(in_epsilons(pendula::complete_elliptic_K(modulus::from_kc(kc)), std::log(4.0) - std::log(kc)) < 3.0, kc);
  BOOST_TEST(std::isinf(pendula::complete_elliptic_K(modulus::from_kc(0.0))));
}

BOOST_AUTO_TEST_CASE(K_by_its_series_converges_to_the_agm) {
  for (double k : {0.05, 0.3, 0.7, 0.95})
    BOOST_TEST(in_epsilons(pendula::complete_elliptic_K_series(k, 100000), boost::math::ellint_1(k, policy())) < 20.0,
               k);
  // one term is π/2, two terms π/2 (1 + k²/4)
  BOOST_TEST(pendula::complete_elliptic_K_series(0.6, 1) == std::numbers::pi / 2);
  BOOST_TEST(std::fabs(pendula::complete_elliptic_K_series(0.6, 2) - std::numbers::pi / 2 * 1.09) < 1e-15);
}

BOOST_AUTO_TEST_CASE(
    jacobi_functions_agree_with_boost) {  // which takes the modulus too; its dn loses digits where cn is small
  for (double k : {0.0, 0.1, 0.5, 0.9, 0.999}) {
    for (double u = -30.0; u <= 30.0; u += 0.37) {
      const auto got = jacobi(modulus::from_k(k))(u);
      double cn, dn;
      const double sn = boost::math::jacobi_elliptic(k, u, &cn, &dn, policy());
      BOOST_TEST(std::fabs(got.sn - sn) < 4e-14, "sn " << k << " " << u);
      BOOST_TEST(std::fabs(got.cn - cn) < 4e-14, "cn " << k << " " << u);
      BOOST_TEST(std::fabs(got.dn - dn) < 4e-12, "dn " << k << " " << u);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_amplitude_counts_its_turns) {
  const auto m = modulus::from_k(0.8);
  const double K = pendula::complete_elliptic_K(m);
  for (int n = -5; n <= 5; ++n) BOOST_TEST(std::fabs(jacobi(m)(n * 2.0 * K).am - n * std::numbers::pi) < 1e-13, n);
}

BOOST_AUTO_TEST_CASE(at_modulus_one_they_are_hyperbolic) {
  const auto [am, sn, cn, dn] = jacobi({1.0, 0.0})(0.7);
  BOOST_TEST(in_epsilons(sn, std::tanh(0.7)) < 2.0);
  BOOST_TEST(in_epsilons(cn, 1.0 / std::cosh(0.7)) < 2.0);
  BOOST_TEST(dn == cn);
  BOOST_TEST(std::fabs(std::sin(am) - sn) < 1e-15);
}

BOOST_AUTO_TEST_CASE(a_release_next_to_the_top_falls) {
  double theta = 0, omega = 0;
  const pendula::exact_simple released(1.0, 9.81, std::numbers::pi);  // the double π is below π
  const double K = pendula::complete_elliptic_K(pendula::modulus_of_amplitude(std::numbers::pi));
  released.at(K / std::sqrt(9.81), theta, omega);
  BOOST_TEST(std::fabs(theta) < 1e-12);
  BOOST_TEST(std::fabs(omega + 2.0 * std::sqrt(9.81)) < 1e-12);
}
