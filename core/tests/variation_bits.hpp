// What runs with variations give, number by number: of double pendulums through lanes, and of numbers that carry their
// derivatives.
#pragma once

#include <vector>

#include "pendula/drive/adaptive.hpp"
#include "pendula/drive/lanes.hpp"
#include "pendula/drive/variations.hpp"
#include "pendula/scalar/dual.hpp"

namespace pendula {

inline constexpr double varied_parameters[] = {1.0, 0.8, 1.1, 0.9, 9.81};
inline constexpr double varied_times[] = {0.3, 2.0, 5.0, 31.0};

// One double pendulum after another, released from rest.
struct varied_feed {
  static constexpr std::size_t count = 16;
  std::size_t at = 0;
  std::vector<std::vector<double>> told = std::vector<std::vector<double>>(count);

  static vec<double, 4> start_of(std::size_t n) {
    return {2.9 - 0.37 * static_cast<double>(n), 0.41 * static_cast<double>(n) - 2.0, 0.1, -0.2};
  }
  template <class One>
  std::size_t next(One& one) {
    if (at == count) return no_trajectory;
    one.start(0.0, start_of(at));
    return at++;
  }
  template <class State>
  void output(std::size_t n, std::size_t, const State& y) {
    told[n].insert(told[n].end(), y.begin(), y.end());
  }
  template <class State>
  void event(std::size_t, int, double, const State&) {}
  void finish(const lane_end& end) { told[end.trajectory].push_back(static_cast<double>(end.steps)); }
  bool go_on() { return true; }
};

template <class S, int n, variation_use use>
std::vector<std::vector<double>> varied_runs() {
  using One = varied_stepper<double, n, use>;
  using Lanes = varied_stepper<S, n, use>;
  typename One::variations start{};
  typename Lanes::variations in_lanes{};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 4; ++j) {
      start[i][j] = i == j ? 1.0 : 0.25;
      in_lanes[i][j] = S(start[i][j]);
    }
  const std::vector<S> parameters(std::begin(varied_parameters), std::end(varied_parameters));
  One one(double_pendulum::make<double>(0, varied_parameters), -52.0, 0.0, start);
  Lanes lanes(double_pendulum::make<S>(0, parameters.data()), -52.0, 0.0, in_lanes);
  const lanes_task task{0.0, varied_times[3], 1 << 20, varied_times, {}};
  varied_feed feed;
  lanes_run<Lanes, One, varied_feed>(lanes, one, task, feed).all();
  return feed.told;
}

// θ, ω … and all their derivatives by the first four of start and parameters, at the end of a run.
template <class Entry>
std::vector<double> derived_run(double end) {
  using number = dual<4>;
  using Sys = typename Entry::template over<number>;
  std::vector<number> given;
  for (std::size_t i = 0; i < Sys::dimension; ++i) given.emplace_back(1.3 - 0.4 * static_cast<double>(i));
  for (std::size_t i = 0; i < Entry::forms[0].parameters.size(); ++i)
    given.emplace_back(0.6 + 0.11 * static_cast<double>(i));
  for (int i = 0; i < 4; ++i) given[static_cast<std::size_t>(i)].change.set(i, 1.0);
  taylor_stepper<Sys> stepper(Entry::template make<number>(0, given.data() + Sys::dimension), -52.0);
  typename Sys::state start;
  std::copy_n(given.begin(), start.size(), start.begin());
  stepper.start(number(0.0), start);
  struct last_state {
    std::vector<double>& numbers;
    bool step(const adaptive_run<taylor_stepper<Sys>>& run, const number& stop) {
      numbers.clear();
      for (const number& x : run.stepper().state_of(run.stepper().after(stop))) {
        numbers.push_back(x.value);
        for (int i = 0; i < 4; ++i) numbers.push_back(x.change[i]);
      }
      return true;
    }
    void event(const adaptive_run<taylor_stepper<Sys>>&, int, const number&) {}
  };
  std::vector<double> numbers;
  adaptive_run<taylor_stepper<Sys>>(stepper, 0.0, end).to_end(1 << 20, last_state{numbers}, [](double, auto) {
    return true;
  });
  return numbers;
}

}  // namespace pendula
