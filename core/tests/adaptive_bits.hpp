// What the adaptive methods give, number by number: ends of many trajectories, one by one or through lanes, outputs
// between the steps, and events.
#pragma once

#include <vector>

#include "pendula/catalog.hpp"
#include "pendula/drive/adaptive.hpp"
#include "pendula/drive/lanes.hpp"

namespace pendula {

template <class Run>
struct teller_of_bits {
  std::vector<double>& numbers;
  bool dense;

  bool step(const Run& run, double stop) {
    const bool last = stop == run.since_step(run.end());
    if (dense) keep(run, 0.37 * stop);
    if (dense || last) keep(run, stop);
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

template <class Stepper>
void run_alone(Stepper& stepper, double end, std::span<const event> events, bool dense, std::vector<double>& numbers) {
  using run = adaptive_run<Stepper>;
  const auto result =
      run(stepper, 0.0, end, events).to_end(1 << 20, teller_of_bits<run>{numbers, dense}, [](double, auto) {
        return true;
      });
  numbers.push_back(static_cast<double>(result.steps));
}

// The ends, of trajectories whose starts and systems `place(n, stepper)` sets.
template <class Method, class Entry, class S, class Place>
void ends_through_lanes(std::size_t count, double end, double log2_of_tolerance, Place&& place,
                        std::vector<std::vector<double>>& numbers) {
  using One = typename Method::template stepper<typename Entry::template over<double>>;
  using Lanes = typename Method::template stepper<typename Entry::template over<S>>;
  const std::vector<double> unit(Entry::forms[0].parameters.size(), 1.0);
  const std::vector<S> units(unit.size(), S(1.0));
  Lanes lanes(Entry::template make<S>(0, units.data()), log2_of_tolerance);
  One one(Entry::template make<double>(0, unit.data()), log2_of_tolerance);
  lanes_run<Lanes, One>(lanes, one, 0.0, end, 1 << 20)
      .all(
          count, [&](std::size_t n, One& stepper) { stepper = place(n); },
          [&](const lane_end& told, const auto& y) {
            auto& mine = numbers[told.trajectory];
            mine.push_back(end);
            mine.insert(mine.end(), y.begin(), y.end());
            mine.push_back(static_cast<double>(told.steps));
          });
}

}  // namespace pendula
