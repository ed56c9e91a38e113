#include <boost/test/unit_test.hpp>

#include "pendula/catalog.hpp"
#include "pendula/drive/fixed.hpp"
#include "truth.hpp"

using namespace pendula;

namespace {

using lanes4 = pack<double, 4>;
const auto always = [](auto) { return true; };
const auto nowhere = [](std::size_t, const auto&) {};
constexpr double rods[] = {1.0, 1.0, 1.0, 1.0, 9.81};

template <std::size_t parts>
void check_sum(const std::array<double, (parts - 1) / 2>& outer, double h) {
  const std::array<double, parts> part = parts_of_step<parts>(h, outer);
  truth::number sum = 0;
  for (double each : part) sum += each;
  const bool long_middle = std::fabs(part[parts / 2]) > std::fabs(h);
  BOOST_TEST(abs(sum - truth::number(h)) <= (long_middle ? 0x1p-52 * std::fabs(h) : 0.0));
  for (std::size_t i = 0; i < outer.size(); ++i) {
    BOOST_TEST(part[i] == part[parts - 1 - i]);
    BOOST_TEST(std::fabs(part[i] / h - outer[i]) < 1e-15);
  }
}

// Collocation: Σ_j a_ij c_j^{k−1} = c_i^k / k for k up to the stages, with a_ij = μ_ij b_j; and Gauss' nodes make
// Σ b_i c_i^{k−1} = 1/k up to twice as many (Hairer, Lubich & Wanner 2006, II.1.2).
template <std::size_t stages>
void check_collocation(const collocation_table<stages>& table) {
  const auto b = parts_of_step<stages>(1.0, table.outer_weights);
  const auto mu = table.mu();
  for (std::size_t i = 0; i < stages; ++i) {
    for (std::size_t j = 0; j < stages; ++j)
      BOOST_TEST(truth::number(mu[i][j]) + truth::number(mu[j][i]) == truth::number(1));
    for (std::size_t k = 1; k <= stages; ++k) {
      double sum = 0.0;
      for (std::size_t j = 0; j < stages; ++j) sum += mu[i][j] * b[j] * std::pow(table.nodes[j], k - 1);
      BOOST_TEST(std::fabs(sum - std::pow(table.nodes[i], k) / k) < 4e-16, table.name);
    }
  }
  for (std::size_t k = 1; k <= 2 * stages; ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < stages; ++i) sum += b[i] * std::pow(table.nodes[i], k - 1);
    BOOST_TEST(std::fabs(sum - 1.0 / k) < 4e-16, table.name);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(parts_of_a_step_sum_to_it_exactly) {
  for (double h : {1.0, 0.1, -0.1, 1e-3 / 3.0, 12345.678}) {
    check_sum<1>(verlet_table.outer, h);
    check_sum<3>(yoshida4_table.outer, h);
    check_sum<7>(yoshida6_table.outer, h);
    check_sum<15>(yoshida8_table.outer, h);
    check_sum<3>(gauss6_table.outer_weights, h);
    check_sum<4>(gauss8_table.outer_weights, h);
  }
}

BOOST_AUTO_TEST_CASE(tables_of_collocation_are_gauss) {
  check_collocation(midpoint_table);
  check_collocation(gauss4_table);
  check_collocation(gauss6_table);
  check_collocation(gauss8_table);
}

BOOST_AUTO_TEST_CASE(the_midpoint_rule_is_the_midpoint_rule) {
  const double p[] = {0.8, 9.81, 1.0}, h = 0.05;
  const auto system = simple_pendulum::make<double>(0, p);
  const std::array<double, 2> before{1.2, -0.4};
  const auto after = midpoint::state_of(system, midpoint::step(system, 0.0, midpoint::begin(system, before), h));
  const auto slope = system.rhs(0.0, {0.5 * (before[0] + after[0]), 0.5 * (before[1] + after[1])});
  for (int i = 0; i < 2; ++i) BOOST_TEST(std::fabs(after[i] - before[i] - h * slope[i]) < 3e-16);
}

// Each bit of a lane is that of the run alone, though its neighbours need more rounds or never settle.
BOOST_AUTO_TEST_CASE(a_lane_that_has_settled_waits_for_no_one) {
  using alone = double_pendulum::over<double>;
  using together = double_pendulum::over<lanes4>;
  const double sizes[] = {1.0, 0.4, 1e-6, 3.0};  // the shortest is too quick for the step
  lanes4 p[5];
  for (int i = 0; i < 5; ++i) p[i] = lanes4(rods[i]);
  for (int l = 0; l < 4; ++l) p[2].set(l, sizes[l]), p[3].set(l, sizes[l]);
  const auto system = double_pendulum::make<lanes4>(0, p);
  const fixed_output outputs[] = {{3, 0.004}, {20000, 0.0}};
  together::state last{};
  const auto results = fixed_run<gauss8, together>(system, {2.0, 2.5, 0.0, 0.0}, 0.0, 0.02, 30000)
                           .through(outputs, [&](auto, auto& y) { last = y; }, always);
  for (int l = 0; l < 4; ++l) {
    const double single[] = {1.0, 1.0, sizes[l], sizes[l], 9.81};
    const auto its_own = double_pendulum::make<double>(0, single);
    alone::state end{};
    const auto result = fixed_run<gauss8, alone>(its_own, {2.0, 2.5, 0.0, 0.0}, 0.0, 0.02, 30000)
                            .through(outputs, [&](auto, auto& y) { end = y; }, always)[0];
    BOOST_TEST(name_of(results[l].ended) == name_of(result.ended));
    BOOST_TEST(results[l].evaluations == result.evaluations);
    BOOST_TEST(results[l].steps == result.steps);
    if (result.ended == outcome::reached_end)
      for (int i = 0; i < 4; ++i) BOOST_TEST(lane(last[i], l) == end[i]);
  }
  BOOST_TEST(name_of(results[0].ended) == "reached_end");
  BOOST_TEST(name_of(results[2].ended) == "not_finite");
}

BOOST_AUTO_TEST_CASE(evaluations_are_counted) {
  const auto system = linear_pendulum::make<double>(0, rods);
  using harmonic = linear_pendulum::over<double>;
  const fixed_output outputs[] = {{5, 0.05}, {9, 0.0}};
  const auto count = [&]<class Method>(Method) {
    return fixed_run<Method, harmonic>(system, {1.0, 0.0}, 0.0, 0.1, 100)
        .through(outputs, nowhere, always)[0]
        .evaluations;
  };
  BOOST_TEST(count(rk4{}) == 40);
  BOOST_TEST(count(yoshida8{}) == 150);
  // at rest the first round is the last
  const fixed_output ten[] = {{10, 0.0}};
  const auto resting = fixed_run<gauss6, harmonic>(system, {0.0, 0.0}, 0.0, 0.1, 100).through(ten, nowhere, always)[0];
  BOOST_TEST(resting.evaluations == 3 * 10);
  const fixed_output on_grid[] = {{9, 0.0}}, off_grid[] = {{5, 0.05}, {9, 0.0}};
  const auto grid = fixed_run<gauss6, harmonic>(system, {1.0, 0.0}, 0.0, 0.1, 100).through(on_grid, nowhere, always)[0];
  const auto more =
      fixed_run<gauss6, harmonic>(system, {1.0, 0.0}, 0.0, 0.1, 100).through(off_grid, nowhere, always)[0];
  BOOST_TEST(more.evaluations > grid.evaluations);
  BOOST_TEST(more.evaluations < 2 * grid.evaluations);
}
