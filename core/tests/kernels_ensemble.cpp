// Ensembles give each run what it gives alone, bit by bit, whoever runs it beside whom.
#include <boost/test/unit_test.hpp>
#include <limits>

#include "pendula/kernels/ensemble.hpp"
#include "pendula/kernels/solve.hpp"
#include "requests.hpp"

using namespace requests;

namespace {

// States and parameters of some runs, all different.
struct table {
  std::vector<double> states, parameters;
  std::size_t count, dimension, parameters_apart;

  table(const request& like, std::size_t count)
      : count(count), dimension(like.state.size()), parameters_apart(like.system.parameters.size()) {
    for (std::size_t n = 0; n < count; ++n) {
      for (std::size_t i = 0; i < dimension; ++i)
        states.push_back(like.state[i] - 0.31 * static_cast<double>(n) + 0.05 * static_cast<double>(i));
      for (std::size_t i = 0; i < parameters_apart; ++i)
        parameters.push_back(like.system.parameters[i] * (1.0 + 0.01 * static_cast<double>(n + i)));
    }
  }
  ensemble_rows rows() const { return {states, parameters, count, dimension, parameters_apart}; }
  request alone(request asked, std::size_t n) const {
    asked.state.assign(rows().state_of(n), rows().state_of(n) + dimension);
    asked.system.parameters.assign(rows().parameters_of(n), rows().parameters_of(n) + parameters_apart);
    return asked;
  }
};

// The part of an ensemble's events that is one run's.
crossings of_trajectory(const crossings& all, std::size_t n, std::size_t dimension) {
  crossings mine;
  for (std::size_t i = 0; i < all.times.size(); ++i) {
    if (all.trajectories[i] != static_cast<std::int64_t>(n)) continue;
    mine.times.push_back(all.times[i]);
    mine.states.insert(mine.states.end(), all.states.begin() + static_cast<std::ptrdiff_t>(i * dimension),
                       all.states.begin() + static_cast<std::ptrdiff_t>((i + 1) * dimension));
  }
  return mine;
}

// Runs that did not come to all outputs have no number there.
void check_run(const ensemble_result& all, std::size_t n, const run_result& alone, std::size_t outputs, std::size_t d) {
  BOOST_TEST(name_of(all.ended[n]) == name_of(alone.ended));
  BOOST_TEST(all.steps[n] == alone.steps);
  BOOST_TEST(all.evaluations[n] == alone.evaluations);
  BOOST_TEST((all.reached[n] == alone.reached));
  std::vector<double> mine(all.states.begin() + static_cast<std::ptrdiff_t>(n * outputs * d),
                           all.states.begin() + static_cast<std::ptrdiff_t>((n + 1) * outputs * d));
  for (std::size_t i = alone.states.size(); i < mine.size(); ++i) BOOST_TEST(std::isnan(mine[i]));
  mine.resize(std::min(mine.size(), alone.states.size()));
  BOOST_TEST(same_bits(mine, alone.states));
  for (std::size_t kind = 0; kind < alone.events.size(); ++kind) {
    const crossings found = of_trajectory(all.events[kind], n, d);
    BOOST_TEST(same_bits(found.times, alone.events[kind].times));
    BOOST_TEST(same_bits(found.states, alone.events[kind].states));
  }
}

void check_ensemble(const request& asked, const table& runs) {
  for (auto& workers : {caller_alone(), threads(3)}) {
    const ensemble_result all = run_ensemble(asked, runs.rows(), {}, *workers, always);
    BOOST_TEST((!all.refused && !all.interrupted));
    for (std::size_t n = 0; n < runs.count; ++n)
      BOOST_TEST_CONTEXT("run " << n << " of " << workers->workers() << " workers") {
        check_run(all, n, solve(runs.alone(asked, n), always), asked.times.size(), asked.state.size());
      }
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(kernels)

BOOST_AUTO_TEST_CASE(each_run_of_an_ensemble_is_that_of_solve) {
  for_each_pair([](const method_row& method, std::string_view system) {
    BOOST_TEST_CONTEXT(method.name << " " << system) {
      request asked = with_method(method.name, system);
      asked.t0 = 0.25;
      asked.times = {0.25, 0.26, 0.403, 1.0};
      check_ensemble(asked, table(asked, 11));
      asked.times = {0.1, -0.5};  // back in time, without an output at the start
      if (asked.options.step) asked.options.step = 0.05;
      check_ensemble(asked, table(asked, 3));
    }
  });
}

BOOST_AUTO_TEST_CASE(events_of_an_ensemble_are_those_of_its_runs) {
  for (const std::string_view method : {"taylor", "dop853"}) {
    request asked = with_method(method, "double");
    asked.times = {0.5, 2.0};
    asked.events = {{event_kind::angle, 0, 0.1}, {event_kind::velocity_zero, 1}, {event_kind::tip_height, 0, -1.0}};
    check_ensemble(asked, table(asked, 6));
    asked.events[1].terminal = 2;
    check_ensemble(asked, table(asked, 6));
  }
}

// One breaks down, and all come to a limit of steps at their own times.
BOOST_AUTO_TEST_CASE(what_goes_wrong_with_one_run_leaves_the_others_alone) {
  for (request asked : {adaptive(), with_method("dop853", "double"), fixed(), with_method("gauss6", "double")}) {
    BOOST_TEST_CONTEXT(asked.method) {
      table runs(asked, 9);
      runs.states[4 * runs.dimension] = 0x1p27;  // beyond the sine's range
      runs.states[5 * runs.dimension + 1] = std::numeric_limits<double>::quiet_NaN();
      const auto workers = threads(2);
      const ensemble_result all = run_ensemble(asked, runs.rows(), {}, *workers, always);
      for (std::size_t n = 0; n < runs.count; ++n) {
        BOOST_TEST(name_of(all.ended[n]) == (n == 4 || n == 5 ? "not_finite" : "reached_end"), n);
        if (n != 5) check_run(all, n, solve(runs.alone(asked, n), always), asked.times.size(), runs.dimension);
      }
      asked.options.max_steps = 12;
      asked.times.back() = 50.0;
      check_ensemble(asked, table(asked, 9));
    }
  }
}

BOOST_AUTO_TEST_CASE(horizons_of_an_ensemble_are_those_of_its_runs) {
  for (request asked : {adaptive(), fixed()}) {
    asked.times = {2.0};
    asked.options.certify = 1e-13;
    const table runs(asked, 5);
    const auto workers = threads(2);
    const ensemble_result all = run_ensemble(asked, runs.rows(), {}, *workers, always);
    for (std::size_t n = 0; n < runs.count; ++n)
      BOOST_TEST((all.trust_horizon[n] == solve(runs.alone(asked, n), always).trust_horizon), n);
  }
}

BOOST_AUTO_TEST_CASE(an_ensemble_is_refused_or_interrupted_as_a_whole) {
  request asked = fixed();
  for (auto& workers : {caller_alone(), threads(2)}) {
    request wrong = asked;
    wrong.options.step = {};
    const table runs(asked, 4);
    const ensemble_result none = run_ensemble(wrong, runs.rows(), {}, *workers, always);
    BOOST_TEST_REQUIRE(none.refused.has_value());
    BOOST_TEST(none.refused->rule == "step_needed");
    BOOST_TEST((none.states.empty() && none.ended.empty()));
    request endless = asked;
    endless.times = {1e7};
    const ensemble_result stopped = run_ensemble(endless, runs.rows(), {}, *workers, never);
    BOOST_TEST(stopped.interrupted);
    for (const double reached : stopped.reached) BOOST_TEST(reached < 1e7);
  }
}

BOOST_AUTO_TEST_CASE(an_ensemble_has_its_outputs_at_the_times_alone) {
  request asked = fixed();
  asked.own_steps = true;  // of no use to many runs at once
  asked.times = {1.0};
  const table runs(asked, 3);
  const auto workers = caller_alone();
  const ensemble_result all = run_ensemble(asked, runs.rows(), {}, *workers, always);
  BOOST_TEST((all.refused || all.states.size() == runs.count * runs.dimension));
}

BOOST_AUTO_TEST_SUITE_END()
