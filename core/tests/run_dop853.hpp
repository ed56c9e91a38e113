// Runs of DOP853 for its tests.
#pragma once

#include <cmath>
#include <vector>

#include "pendula/drive/adaptive.hpp"
#include "pendula/method/dop853.hpp"
#include "pendula/system/double_pendulum.hpp"
#include "pendula/system/linear_pendulum.hpp"

using oscillator = pendula::linear_pendulum::over<double>;
using rods = pendula::double_pendulum::over<double>;

inline const double unit[] = {1.0, 1.0, 1.0};
inline const double of_rods[] = {1.0, 1.0, 1.0, 1.0, 9.81};
inline const auto always = [](auto, auto) { return true; };

template <class State>
double distance(const State& a, const State& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (const double apart = std::fabs(a[i] - b[i]); !(apart <= most)) most = apart;  // not a number is far, too
  return most;
}

// Keeps the states at the times asked for, in their order.
template <class State>
struct keeper {
  std::vector<double> times;
  std::vector<State> states = {};

  void event(const auto&, int, double) {}
  bool step(const auto& run, double stop) {
    for (; states.size() < times.size();) {
      const double tau = run.since_step(times[states.size()]);
      if (tau * run.direction() > stop * run.direction()) break;
      states.push_back(run.stepper().state_of(run.stepper().after(tau)));
    }
    return true;
  }
};

// Keeps the times of events.
struct notebook {
  std::vector<double> times = {};
  void event(const auto& run, int, double tau) { times.push_back(run.time_after(tau)); }
  bool step(const auto&, double) { return true; }
};

template <class Sys>
struct outputs {
  std::vector<typename Sys::state> states;
  pendula::adaptive_result result;
};
template <class Sys>
outputs<Sys> run(const Sys& system, const typename Sys::state& y, std::vector<double> times, double log2_of_tolerance) {
  pendula::dop853_stepper<Sys> stepper(system, log2_of_tolerance);
  stepper.start(0.0, y);
  keeper<typename Sys::state> kept{times};
  const auto result = pendula::adaptive_run(stepper, 0.0, times.back()).to_end(1000000, kept, always);
  typename Sys::state none;
  none.fill(std::nan(""));
  kept.states.resize(times.size(), none);
  return {kept.states, result};
}
