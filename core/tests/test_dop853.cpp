#include <boost/test/unit_test.hpp>

#include "run_dop853.hpp"

using namespace pendula;

namespace {

// Σ_j w_j g(c_j) of a row.
template <const auto& table, std::size_t row>
double sum_over(auto&& g) {
  double sum = 0.0;
  for (const auto& [slope, coefficient] : std::get<row>(table)) sum += coefficient * g(slope);
  return sum;
}
template <std::size_t row>
double node() {
  if constexpr (row == 0) {
    return 0.0;
  } else {
    return sum_over<dop853_table::toward, row - 1>([](int) { return 1.0; });
  }
}
const auto nodes = []<std::size_t... i>(std::index_sequence<i...>) {
  return std::array{node<i>()...};
}(std::make_index_sequence<16>{});

auto power_of_node(int k) {
  return [k](int slope) { return std::pow(nodes[static_cast<std::size_t>(slope)], k); };
}

}  // namespace

BOOST_AUTO_TEST_CASE(dop853_satisfies_the_conditions_of_its_orders) {
  // the times of the slopes are the row sums, to the rounding of sums of numbers up to 43
  static_assert(dop853_table::node.size() == nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) BOOST_TEST(std::fabs(nodes[i] - dop853_table::node[i]) < 8e-15, i);
  using namespace dop853_table;
  for (int k = 0; k < 8; ++k) {  // the bushy trees of order k + 1, and those with one more below
    BOOST_TEST_CONTEXT("order " << k + 1) {
      BOOST_TEST(std::fabs(sum_over<toward, 11>(power_of_node(k)) - 1.0 / (k + 1)) < 1e-14);
      if (k < 5) BOOST_TEST(std::fabs(sum_over<error, 0>(power_of_node(k))) < 1e-14);
      if (k < 3) BOOST_TEST(std::fabs(sum_over<error, 1>(power_of_node(k)) - 1.0 / (k + 1)) < 1e-14);
    }
  }
  BOOST_TEST(std::fabs(sum_over<toward, 11>(power_of_node(8)) - 1.0 / 9.0) > 1e-6);
  BOOST_TEST(std::fabs(sum_over<error, 0>(power_of_node(5))) > 1e-4);
}

BOOST_AUTO_TEST_CASE(a_step_of_dop853_is_of_order_8_and_its_dense_output_of_order_7) {
  const double p[] = {1.0, 1.0, 1.0, 1.0, 1.0};
  const auto system = double_pendulum::make<double>(0, p);
  const rods::state y{1.0, -0.5, 0.3, 0.2};
  const auto error = [&](double h, double part) {  // of one step, a part of it on
    dop853_stepper<rods> stepper(system, -10.0);
    stepper.start(0.0, y);
    auto from = stepper.remembered();
    from.step = h;
    stepper.resume(from);
    stepper.expand({0.0, 0.0}, 1.0);
    BOOST_REQUIRE(stepper.length() == h);
    return distance(stepper.after(part * h).head, run(system, y, {part * h}, -53.0).states[0]);
  };
  BOOST_TEST(std::fabs(std::log2(error(0.2, 1.0) / error(0.1, 1.0)) - 9.0) < 0.5);
  BOOST_TEST(std::fabs(std::log2(error(0.2, 0.37) / error(0.1, 0.37)) - 8.0) < 0.5);
}

BOOST_AUTO_TEST_CASE(dop853_follows_the_rods) {
  const auto system = double_pendulum::make<double>(0, of_rods);
  const auto found = run(system, rods::state{2.0, 2.5, 0.0, 0.0}, {1.0, 5.0, 10.0}, -52.0);
  BOOST_TEST(name_of(found.result.ended) == "reached_end");
  const rods::state at1{-1.01478186187538306, -1.12244606910181525, -7.26181086506237487, 5.72845783468323474},
      at5{0.205462239524980870, -7.52104212191582645, 1.68158668590311311, 11.7276651341110641},
      at10{-0.997012773703082562, 4.16303573609155265, 1.74876611705965533, -10.1872062958343787};
  BOOST_TEST(distance(found.states[0], at1) < 1e-13);
  BOOST_TEST(distance(found.states[1], at5) < 1e-11);
  BOOST_TEST(distance(found.states[2], at10) < 1e-6);
}

BOOST_AUTO_TEST_CASE(dop853_follows_a_small_swing_to_parts_of_its_size) {
  const auto system = linear_pendulum::make<double>(0, unit);
  for (const double amplitude : {1.0, 1e-9}) {
    const auto found = run(system, oscillator::state{amplitude, 0.0}, {1.0, 10.0, 100.0}, -46.0).states;
    for (std::size_t i = 0; i < 3; ++i) {
      const double t = std::array{1.0, 10.0, 100.0}[i];
      const oscillator::state exact{amplitude * std::cos(t), -amplitude * std::sin(t)};
      BOOST_TEST(distance(found[i], exact) < 1e-13 * t * amplitude);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_error_of_dense_output_is_about_the_tolerance) {
  const auto system = double_pendulum::make<double>(0, of_rods);
  const rods::state y{1.0, -0.5, 0.3, 0.2};
  std::vector<double> times;
  for (int i = 1; i <= 500; ++i) times.push_back(0.001 * i);
  const auto exact = run(system, y, times, -53.0).states;
  for (const double log2_of_tolerance : {-20.0, -30.0, -40.0}) {
    const auto found = run(system, y, times, log2_of_tolerance).states;
    double most = 0.0;
    for (std::size_t i = 0; i < times.size(); ++i) most = std::max(most, distance(found[i], exact[i]));
    BOOST_TEST(most < 100.0 * std::exp2(log2_of_tolerance));
    BOOST_TEST(most > 0.01 * std::exp2(log2_of_tolerance));
  }
}

BOOST_AUTO_TEST_CASE(dop853_goes_backward) {
  const auto system = double_pendulum::make<double>(0, of_rods);
  const rods::state y{1.0, -0.5, 0.3, 0.2};
  const auto there = run(system, y, {5.0}, -52.0).states[0];
  const auto back = run(system, there, {-2.0, -5.0}, -52.0);
  BOOST_TEST(name_of(back.result.ended) == "reached_end");
  BOOST_TEST(distance(back.states[0], run(system, y, {3.0}, -52.0).states[0]) < 1e-12);
  BOOST_TEST(distance(back.states[1], y) < 1e-12);
}
