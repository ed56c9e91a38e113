// Variations of the double pendulum in lanes, and what is made of them.
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "pendula/exact/many_digits.hpp"
#include "pendula/system/double_pendulum.hpp"
#include "random.hpp"
#include "variation_bits.hpp"

using namespace pendula;

namespace {

// The state at the end of the plain run, of the trajectory n of the feed.
vec<double, 4> plain_end(std::size_t n, double end) {
  using Sys = double_pendulum::over<double>;
  taylor_stepper<Sys> stepper(double_pendulum::make<double>(0, varied_parameters), -52.0);
  stepper.start(0.0, varied_feed::start_of(n));
  vec<double, 4> last{};
  struct keep {
    vec<double, 4>& last;
    bool step(const adaptive_run<taylor_stepper<Sys>>& run, double stop) {
      last = run.stepper().state_of(run.stepper().after(stop));
      return true;
    }
    void event(const adaptive_run<taylor_stepper<Sys>>&, int, double) {}
  };
  adaptive_run<taylor_stepper<Sys>>(stepper, 0.0, end).to_end(1 << 20, keep{last}, [](double, auto) { return true; });
  return last;
}

template <int n, variation_use use>
void the_same_in_all_lanes() {
  const auto one = varied_runs<double, n, use>(), two = varied_runs<pack<double, 2>, n, use>(),
             eight = varied_runs<pack<double, 8>, n, use>();
  BOOST_TEST((one == two));
  BOOST_TEST((one == eight));
}

}  // namespace

BOOST_AUTO_TEST_CASE(lanes_of_variations_have_the_bits_of_one) {
  the_same_in_all_lanes<1, variation_use::free>();
  the_same_in_all_lanes<2, variation_use::free>();
  the_same_in_all_lanes<4, variation_use::free>();
  the_same_in_all_lanes<1, variation_use::megno>();
  the_same_in_all_lanes<4, variation_use::orthogonal>();
}

BOOST_AUTO_TEST_CASE(the_motion_has_the_bits_of_the_plain_run) {
  const auto told = varied_runs<pack<double, 4>, 1, variation_use::megno>();
  constexpr std::size_t size = varied_output<1, variation_use::megno>;
  for (std::size_t n = 0; n < varied_feed::count; ++n) {
    const auto plain = plain_end(n, varied_times[3]);
    for (std::size_t i = 0; i < 4; ++i) BOOST_TEST(told[n][3 * size + i] == plain[i]);
  }
}

BOOST_AUTO_TEST_CASE(a_variation_does_not_depend_on_those_beside_it) {
  const auto first = varied_runs<pack<double, 4>, 1, variation_use::free>(),
             four = varied_runs<pack<double, 4>, 4, variation_use::free>();
  for (std::size_t n = 0; n < varied_feed::count; ++n)
    for (std::size_t i = 0; i < 9; ++i) BOOST_TEST(first[n][3 * 9 + i] == four[n][3 * 24 + i]);
}

BOOST_AUTO_TEST_CASE(by_hand_they_are_those_of_numbers_that_carry_derivatives) {
  const auto told = varied_runs<pack<double, 2>, 4, variation_use::free>();
  using number = dual<4>;
  using Sys = double_pendulum::over<number>;
  for (std::size_t n = 0; n < varied_feed::count; ++n) {
    std::vector<number> parameters(std::begin(varied_parameters), std::end(varied_parameters));
    taylor_stepper<Sys> stepper(double_pendulum::make<number>(0, parameters.data()), -52.0);
    Sys::state start;
    for (int i = 0; i < 4; ++i) {
      start[i] = number(varied_feed::start_of(n)[i]);
      for (int column = 0; column < 4; ++column) start[i].change.set(column, i == column ? 1.0 : 0.25);
    }
    stepper.start(number(0.0), start);
    struct compare {
      const std::vector<double>& told;
      bool step(const adaptive_run<taylor_stepper<Sys>>& run, const number& stop) {
        const number tau = run.since_step(varied_times[1]);
        if (tau.value > stop.value || tau.value < 0.0) return true;
        const auto y = run.stepper().state_of(run.stepper().after(tau));
        double size = 0.0;
        for (const number& x : y)
          for (int column = 0; column < 4; ++column) size = std::max(size, std::fabs(x.change[column]));
        for (int i = 0; i < 4; ++i)
          for (int column = 0; column < 4; ++column)
            BOOST_TEST(std::fabs(told[24 + 4 + 5 * column + i] - y[i].change[column]) < 2e-13 * size);
        return true;
      }
      void event(const adaptive_run<taylor_stepper<Sys>>&, int, const number&) {}
    };
    adaptive_run<taylor_stepper<Sys>>(stepper, 0.0, varied_times[1])
        .to_end(1 << 20, compare{told[n]}, [](double, auto) { return true; });
  }
}

BOOST_AUTO_TEST_CASE(made_orthogonal_they_span_the_same_volumes) {
  const auto free = varied_runs<pack<double, 2>, 4, variation_use::free>(),
             orthogonal = varied_runs<pack<double, 2>, 4, variation_use::orthogonal>();
  for (std::size_t n = 0; n < varied_feed::count; ++n)
    for (const std::size_t place : {0u, 1u, 2u, 3u}) {
      const double* const of_free = free[n].data() + 24 * place;
      const double* const of_orthogonal = orthogonal[n].data() + 24 * place;
      double square = 0.0, at_start = 0.0;
      for (std::size_t i = 0; i < 4; ++i) square += of_free[4 + i] * of_free[4 + i];
      for (std::size_t i = 0; i < 4; ++i) at_start += i == 0 ? 1.0 : 0.0625;
      const double grown = 0.5 * std::log(square / at_start) + of_free[8] * std::log(taken_off);
      BOOST_TEST(std::fabs(of_orthogonal[8] - grown) < 1e-11);
      double sum = 0.0;  // of all four: the flow keeps volumes in canonical variables, which (θ, ω) are but for det M
      for (std::size_t i = 0; i < 4; ++i) sum += of_orthogonal[8 + 5 * i];
      BOOST_TEST(std::fabs(sum) < 2.0);
    }
}

BOOST_AUTO_TEST_CASE(the_logarithm) {
  std::mt19937_64 random = generator();
  std::uniform_real_distribution<double> exponents(-1020.0, 1020.0), near_one(0.5, 2.0);
  double worst = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const double x = i % 2 == 0 ? std::exp2(exponents(random)) : near_one(random);
    const long double want = std::log(static_cast<long double>(x));
    const double found = logarithm(x);
    const double unit = std::nextafter(std::fabs(found), HUGE_VAL) - std::fabs(found);
    worst = std::max(worst, static_cast<double>(std::fabs(found - want)) / unit);
  }
  BOOST_TEST(worst < 1.0);
  BOOST_TEST(logarithm(1.0) == 0.0);
}

BOOST_AUTO_TEST_CASE(gauss_with_eight_nodes) {
  for (int power = 0; power < 16; ++power) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 8; ++i) sum += gauss_8.weight[i] * std::pow(gauss_8.node[i], power);
    BOOST_TEST(std::fabs(sum - 1.0 / (power + 1)) < 1e-15);
    for (std::size_t i = 0; i < 8 && power < 8; ++i) {
      double up_to = 0.0;
      for (std::size_t j = 0; j < 8; ++j) up_to += gauss_8.up_to[i][j] * std::pow(gauss_8.node[j], power);
      BOOST_TEST(std::fabs(up_to - std::pow(gauss_8.node[i], power + 1) / (power + 1)) < 1e-15);
    }
  }
}

BOOST_AUTO_TEST_CASE(megno_of_a_growth_that_is_known) {
  // L = ln(1 + t): Y = 2 ((1 + t) ln(1 + t) − … )/t by hand, L t − I with I = (1 + t) ln(1 + t) − t
  megno_integrals<double> integrals;
  double t = 0.0;
  for (; t < 9.99; t += 0.1) {
    std::array<double, 8> growth;
    for (std::size_t i = 0; i < 8; ++i) growth[i] = std::log1p(t + 0.1 * gauss_8.node[i]);
    integrals = integrals.after(t, 0.1, growth);
  }
  const double I = (1.0 + t) * std::log1p(t) - t;
  BOOST_TEST(std::fabs(integrals.of_growth - I) < 1e-12);
  // ∫Y dt with Y = 2 (L − I/t) = 2 (1 − ln(1 + t)/t), by Simpson's rule with small steps
  const auto Y = [](double x) { return x == 0.0 ? 0.0 : 2.0 * (1.0 - std::log1p(x) / x); };
  double sum = 0.0;
  const int parts = 20000;
  for (int i = 0; i < parts; ++i) {
    const double a = t * i / parts, b = t * (i + 1) / parts;
    sum += (b - a) / 6.0 * (Y(a) + 4.0 * Y(0.5 * (a + b)) + Y(b));
  }
  BOOST_TEST(std::fabs(integrals.of_megno - sum) < 1e-11);
}
