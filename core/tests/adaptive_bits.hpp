// What the adaptive methods give, number by number: outputs and events of many trajectories, one by one or through
// lanes.
#pragma once

#include <vector>

#include "pendula/catalog.hpp"
#include "pendula/drive/adaptive.hpp"
#include "pendula/drive/lanes.hpp"

namespace pendula {

template <class Run>
struct teller_of_bits {
  std::vector<double>& numbers;

  bool step(const Run& run, double stop) {
    keep(run, 0.37 * stop);
    keep(run, stop);
    return true;
  }
  void event(const Run& run, int place, double tau) {
    numbers.push_back(place);
    keep(run, tau);
  }
  void keep(const Run& run, double tau) {
    numbers.push_back(run.time_after(tau));
    for (double x : run.stepper().state_of(run.stepper().after(tau))) numbers.push_back(x);
  }
};

// Of one trajectory what the lanes tell of it: events, and outputs at the task's times.
template <class Run>
struct teller_at_times {
  const lanes_task& task;
  std::vector<double>& numbers;
  std::size_t next = 0;

  bool step(const Run& run, double stop) {
    for (; next < task.times.size(); ++next) {
      const double tau = run.since_step(task.times[next]);
      if (tau * run.direction() > stop * run.direction()) break;
      keep(run, static_cast<double>(next), tau);
    }
    return true;
  }
  void event(const Run& run, int place, double tau) {
    numbers.push_back(place);
    keep(run, run.time_after(tau), tau);
  }
  void keep(const Run& run, double number, double tau) {
    numbers.push_back(number);
    for (double x : run.stepper().state_of(run.stepper().after(tau))) numbers.push_back(x);
  }
};

template <class Stepper>
void run_task_alone(Stepper& stepper, const lanes_task& task, std::vector<double>& numbers) {
  using run = adaptive_run<Stepper>;
  const auto result =
      run(stepper, task.t0, task.end, task.events)
          .to_end(task.step_limit, teller_at_times<run>{task, numbers}, [](double, auto) { return true; });
  numbers.push_back(static_cast<double>(result.steps));
  numbers.push_back(result.reached);
}

template <class Stepper>
void run_alone(Stepper& stepper, double end, std::span<const event> events, std::vector<double>& numbers) {
  using run = adaptive_run<Stepper>;
  const auto result =
      run(stepper, 0.0, end, events).to_end(1 << 20, teller_of_bits<run>{numbers}, [](double, auto) { return true; });
  numbers.push_back(static_cast<double>(result.steps));
}

template <class Place>
struct feed_of_bits {
  std::size_t count;
  Place& place;
  std::vector<std::vector<double>>& numbers;
  std::size_t taken = 0;

  template <class One>
  std::size_t next(One& one) {
    if (taken == count) return no_trajectory;
    one = place(taken);
    return taken++;
  }
  template <class State>
  void output(std::size_t n, std::size_t place_in_time, const State& y) {
    keep(n, static_cast<double>(place_in_time), y);
  }
  template <class State>
  void event(std::size_t n, int place_in_list, double t, const State& y) {
    numbers[n].push_back(place_in_list);
    keep(n, t, y);
  }
  void finish(const lane_end& told) {
    numbers[told.trajectory].push_back(static_cast<double>(told.steps));
    numbers[told.trajectory].push_back(told.reached);
  }
  bool go_on() { return true; }

  template <class State>
  void keep(std::size_t n, double number, const State& y) {
    numbers[n].push_back(number);
    numbers[n].insert(numbers[n].end(), y.begin(), y.end());
  }
};

// What lanes tell of trajectories whose starts and systems `place(n)` sets.
template <class Method, class Entry, class S, class Place>
void run_through_lanes(std::size_t count, const lanes_task& task, double log2_of_tolerance, Place&& place,
                       std::vector<std::vector<double>>& numbers) {
  using One = typename Method::template stepper<typename Entry::template over<double>>;
  using Lanes = typename Method::template stepper<typename Entry::template over<S>>;
  const std::vector<double> unit(Entry::forms[0].parameters.size(), 1.0);
  const std::vector<S> units(unit.size(), S(1.0));
  Lanes lanes(Entry::template make<S>(0, units.data()), log2_of_tolerance);
  One one(Entry::template make<double>(0, unit.data()), log2_of_tolerance);
  using Feed = feed_of_bits<std::remove_reference_t<Place>>;
  Feed feed{count, place, numbers};
  lanes_run<Lanes, One, Feed>(lanes, one, task, feed).all();
}

}  // namespace pendula
