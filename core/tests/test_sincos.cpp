#include <boost/math/constants/constants.hpp>
#include <boost/test/unit_test.hpp>

#include "pendula/scalar/sincos.hpp"
#include "random.hpp"
#include "truth.hpp"

using pendula::largest_angle, pendula::sincos;
using truth::number, truth::ulps, truth::unit_in_last_place;

namespace {

void check(double x) {
  const auto [s, c] = sincos(x);
  const auto within = [x](double got, const number& want) {
    return ulps(got, want) < pendula::sincos_ulps + std::fabs(x) * pendula::sincos_of_angle / unit_in_last_place(want);
  };
  BOOST_TEST(within(s, sin(number(x))), "sine of " << x << " is off by " << ulps(s, sin(number(x))) << " ulp");
  BOOST_TEST(within(c, cos(number(x))), "cosine of " << x << " is off by " << ulps(c, cos(number(x))) << " ulp");
}

}  // namespace

BOOST_AUTO_TEST_CASE(sincos_of_random_angles_of_every_size) {
  auto random = generator();
  std::uniform_real_distribution<double> exponent(-30.0, std::log2(largest_angle)), sign(-1.0, 1.0);
  for (int i = 0; i < 20000; ++i) check(std::copysign(std::exp2(exponent(random)), sign(random)));
}

BOOST_AUTO_TEST_CASE(sincos_of_small_angles) {
  auto random = generator();
  std::uniform_real_distribution<double> angle(-4.0, 4.0);
  for (int i = 0; i < 20000; ++i) check(angle(random));
}

BOOST_AUTO_TEST_CASE(sincos_next_to_multiples_of_a_quarter_turn) {
  const number half_pi = boost::math::constants::half_pi<number>();
  for (double n = 1; n * 1.5707963 < largest_angle; n = std::ceil(n * 1.07)) {
    const double nearest = (n * half_pi).convert_to<double>();
    check(nearest);
    check(std::nextafter(nearest, 0.0));
    check(-nearest);
  }
}

BOOST_AUTO_TEST_CASE(sincos_refuses_angles_beyond_its_range) {
  for (double x : {largest_angle, -largest_angle, 1e300, HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    BOOST_TEST(!std::isfinite(sincos(x).sin), x);
    BOOST_TEST(!std::isfinite(sincos(x).cos), x);
  }
  check(std::nextafter(largest_angle, 0.0));
}

BOOST_AUTO_TEST_CASE(one_minus_cos_keeps_the_digits_of_small_angles) {
  for (double x : {1e-12, -1e-7, 0.003, 0.5, 2.0, 3.1})
    BOOST_TEST(ulps(pendula::one_minus_cos(x), 2 * sin(number(x) / 2) * sin(number(x) / 2)) < 3.0, x);
}
