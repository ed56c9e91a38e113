// Numbers of many words against Boost's, and the search for a parting against motions whose parting is known.
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/test/unit_test.hpp>

#include "pendula/drive/divergence.hpp"
#include "pendula/kernels/shadow_kernels.hpp"
#include "pendula/scalar/compensated.hpp"
#include "pendula/scalar/long_sincos.hpp"
#include "random.hpp"

using namespace pendula;

namespace {

using number = long_number<5>;
using exact = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<300>, boost::multiprecision::et_off>;

exact exactly(const number& x) {
  exact sum = 0;
  for (int i = 0; i < 5; ++i) sum += ldexp(exact(x.digit[i]), static_cast<int>(64 * (x.exponent - 1 - i)));
  return x.sign == 0 ? exact(0) : x.sign < 0 ? exact(-sum) : sum;
}

struct random_numbers {
  std::mt19937_64 from = generator();
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(from); }
};

// In units of 2^-bits of the size.
double error(const number& got, const exact& want, const exact& size) {
  return ldexp(abs(exact(exactly(got) - want)) / size, number::bits).convert_to<double>();
}

// Of words of all kinds: with long rows of ones and of zeros, for the carries.
number random_number(random_numbers& random) {
  number x(0.0);
  for (int part = 0; part < 6; ++part)
    x = x + number(random.between(-1.0, 1.0)) * number(std::ldexp(1.0, -static_cast<int>(random.between(0.0, 300.0))));
  return x * number(std::ldexp(1.0, static_cast<int>(random.between(-200.0, 200.0))));
}

// The shadow of a pendulum that hangs still, in steps of 0.3.
struct at_rest : pendula::shadow {
  double end = 0.3;
  void proceed() override { end += 0.3; }
  pendula::two_doubles step_end() const override { return {end, 0.0}; }
  void angles(pendula::two_doubles time, pendula::two_doubles* to) const override {
    BOOST_TEST(time.head <= end + 1e-12);
    BOOST_TEST(time.head >= end - 0.3 - 1e-12);
    to[0] = to[1] = {0.0, 0.0};
  }
};

using detector = divergence_detector<pendula::shadow>;

// A step of 0.5 of a run whose second angle is that function of time.
struct prescribed_step {
  double (*angle)(double);
  double begin = 0.0;

  pendula::two_doubles start() const { return {begin, 0.0}; }
  double stop() const { return 0.5; }
  void angles(double tau, double* to) const {
    to[0] = 0.0;
    to[1] = angle(begin + tau);
  }
};

double divergence_of(double (*angle)(double), double tolerance) {
  at_rest beside;
  const detector::poll always = [](double) { return true; };
  detector diverging(beside, 2, tolerance, 1.0, always);
  for (prescribed_step step{angle}; step.begin < 20.0; step.begin += 0.5)
    if (const double right = diverging.right_in_step(step); right != 0.5) return step.begin + right;
  return -1.0;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_shadow_that_stands_still_or_is_stopped_is_not_waited_for) {
  struct : at_rest {
    void proceed() override {}
  } stuck;
  at_rest beside;
  const detector::poll always = [](double) { return true; }, never = [](double) { return false; };
  const std::array<double, 2> still{};
  detector from_stuck(stuck, 2, 1.0, 1.0, always), stopped(beside, 2, 1.0, 1.0, never);
  BOOST_TEST(from_stuck.right(wide<double>(0.2), still));
  BOOST_TEST(!from_stuck.right(wide<double>(1e9), still));
  BOOST_TEST(!from_stuck.stopped());
  BOOST_TEST(!stopped.right(wide<double>(1e9), still));
  BOOST_TEST(stopped.stopped());
  BOOST_TEST(!from_stuck.right(wide<double>(0.2), std::array<double, 2>{std::nan("")}));
}

BOOST_AUTO_TEST_CASE(doubles_go_into_long_numbers_and_back) {
  random_numbers random;
  for (int i = 0; i < 10000; ++i) {
    const double x = std::ldexp(random.between(-1.0, 1.0), static_cast<int>(random.between(-900.0, 900.0)));
    BOOST_TEST(number(x).rounded() == x);
    BOOST_TEST(std::fabs(number(x).rough_log2() - std::log2(std::fabs(x))) < 1e-3);
  }
  for (const double x : {0.0, 1.0, -1.0, 0x1p-1074, 0x1.fffffffffffffp+1023, 0x1p64, 0x1p-64, 0x1.fffffffffffffp+63})
    BOOST_TEST(number(x).rounded() == x);
}

BOOST_AUTO_TEST_CASE(long_numbers_are_right_to_all_but_their_last_units) {
  random_numbers random;
  for (int i = 0; i < 3000; ++i) {
    const number a = random_number(random), b = random_number(random);
    const exact x = exactly(a), y = exactly(b), larger = abs(x) > abs(y) ? abs(x) : abs(y);
    BOOST_TEST(error(a + b, x + y, larger) < 2.0);
    BOOST_TEST(error(a - b, x - y, larger) < 2.0);
    BOOST_TEST(error(a * b, x * y, abs(x * y)) < 6.0);
    BOOST_TEST(error(a / b, x / y, abs(x / y)) < 24.0);
    BOOST_TEST((a - a).sign == 0);
    // all but some last words cancel
    const number c = a * number(1.0 + std::ldexp(1.0, -static_cast<int>(random.between(0.0, 52.0))));
    BOOST_TEST(error(c - a, exactly(c) - x, abs(x)) < 2.0);
  }
}

BOOST_AUTO_TEST_CASE(long_sines_keep_their_digits) {
  random_numbers random;
  for (int i = 0; i < 300; ++i) {
    const number x =
        number(std::ldexp(random.between(-1.0, 1.0), static_cast<int>(random.between(-100.0, 20.0)))) / number(3.0);
    const auto [s, c] = sincos(x);
    const exact angle = exactly(x), size = abs(angle) > 1 ? abs(angle) : exact(1);
    BOOST_TEST(error(s, sin(angle), abs(angle) > 1 ? size : abs(angle)) < 40.0);
    BOOST_TEST(error(c, cos(angle), size) < 40.0);
  }
}

BOOST_AUTO_TEST_CASE(a_divergence_is_found_where_it_is) {
  const auto growing = [](double t) { return 1e-16 * std::exp(2.0 * t); };
  for (const double tolerance : {1e-12, 1e-6, 1e-3, 1.0})
    BOOST_TEST(std::fabs(divergence_of(growing, tolerance) - 0.5 * std::log(tolerance / 1e-16)) < 1e-9);
  // shorter than a step, and back again before its end
  const auto bump = [](double t) { return std::exp(-200.0 * (t - 7.23) * (t - 7.23)); };
  BOOST_TEST(std::fabs(divergence_of(bump, 0.5) - (7.23 - std::sqrt(std::log(2.0) / 200.0))) < 1e-9);
  BOOST_TEST(divergence_of([](double t) { return t > 3.7 ? __builtin_nan("") : 0.0; }, 0.5) > 3.69);
  BOOST_TEST(divergence_of([](double) { return 0.1; }, 0.5) == -1.0);
}
