#include <boost/test/unit_test.hpp>

#include "pendula/drive/fixed.hpp"
#include "pendula/method/euler.hpp"
#include "pendula/method/rk4.hpp"
#include "pendula/system/double_pendulum.hpp"
#include "pendula/system/linear_pendulum.hpp"

using namespace pendula;
using oscillator = linear_pendulum::over<double>;

namespace {

const double unit[] = {1.0, 1.0, 1.0};
const auto always = [](auto) { return true; };
const auto nowhere = [](std::size_t, const auto&) {};

}  // namespace

BOOST_AUTO_TEST_CASE(times_on_the_grid_need_no_shortened_step) {
  const auto third = place_on_grid(0.3, 0.0, 0.1);  // 0.3/0.1 is not 3 in doubles
  BOOST_TEST(third.steps == 3);
  BOOST_TEST(third.rest == 0.0);
  const auto between = place_on_grid(0.37, 0.0, 0.1);
  BOOST_TEST(between.steps == 3);
  BOOST_TEST(std::fabs(between.rest - 0.07) < 1e-15);
  const auto nearly = place_on_grid(0.3 + 1e-11, 0.0, 0.1);  // 1e-10 of a step off
  BOOST_TEST(nearly.rest == 0.0);
  const auto just_off = place_on_grid(0.3 + 2e-10, 0.0, 0.1);
  BOOST_TEST(just_off.rest > 0.0);
  const auto after_many = place_on_grid(299.0, 0.0, 1e-5);  // 1e-5 is not 10^-5: 4e-9 of a step off
  BOOST_TEST(after_many.rest == 0.0);
  const auto backward = place_on_grid(0.63, 1.0, -0.1);
  BOOST_TEST(backward.steps == 3);
  BOOST_TEST(std::fabs(backward.rest + 0.07) < 1e-15);
}

BOOST_AUTO_TEST_CASE(own_steps_end_where_they_should) {
  const auto even = own_steps(2.0, 0.1, 2.3);
  BOOST_TEST(even.times.size() == 4u);
  BOOST_TEST(even.times.back() == 2.3);
  const auto odd = own_steps(0.0, 0.1, 0.25);
  BOOST_TEST(odd.times.size() == 4u);
  BOOST_TEST(odd.outputs.back().steps == 2);
  BOOST_TEST(odd.outputs.back().rest == 0.25 - 2 * 0.1);
}

BOOST_AUTO_TEST_CASE(a_shortened_step_leaves_the_grid_alone) {
  const auto system = linear_pendulum::make<double>(0, unit);
  const fixed_output with[] = {{3, 0.004}, {10, 0.0}}, without[] = {{10, 0.0}};
  oscillator::state a{}, b{};
  fixed_run<rk4, oscillator>(system, {1.0, 0.0}, 0.0, 0.01, 100).through(with, [&](auto, auto& y) { a = y; }, always);
  fixed_run<rk4, oscillator>(system, {1.0, 0.0}, 0.0, 0.01, 100)
      .through(without, [&](auto, auto& y) { b = y; }, always);
  BOOST_TEST((a == b));
}

BOOST_AUTO_TEST_CASE(a_run_stops_at_its_step_limit_and_keeps_what_it_reached) {
  const auto system = linear_pendulum::make<double>(0, unit);
  const fixed_output outputs[] = {{5, 0.0}, {9, 0.005}, {20, 0.0}};
  const auto result =
      fixed_run<rk4, oscillator>(system, {1.0, 0.0}, 0.0, 0.01, 10).through(outputs, nowhere, always)[0];
  BOOST_TEST(name_of(result.ended) == "step_limit");
  BOOST_TEST(result.outputs == 2u);
  BOOST_TEST(result.steps == 10);
  const auto enough =
      fixed_run<rk4, oscillator>(system, {1.0, 0.0}, 0.0, 0.01, 21).through(outputs, nowhere, always)[0];
  BOOST_TEST(name_of(enough.ended) == "reached_end");
  BOOST_TEST(enough.steps == 21);
}

BOOST_AUTO_TEST_CASE(a_run_that_blows_up_says_so) {
  const double rods[] = {1, 1, 1, 1, 9.81};
  const auto system = double_pendulum::make<double>(0, rods);
  const fixed_output outputs[] = {{0, 0.0}, {1, 0.0}, {1000, 0.0}};
  const auto result = fixed_run<euler, double_pendulum::over<double>>(system, {2.0, 1.0, 0.0, 0.0}, 0.0, 1.0, 10000)
                          .through(outputs, nowhere, always)[0];
  BOOST_TEST(name_of(result.ended) == "not_finite");
  BOOST_TEST(result.outputs == 2u);
  BOOST_TEST(result.steps < 100);
}

BOOST_AUTO_TEST_CASE(a_run_can_be_interrupted) {
  const auto system = linear_pendulum::make<double>(0, unit);
  const fixed_output outputs[] = {{1, 0.0}, {1000000, 0.0}};
  std::int64_t told = 0;
  const auto twice = [&](std::int64_t steps) { return (told = steps) < 3 * (1 << 14); };
  const auto result =
      fixed_run<rk4, oscillator>(system, {1.0, 0.0}, 0.0, 1e-3, 10000000).through(outputs, nowhere, twice)[0];
  BOOST_TEST(told == result.steps);
  BOOST_TEST(name_of(result.ended) == "interrupted");
  BOOST_TEST(result.steps == 3 * (1 << 14));
  BOOST_TEST(result.outputs == 1u);
}

BOOST_AUTO_TEST_CASE(a_bad_lane_does_not_disturb_its_neighbours) {
  using lanes4 = pack<double, 4>;
  using rods = double_pendulum::over<lanes4>;
  const lanes4 p[] = {1.0, 1.0, 1.0, 1.0, 9.81};
  const auto system = double_pendulum::make<lanes4>(0, p);
  rods::state start{lanes4(0.1), lanes4(0.2), lanes4(0.0), lanes4(0.0)}, last{};
  set_lane(start[0], 1, largest_angle - 1.0);  // soon leaves the sine's range
  set_lane(start[2], 1, 100.0);
  set_lane(start[0], 3, std::nan(""));
  const fixed_output outputs[] = {{1, 0.0}, {200000, 0.0}};
  const auto results = fixed_run<rk4, rods>(system, start, 0.0, 1e-3, 1 << 20)
                           .through(outputs, [&](auto, auto& y) { last = y; }, always);
  BOOST_TEST(name_of(results[0].ended) == "reached_end");
  BOOST_TEST(name_of(results[1].ended) == "not_finite");
  BOOST_TEST(results[1].outputs == 1u);
  BOOST_TEST(results[3].outputs == 0u);
  BOOST_TEST(results[3].steps == 0);
  BOOST_TEST(lane(last[0], 0) == lane(last[0], 2));
  BOOST_TEST(std::isnan(lane(last[0], 1)));
  BOOST_TEST(results[0].steps == 200000);
}
