// One run of each method through `solve`: what comes back, where it ends, and how long it is right.
#include <boost/test/unit_test.hpp>

#include "pendula/kernels/long_runs.hpp"
#include "pendula/kernels/solve.hpp"
#include "requests.hpp"

using namespace requests;

namespace {

double angle(const run_result& run, std::size_t output, std::size_t i, std::size_t dimension) {
  return run.states[output * dimension + i];
}

}  // namespace

BOOST_AUTO_TEST_SUITE(kernels)

BOOST_AUTO_TEST_CASE(what_is_refused_is_not_run) {
  request asked = with_method("verlet", "simple");
  asked.system = described("double");
  asked.state = {2.0, 2.5, 0.0, 0.0};
  const run_result none = solve(asked, always);
  BOOST_TEST_REQUIRE(none.refused.has_value());
  BOOST_TEST(none.refused->rule == "needs_separable");
  BOOST_TEST(std::get<std::string>(none.refused->value) == "verlet");
  BOOST_TEST(none.steps == 0);
  BOOST_TEST(none.evaluations == 0);
  BOOST_TEST(none.states.empty());
  BOOST_TEST(!none.dense);
  // one that could be run, and must not
  asked = adaptive();
  asked.options.tolerance = 0.01;
  BOOST_TEST(solve(asked, always).states.empty());
  // each method with each system that it does not take
  for (const method_row& method : method_rows())
    for (const system_row& system : system_rows()) {
      asked = with_method(method.name, "simple");
      asked.system = described(system.name);
      asked.state.assign(system.components.size(), 0.1);
      const run_result run = solve(asked, always);
      BOOST_TEST(run.refused.has_value() != takes_system(method, system.name), method.name << " " << system.name);
      BOOST_TEST(run.states.empty() == run.refused.has_value());
    }
}

BOOST_AUTO_TEST_CASE(every_method_gives_the_same_fields) {
  for_each_pair([](const method_row& method, std::string_view system) {
    BOOST_TEST_CONTEXT(method.name << " " << system) {
      request asked = with_method(method.name, system);
      asked.t0 = -0.5;
      asked.times = {-0.5, 0.123, 0.5};
      const std::size_t d = asked.state.size();
      const run_result run = solve(asked, always);
      BOOST_TEST(!run.refused);
      BOOST_TEST(name_of(run.ended) == "reached_end");
      BOOST_TEST(run.reached == 0.5);
      BOOST_TEST(run.times == asked.times, boost::test_tools::per_element());
      BOOST_TEST_REQUIRE(run.states.size() == 3 * d);
      BOOST_TEST(same_bits({run.states.begin(), run.states.begin() + d}, asked.state));
      BOOST_TEST((method.adaptive ? run.steps > 1 : run.steps == 101));  // the last to 0.123 is off the grid
      BOOST_TEST(run.evaluations >= run.steps * std::max(method.evaluations_per_step, 1));
      BOOST_TEST((run.dense != nullptr) == method.adaptive);
      BOOST_TEST(!run.trust_horizon);
      BOOST_TEST(run.tails.empty());
      // its own steps, from the start to the same end
      asked.own_steps = true;
      asked.times = {0.5};
      const run_result steps = solve(asked, always);
      BOOST_TEST(steps.times.size() == static_cast<std::size_t>(steps.steps) + 1);
      BOOST_TEST(steps.states.size() == steps.times.size() * d);
      BOOST_TEST((steps.times.front() == -0.5 && steps.times.back() == 0.5));
      BOOST_TEST(same_bits({steps.states.end() - d, steps.states.end()}, {run.states.end() - d, run.states.end()}));
    }
  });
}

BOOST_AUTO_TEST_CASE(a_run_ends_as_it_says) {
  for (request asked : {adaptive(), with_method("dop853", "double"), fixed()}) {
    BOOST_TEST_CONTEXT(asked.method) {
      const auto ended = [&](const watcher& watch) { return name_of(solve(asked, watch).ended); };
      asked.times = {1000.0};
      asked.options.max_steps = 7;
      BOOST_TEST(ended(always) == "step_limit");
      BOOST_TEST(solve(asked, always).steps == 7);
      asked.options.max_steps = {};
      if (asked.options.step) asked.options.step = 0.001;
      double done = 0.0;
      const watcher early = [&](double part) { return (done = part) < 0.2; };
      const run_result stopped = solve(asked, early);
      BOOST_TEST(name_of(stopped.ended) == "interrupted");
      BOOST_TEST((0.2 <= done && done < 0.9));
      BOOST_TEST(std::fabs(stopped.reached - 1000.0 * done) < 1.0);
      BOOST_TEST(stopped.states.empty());
      asked.state[0] = 0x1p27;  // beyond the sine's range
      BOOST_TEST(ended(always) == "not_finite");
    }
  }
  request asked = adaptive();
  asked.times = {100.0};
  asked.events = {{event_kind::angle, 0, 0.0}, {event_kind::velocity_zero, 1}};
  asked.events[0].terminal = 3;
  const run_result run = solve(asked, always);
  BOOST_TEST(name_of(run.ended) == "event");
  BOOST_TEST_REQUIRE(run.events.size() == 2u);
  BOOST_TEST(run.events[0].times.size() == 3u);
  BOOST_TEST(run.events[0].states.size() == 12u);
  BOOST_TEST(run.events[0].times.back() == run.reached);
  BOOST_TEST(run.events[1].times.size() > 0u);
}

// It ends on the event, bit for bit; a run from there starts on the event and finds the next one.
BOOST_AUTO_TEST_CASE(a_run_goes_on_from_the_event_that_ended_it) {
  const event kinds[] = {{event_kind::angle, 1, 0.0, 0.0, true, 0, 1},
                         {event_kind::velocity_zero, 0, 0.0, 0.0, false, 0, 1},
                         {event_kind::tip_height, 0, -0.5, 0.0, false, 0, 1}};
  for (const std::string_view method : {"taylor", "dop853"})
    for (const event& each : kinds) {
      request asked = with_method(method, "double");
      asked.own_steps = true;
      asked.events = {each};
      for (int i = 0; i < 30; ++i) {
        asked.times = {asked.t0 + 1000.0};
        const run_result run = solve(asked, always);
        BOOST_TEST_REQUIRE(name_of(run.ended) == "event");
        BOOST_TEST(run.reached > asked.t0 + 1e-6);
        BOOST_TEST(run.times.back() == run.events[0].times[0]);
        asked.t0 = run.reached;
        asked.state.assign(run.states.end() - 4, run.states.end());
        BOOST_TEST(same_bits(asked.state, run.events[0].states));
        std::vector<double> last(4);
        BOOST_TEST(run.dense->at(std::array{run.reached}, last.data(), always));
        BOOST_TEST(same_bits(last, asked.state));
      }
    }
}

// The motion between outputs, worked out again, has the bits of outputs, at the ends of steps, too.
BOOST_AUTO_TEST_CASE(dense_output_is_what_outputs_there_would_have_been) {
  for (const double end : {2.0, -2.0})
    for (request asked : {adaptive(), with_method("dop853", "double"), with_method("taylor", "linear")}) {
      asked.times.clear();
      for (int i = 0; i <= 200; ++i) asked.times.push_back(end * i / 200.0);
      const run_result at_once = solve(asked, always);
      request coarse = asked;
      coarse.times = {end};
      const run_result run = solve(coarse, always);
      BOOST_TEST(run.dense->reached() == end);
      std::vector<double> states(asked.times.size() * asked.state.size());
      BOOST_TEST(run.dense->at(asked.times, states.data(), always));
      BOOST_TEST(same_bits(states, at_once.states), asked.method << " " << asked.system.name);
      coarse.own_steps = true;
      const run_result steps = solve(coarse, always);
      states.resize(steps.states.size());
      BOOST_TEST(steps.dense->at(steps.times, states.data(), always));
      BOOST_TEST(same_bits(states, steps.states), asked.method << " " << asked.system.name);
    }
}

BOOST_AUTO_TEST_CASE(of_many_steps_every_so_many_are_kept) {
  struct numbered final : step_motion {
    double number = 0.0;
    two_doubles start() const override { return {number, 0.0}; }
    double stop() const override { return 1.0; }
    double time_after(double tau) const override { return number + tau; }
    void state(double, double*) const override {}
    void angles(double, double*) const override {}
    void remember(step_memory& to) const override { to = {{number}, 1}; }
  };
  step_starts starts;
  for (numbered step; step.number < 100'000; ++step.number) starts.add(step);
  BOOST_TEST((starts.size() > 10'000u && starts.size() <= 1u << 14));
  const double stride = starts.time(1);
  for (std::size_t i = 0; i < starts.size(); ++i) BOOST_TEST_REQUIRE(starts.time(i) == stride * static_cast<double>(i));
  BOOST_TEST(starts.time(starts.size() - 1) > 100'000 - 2 * stride);
}

// Beside the motion with many digits: at the horizon an angle is off by what was asked for, and before it by less.
BOOST_AUTO_TEST_CASE(a_certified_run_is_right_up_to_its_horizon) {
  for (const std::string_view method : {"taylor", "dop853", "gauss8"}) {
    BOOST_TEST_CONTEXT(method) {
      request asked = with_method(method, "double");
      asked.state = {2.0, 2.5, 0.0, 0.0};
      asked.times = {8.0};
      asked.options.certify = 1e-11;
      const run_result run = solve(asked, always);
      BOOST_TEST_REQUIRE(run.trust_horizon.has_value());
      const double horizon = *run.trust_horizon;
      BOOST_TEST((0.5 < horizon && horizon < 8.0), horizon);
      asked.options.certify = {};
      asked.times = {horizon - asked.options.step.value_or(0.01), horizon};
      const run_result plain = solve(asked, always), right = long_runs().front().run(asked, always);
      const auto error = [&](std::size_t i) {
        return std::max(std::fabs(angle(plain, i, 0, 4) - angle(right, i, 0, 4)),
                        std::fabs(angle(plain, i, 1, 4) - angle(right, i, 1, 4)));
      };
      BOOST_TEST(error(0) < 1e-11);
      // of fixed step the horizon is the first step that is wrong
      BOOST_TEST((asked.options.step ? error(1) > 1e-11 : std::fabs(error(1) - 1e-11) < 1e-14), error(1));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_run_that_stays_right_has_no_horizon_within_it) {
  request asked = with_method("taylor", "simple");
  asked.options.certify = 1e-6;
  BOOST_TEST(std::isinf(solve(asked, always).trust_horizon.value()));
  asked.options.certify = 1e-16;  // less than rounding
  BOOST_TEST(solve(asked, always).trust_horizon.value() < 1.0);
  asked.options.certify = 1e-6;
  asked.times = {1e3};
  const run_result stopped = solve(asked, [](double done) { return done < plain_share; });
  BOOST_TEST(name_of(stopped.ended) == "interrupted");
  BOOST_TEST(!stopped.trust_horizon);
}

BOOST_AUTO_TEST_SUITE_END()
