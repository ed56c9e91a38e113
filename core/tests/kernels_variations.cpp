// Runs with variations have the motion of plain ones, bit by bit, through lanes or one by one, whoever runs them.
#include <boost/test/unit_test.hpp>

#include "pendula/kernels/solve.hpp"
#include "pendula/kernels/variations.hpp"
#include "requests.hpp"

using namespace requests;

namespace {

// All d variations along the components, or the first of them.
varied_by along_components(variation_use use, std::size_t count, std::size_t d) {
  varied_by by{use, count, std::vector<double>(count * d)};
  for (std::size_t i = 0; i < count; ++i) by.start[i * d + i] = 1.0;
  return by;
}

ensemble_result varied(const request& asked, const varied_by& by, std::size_t copies, pool& workers) {
  std::vector<double> states;
  for (std::size_t n = 0; n < copies; ++n) states.insert(states.end(), asked.state.begin(), asked.state.end());
  const ensemble_rows rows{states, asked.system.parameters, copies, asked.state.size(), 0};
  return run_varied(asked, by, rows, workers, always);
}

void check_varied(const request& asked, const varied_by& by) {
  const std::size_t d = asked.state.size(), size = by.output_size(d), m = asked.times.size();
  const run_result plain = solve(asked, always);
  const ensemble_result alone = varied(asked, by, 1, *caller_alone());
  BOOST_TEST(alone.steps[0] == plain.steps);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < d; ++j) BOOST_TEST(alone.states[i * size + j] == plain.states[i * d + j]);
  for (auto& workers : {caller_alone(), threads(3)}) {
    const ensemble_result many = varied(asked, by, 11, *workers);
    for (std::size_t n = 0; n < 11; ++n) {
      const auto from = many.states.begin() + static_cast<std::ptrdiff_t>(n * m * size);
      BOOST_TEST(same_bits({from, from + static_cast<std::ptrdiff_t>(m * size)}, alone.states));
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(kernels)

BOOST_AUTO_TEST_CASE(runs_with_variations_are_the_plain_ones) {
  for (const std::string_view system : {"simple", "double", "driven", "damped-double"}) {
    request asked = with_method("taylor", system);
    asked.t0 = 0.25;
    asked.times = {0.25, 0.26, 1.0, 4.0};
    const std::size_t d = asked.state.size();
    BOOST_TEST_CONTEXT(system) {
      for (const std::size_t count : {std::size_t{1}, std::size_t{2}, d})
        check_varied(asked, along_components(variation_use::free, count, d));
      check_varied(asked, along_components(variation_use::megno, 1, d));
      check_varied(asked, along_components(variation_use::orthogonal, d, d));
    }
  }
}

// The same motion by both ways: the double pendulum, and the damped one without friction.
BOOST_AUTO_TEST_CASE(variations_through_lanes_are_those_of_numbers_that_carry_them) {
  request ideal = with_method("taylor", "double"), damped = with_method("taylor", "damped-double");
  for (const auto use : {variation_use::free, variation_use::megno, variation_use::orthogonal}) {
    const auto by = along_components(use, use == variation_use::megno ? 1 : 4, 4);
    ideal.times = damped.times = {0.5, 6.0};
    const auto first = varied(ideal, by, 1, *caller_alone()), second = varied(damped, by, 1, *caller_alone());
    for (std::size_t i = 0; i < first.states.size(); ++i)
      BOOST_TEST(std::fabs(first.states[i] - second.states[i]) <= 1e-8 * (1.0 + std::fabs(first.states[i])));
  }
}

// Of a volume: it shrinks as friction says, which is the same everywhere.
BOOST_AUTO_TEST_CASE(volumes_of_orthogonal_variations_shrink_by_friction) {
  request asked = with_method("taylor", "driven");
  asked.system.form = 2;
  asked.system.parameters = {2.0, 1.5, 2.0 / 3.0, 0.0};
  asked.times = {400.0};
  const auto found = varied(asked, along_components(variation_use::orthogonal, 2, 2), 1, *caller_alone());
  BOOST_TEST(std::fabs(found.states[4] + found.states[7] + 200.0) < 1e-9);
}

// Beyond what a double holds.
BOOST_AUTO_TEST_CASE(variations_grow_without_end) {
  request asked = with_method("taylor", "double");
  asked.state = {2.0, 2.5, 0.0, 0.0};
  asked.times = {300.0};
  const auto found = varied(asked, along_components(variation_use::free, 4, 4), 1, *caller_alone());
  BOOST_TEST(found.states[8] >= 1.0);
  for (const double x : found.states) BOOST_TEST(std::isfinite(x));
}

BOOST_AUTO_TEST_SUITE_END()
