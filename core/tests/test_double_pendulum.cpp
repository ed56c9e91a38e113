#include <boost/test/unit_test.hpp>

#include "pendula/drive/fixed.hpp"
#include "pendula/method/rk4.hpp"
#include "pendula/system/double_pendulum.hpp"
#include "random.hpp"
#include "truth.hpp"

using pendula::double_pendulum;
using over = double_pendulum::over<double>;

namespace {

// Herrera et al. (2024), eqs. 49 and 50, the latter with l2 in the denominator.
std::array<double, 2> accelerations_as_printed(const double* p, const over::state& y) {
  const auto [m1, m2, l1, l2, g] = std::array<double, 5>{p[0], p[1], p[2], p[3], p[4]};
  const double d = y[0] - y[1], below = 15 * m2 + 8 * m1 - 9 * m2 * std::cos(2 * d);
  const double first = g * std::sin(y[1]) - l1 * y[2] * y[2] * std::sin(d);
  const double second = m2 * l2 * y[3] * y[3] * std::sin(d) + (m1 + 2 * m2) * g * std::sin(y[0]);
  return {(18 * m2 * std::cos(d) * first - 12 * second) / (l1 * below),
          (18 * std::cos(d) * second - 12 * (m1 + 3 * m2) * first) / (l2 * below)};
}

}  // namespace

BOOST_AUTO_TEST_CASE(rods_move_as_the_paper_says_once_corrected) {
  auto random = generator();
  std::uniform_real_distribution<double> size(0.3, 3.0), angle(-4.0, 4.0), speed(-6.0, 6.0);
  for (int i = 0; i < 1000; ++i) {
    const double p[] = {size(random), size(random), size(random), size(random), 3.0 * size(random)};
    const over::state y{angle(random), angle(random), speed(random), speed(random)};
    const auto rhs = double_pendulum::make<double>(0, p).rhs(0.0, y);
    const auto want = accelerations_as_printed(p, y);
    const double scale = 1.0 + std::fabs(want[0]) + std::fabs(want[1]);
    BOOST_TEST(std::fabs(rhs[2] - want[0]) < 1e-13 * scale);
    BOOST_TEST(std::fabs(rhs[3] - want[1]) < 1e-13 * scale);
  }
}

BOOST_AUTO_TEST_CASE(rods_and_bobs_are_bodies) {
  const double m1 = 1.3, m2 = 0.7, l1 = 0.9, l2 = 1.4, g = 9.81;
  const double rods[] = {m1, m2, l1, l2, g}, bobs[] = {m1, m2, l1, l2, g};
  const double as_rods[] = {m1, m2, l1, l1 / 2, l2 / 2, m1 * l1 * l1 / 12, m2 * l2 * l2 / 12, g, l2};
  const double as_bobs[] = {m1, m2, l1, l1, l2, 0.0, 0.0, g, l2};
  const auto agree = [](const over& a, const over& b) {
    const auto x = a.constants(), y = b.constants();
    for (std::size_t i = 0; i < x.size(); ++i)
      BOOST_TEST(std::fabs(x[i].value - y[i].value) < 1e-14 * std::fabs(x[i].value), x[i].name);
  };
  agree(double_pendulum::make<double>(0, rods), double_pendulum::make<double>(2, as_rods));
  agree(double_pendulum::make<double>(1, bobs), double_pendulum::make<double>(2, as_bobs));
}

BOOST_AUTO_TEST_CASE(a_light_upper_bob_loses_no_digits_of_the_determinant) {
  for (const double light : {0.03, 1e-3, 1e-9, 1e-15, 1e-100}) {
    const double p[] = {light, 0.7, 1.7, 1.9, 9.81};
    const auto system = double_pendulum::make<double>(1, p);
    // A B − C² = m1 m2 l1² l2² for bobs: the constants, rounded, have lost m1
    const truth::number want = truth::number(p[0]) * p[1] * p[2] * p[2] * p[3] * p[3];
    BOOST_TEST(truth::ulps(system.determinant_floor, want) < 4.0);
  }
}

// FLINT, 60 digits: uniform rods, m = l = 1, g = 9.81, from rest at (2, 2.5), at t = 5.
BOOST_AUTO_TEST_CASE(rk4_reaches_the_reference) {
  const double p[] = {1, 1, 1, 1, 9.81};
  const auto system = double_pendulum::make<double>(0, p);
  pendula::fixed_run<pendula::rk4, over> run(system, {2.0, 2.5, 0.0, 0.0}, 0.0, 1e-4, 100000);
  over::state at_five{};
  const pendula::fixed_output outputs[] = {{50000, 0.0}};
  run.through(outputs, [&](std::size_t, const over::state& y) { at_five = y; }, [](auto) { return true; });
  const double want[] = {0.205462239524980870, -7.52104212191582645, 1.68158668590311311, 11.7276651341110641};
  for (int i = 0; i < 4; ++i) BOOST_TEST(std::fabs(at_five[i] - want[i]) < 1e-9);
}
