#include <boost/math/constants/constants.hpp>
#include <boost/test/unit_test.hpp>

#include "pendula/scalar/arctangent.hpp"
#include "pendula/scalar/exponential.hpp"
#include "pendula/scalar/sincos_of_half_turns.hpp"
#include "pendula/scalar/wide_complex.hpp"
#include "pendula/scalar/wide_exponential.hpp"
#include "pendula/scalar/wide_sincos.hpp"
#include "random.hpp"
#include "truth.hpp"

using pendula::wide;
using truth::number, truth::ulps;

namespace {

number of(const wide<double>& x) { return number(x.hi) + x.lo; }

// |got − want| in parts of |scale|, as a power of two.
double log2_error(const wide<double>& got, const number& want, const number& scale) {
  const number error = abs((of(got) - want) / scale);
  return error == 0 ? -200.0 : log2(error).convert_to<double>();
}

struct randoms {
  std::mt19937_64 random = generator();
  double size(double lowest, double highest) {
    const double exponent = std::uniform_real_distribution<double>(lowest, highest)(random);
    return std::copysign(std::exp2(exponent), std::uniform_real_distribution<double>(-1.0, 1.0)(random));
  }
  wide<double> number_with_tail() {
    const double head = size(-20.0, 20.0);
    return wide<double>(pendula::fast_two_sum(head, head * size(-60.0, -53.0)));
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(arithmetic_of_wide_numbers_has_some_hundred_bits) {
  randoms some;
  for (int i = 0; i < 3000; ++i) {
    const auto a = some.number_with_tail(), b = some.number_with_tail();
    const number x = of(a), y = of(b), larger = abs(x) > abs(y) ? abs(x) : abs(y);
    BOOST_TEST(log2_error(a + b, x + y, x + y) < -104.0);
    BOOST_TEST(log2_error(quick_sum(a, b), x + y, larger) < -103.0);
    BOOST_TEST(log2_error(a * b, x * y, x * y) < -103.0);
    BOOST_TEST(log2_error(a / b, x / y, x / y) < -101.0);
    BOOST_TEST(log2_error(square(a), x * x, x * x) < -103.0);
    const wide<double> positive = a.hi > 0.0 ? a : -a;
    BOOST_TEST(log2_error(square_root(positive), sqrt(of(positive)), sqrt(of(positive))) < -101.0);
  }
}

BOOST_AUTO_TEST_CASE(wide_sine_and_cosine) {
  randoms some;
  const auto check = [](double x) {
    const auto [s, c] = pendula::wide_sincos(x);
    const double bound = std::log2(pendula::wide_sincos_error);
    BOOST_TEST(log2_error(s, sin(number(x)), sin(number(x))) < bound, "sine of " << x);
    BOOST_TEST(log2_error(c, cos(number(x)), cos(number(x))) < bound, "cosine of " << x);
  };
  for (int i = 0; i < 2000; ++i) check(some.size(-30.0, 12.99));
  const number half_pi = boost::math::constants::half_pi<number>();
  for (double n = 1; n < 32; ++n) check((n * half_pi).convert_to<double>());
}

BOOST_AUTO_TEST_CASE(sine_and_cosine_of_half_turns_keep_their_digits_next_to_zero) {
  randoms some;
  const number pi = boost::math::constants::pi<number>();
  for (int i = 0; i < 2000; ++i) {
    const double tail = some.size(-70.0, -56.0);
    const wide<double> r(
        pendula::fast_two_sum(i % 2 ? 0.5 - std::fabs(some.size(-40.0, -2.0)) : some.size(-40.0, -1.1), tail));
    const auto [s, c] = pendula::sincos_of_half_turns(r);
    BOOST_TEST(ulps(s, sin(number(pi * of(r)))) < 1.25);
    BOOST_TEST(ulps(c, cos(number(pi * of(r)))) < 1.25);
  }
}

BOOST_AUTO_TEST_CASE(the_exponential_and_its_distance_from_one) {
  randoms some;
  for (int i = 0; i < 2000; ++i) {
    const double x = -std::fabs(some.size(-40.0, 9.4));
    const auto [value, minus_one] = pendula::exponential(wide<double>(x));
    const number want = exp(number(x));
    BOOST_TEST(log2_error(value, want, want) < -54.0, x);
    BOOST_TEST(log2_error(minus_one, number(want - 1), number(want - 1)) < -53.0, x);
  }
  BOOST_TEST(pendula::exponential(wide<double>(-1e9)).value.hi < 1e-300);
}

BOOST_AUTO_TEST_CASE(wide_exponential_beyond_the_range_of_doubles) {
  randoms some;
  for (int i = 0; i < 3000; ++i) {
    const double head = some.size(-40.0, 14.2);
    const wide<double> x(head, head * some.size(-60.0, -54.0));
    const auto [mantissa, power] = pendula::wide_exponential(x);
    const number want = ldexp(exp(of(x)), -power);
    BOOST_TEST(log2_error(mantissa, want, want) < std::log2(pendula::wide_exponential_error), head);
    BOOST_TEST((mantissa.hi > 0.98 && mantissa.hi < 2.0));
  }
  BOOST_TEST(pendula::wide_exponential(wide<double>(0.0)).mantissa.hi == 1.0);
  BOOST_TEST(pendula::wide_exponential(wide<double>(-1e300)).power < -20000);
  BOOST_TEST(pendula::wide_exponential(wide<double>(1e300)).power > 20000);
}

BOOST_AUTO_TEST_CASE(directions_after_very_many_turns) {
  randoms some;
  const number pi = boost::math::constants::pi<number>();
  for (int i = 0; i < 2000; ++i) {
    const double head = std::fabs(some.size(-30.0, 10.0)), middle = head * some.size(-60.0, -54.0);
    const double rate[3] = {head, middle, middle * some.size(-60.0, -54.0)}, time = some.size(-30.0, 39.0);
    const wide<double> t(time, time * some.size(-60.0, -54.0));
    const auto [c, s] = pendula::direction_after(rate, t);
    const number phase = pi * (number(rate[0]) + rate[1] + rate[2]) * of(t);
    BOOST_TEST(log2_error(c, cos(phase), number(1)) < -99.0, head << " " << time);
    BOOST_TEST(log2_error(s, sin(phase), number(1)) < -99.0, head << " " << time);
  }
}

BOOST_AUTO_TEST_CASE(the_angle_of_a_point) {
  randoms some;
  for (int i = 0; i < 3000; ++i) {
    const double y = some.size(-12.0, 12.0), x = some.size(-12.0, 12.0);
    BOOST_TEST(ulps(pendula::angle_of(y, x), atan2(number(y), number(x))) < 1.5, y << " " << x);
  }
  BOOST_TEST(pendula::angle_of(0.0, 1.0) == 0.0);
  BOOST_TEST(pendula::angle_of(1.0, 0.0) == boost::math::constants::half_pi<double>());
  BOOST_TEST(pendula::angle_of(-1e-30, -1.0) == -boost::math::constants::pi<double>());
}
