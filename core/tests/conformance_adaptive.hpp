// What every system has to pass with the methods that choose their steps, and in lanes, over any list of systems.
#pragma once

#include <algorithm>

#include "adaptive_bits.hpp"
#include "conformance.hpp"

namespace conformance {

// Keeps outputs at given times, and events.
template <class Run>
struct keeper {
  using state = typename Run::state;
  struct crossing {
    int place;
    double time;
    state y;
  };

  std::vector<double> times;
  std::vector<state> outputs{};
  std::vector<crossing> events{};

  bool step(const Run& run, double stop) {
    for (; outputs.size() < times.size(); outputs.push_back(at(run, run.since_step(times[outputs.size()]))))
      if (run.since_step(times[outputs.size()]) * run.direction() > stop * run.direction()) break;
    return true;
  }
  void event(const Run& run, int place, double tau) { events.push_back({place, run.time_after(tau), at(run, tau)}); }
  static state at(const Run& run, double tau) { return run.stepper().state_of(run.stepper().after(tau)); }
};

// A run from `start` at t0 to the last of the times.
template <class Method, class Sys>
auto told(const Sys& system, const typename Sys::state& start, std::vector<double> times,
          std::span<const event> events = {}, double log2_of_tolerance = -52.0) {
  using Stepper = typename Method::template stepper<Sys>;
  Stepper stepper(system, log2_of_tolerance);
  stepper.start(t0, start);
  keeper<adaptive_run<Stepper>> kept{times};
  const auto result =
      adaptive_run<Stepper>(stepper, t0, times.back(), events).to_end(1 << 20, kept, [](double, auto) { return true; });
  BOOST_TEST(name_of(result.ended) == "reached_end");
  BOOST_TEST(kept.outputs.size() == times.size());
  return kept;
}

// So many times over a span, without t0.
inline std::vector<double> times_over(double span, int count) {
  std::vector<double> times;
  for (int i = 1; i <= count; ++i) times.push_back(t0 + span * i / count);
  return times;
}

// Outputs, most of them inside steps, are where many small steps of a method of fixed step lead.
template <class List>
void adaptive_methods_follow_small_steps() {
  for_each_system<List>([]<class Entry, class Sys>(const Sys& system, const auto& start) {
    for (const double span : {1.0, -1.0}) {
      const auto times = times_over(span, 5);
      std::vector<typename Sys::state> truth;
      for (const double t : times) truth.push_back(after<rk4>(system, start, t0, t - t0, 1 << 14));
      for_each_method<adaptive_methods, Sys>([&]<class Method>() {
        const auto found = told<Method>(system, start, times).outputs;
        for (std::size_t i = 0; i < times.size(); ++i) {
          const double apart = distance(found[i], truth[i]);
          BOOST_TEST(apart < 4e-13, times[i] << " " << apart);
        }
      });
    }
  });
}

// What an event asks for, less its value.
template <class Sys>
double quantity(const Sys& system, const event& what, const typename Sys::state& y) {
  const auto i = static_cast<std::size_t>(what.index);
  if (what.kind == event_kind::angle) return y[i] - what.value;
  if (what.kind == event_kind::velocity_zero) return y[degrees_of_freedom<Sys> + i];
  return system.positions(y).back()[1] - what.value;
}

// Events are those that many outputs show, and one is at the time whose state it was asked for.
template <class List>
void events_inside_steps_are_those_that_outputs_show() {
  for_each_system<List>([]<class Entry, class Sys>(const Sys& system, const auto& start) {
    for (const double span : {1.5, -1.5}) {
      const double time = t0 + 0.23456 * span;
      const auto then = after<rk4>(system, start, t0, time - t0, 1 << 14);
      // what so many steps round the angle by takes a slow motion long to pass
      const double allowed = 3e-14 / std::min(1.0, std::fabs(then[degrees_of_freedom<Sys>]));
      const std::vector<event> asked{{event_kind::angle, 0, then[0]},
                                     {event_kind::velocity_zero},
                                     {event_kind::tip_height, 0, system.positions(then).back()[1]}};
      for_each_method<adaptive_methods, Sys>([&]<class Method>() {
        const auto found = told<Method>(system, start, times_over(span, 2000), asked);
        std::vector<int> shown(asked.size()), events(asked.size()), there(asked.size());
        for (std::size_t place = 0; place < asked.size(); ++place)
          for (std::size_t i = 1; i < found.outputs.size(); ++i)
            shown[place] += quantity(system, asked[place], found.outputs[i - 1]) *
                                quantity(system, asked[place], found.outputs[i]) <
                            0.0;
        for (const auto& each : found.events) {
          const auto place = static_cast<std::size_t>(each.place);
          BOOST_TEST(std::fabs(quantity(system, asked[place], each.y)) < 4e-14);
          ++events[place];
          there[place] += std::fabs(each.time - time) < allowed;
        }
        BOOST_TEST(shown == events, boost::test_tools::per_element());
        BOOST_TEST((there[0] == 1 && there[2] == 1));
        BOOST_TEST((events[1] > 0 || span < 0.0));
      });
    }
  });
}

inline double apart(std::size_t trajectory) { return 0.2 * static_cast<double>(trajectory); }

template <class Sys>
typename Sys::state start_of(std::size_t trajectory) {
  auto y = some_state<Sys>();
  for (auto& component : y) component = component - apart(trajectory);
  return y;
}

// Steps of a method of fixed step, on its grid and off it, of which each lane has the bits of a run alone.
template <class Method, class Entry, int width>
void check_lanes_of_fixed_step() {
  using One = typename Entry::template over<double>;
  using S = pack<double, width>;
  using Lanes = typename Entry::template over<S>;
  const fixed_output outputs[] = {{7, 0.0}, {7, 0.003}, {40, 0.0}};
  const auto always = [](auto) { return true; };
  typename Lanes::state start;
  for (int l = 0; l < width; ++l)
    for (std::size_t i = 0; i < start.size(); ++i) set_lane(start[i], l, start_of<One>(static_cast<std::size_t>(l))[i]);
  std::vector<typename Lanes::state> together;
  const auto all = some_system<Entry, S>(0);
  fixed_run<Method, Lanes>(all, start, t0, 0.01, 100)
      .through(outputs, [&](std::size_t, const auto& y) { together.push_back(y); }, always);
  int different = 0;
  const auto system = some_system<Entry, double>(0);
  for (int l = 0; l < width; ++l)
    fixed_run<Method, One>(system, start_of<One>(static_cast<std::size_t>(l)), t0, 0.01, 100)
        .through(
            outputs,
            [&](std::size_t n, const auto& y) {
              for (std::size_t i = 0; i < y.size(); ++i) different += y[i] != lane(together[n][i], l);
            },
            always);
  BOOST_TEST(together.size() == 3u);
  BOOST_TEST(different == 0);
}

// Outputs, events, steps and ends of more trajectories than there are lanes.
template <class Method, class Entry, int width>
void check_lanes_of_adaptive() {
  using Sys = typename Entry::template over<double>;
  constexpr std::size_t count = 2 * width + 1;
  const double times[] = {t0 + 0.01, t0 + 0.02, t0 + 1.7, t0 + 3.0};
  const event asked[] = {{event_kind::angle, 0, 0.3}, {event_kind::velocity_zero}, {event_kind::tip_height, 0, -0.5}};
  std::span<const event> events(asked);
  if constexpr (!finds_events_in_lanes<typename Method::template stepper<Sys>>) events = {};
  const lanes_task task{t0, t0 + 3.0, 1 << 20, times, events};
  const auto place = [](std::size_t n) {
    typename Method::template stepper<Sys> stepper(some_system<Entry, double>(0), -52.0);
    stepper.start(t0, start_of<Sys>(n));
    return stepper;
  };
  std::vector<std::vector<double>> together(count), alone(count);
  run_through_lanes<Method, Entry, pack<double, width>>(count, task, -52.0, place, together);
  for (std::size_t n = 0; n < count; ++n) {
    auto stepper = place(n);
    run_task_alone(stepper, task, alone[n]);
    BOOST_TEST((alone[n] == together[n]), "trajectory " << n);
  }
}

template <class List, int width = 2>
void lanes_carry_the_bits_of_runs_alone() {
  for_each<List>([]<class Entry>() {
    using Sys = typename Entry::template over<double>;
    for_each_method<fixed_methods, Sys>([]<class Method>() { check_lanes_of_fixed_step<Method, Entry, width>(); });
    for_each_method<adaptive_methods, Sys>([]<class Method>() { check_lanes_of_adaptive<Method, Entry, width>(); });
  });
}

}  // namespace conformance
