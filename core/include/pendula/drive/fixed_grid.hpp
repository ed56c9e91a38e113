// The grid t0 + n h of a fixed-step method, and the outputs on it or one shortened step off it.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "pendula/build.hpp"
#include "pendula/drive/outcome.hpp"

namespace pendula::inline PENDULA_MACHINE {

// An output is the state after `steps` whole steps from t0 and, where `rest` is not 0, one step of that length.
struct fixed_output {
  std::int64_t steps;
  double rest;
};

inline constexpr double on_grid = 1e-9;       // of a step: nearer outputs are taken to lie on the grid
inline constexpr double most_steps = 0x1p53;  // whole numbers are exact up to here

// Where time t lies on the grid of steps h (negative: backward) from t0. |t − t0| / |h| must not pass most_steps.
inline fixed_output place_on_grid(double t, double t0, double h) {
  const double position = (t - t0) / h, nearest = std::nearbyint(position);
  // a step such as 1e-5 is itself rounded: after many of them a multiple of it is off by as many roundings
  if (std::fabs(position - nearest) <= on_grid + 0x1p-52 * std::fabs(nearest))
    return {static_cast<std::int64_t>(nearest), 0.0};
  const double whole = std::floor(position);
  return {static_cast<std::int64_t>(whole), (t - t0) - whole * h};
}

struct fixed_plan {
  std::vector<double> times;
  std::vector<fixed_output> outputs;
};

// Outputs at the times asked for, which follow one another in the direction of the step.
inline fixed_plan requested_times(double t0, double step, std::span<const double> times) {
  fixed_plan plan{{times.begin(), times.end()}, {}};
  plan.outputs.reserve(times.size());
  for (double t : times) plan.outputs.push_back(place_on_grid(t, t0, step));
  return plan;
}

// Outputs at the method's own steps from t0 to `end`, the last of them shortened where the grid misses it.
inline fixed_plan own_steps(double t0, double step, double end) {
  const fixed_output last = place_on_grid(end, t0, step);
  fixed_plan plan;
  for (std::int64_t n = 0; n <= last.steps; ++n) {
    plan.times.push_back(t0 + static_cast<double>(n) * step);
    plan.outputs.push_back({n, 0.0});
  }
  if (last.rest != 0.0) {
    plan.times.push_back(end);
    plan.outputs.push_back(last);
  }
  plan.times.back() = end;
  return plan;
}

// The time up to which a run was made that came so many steps on the grid, and maybe beside it to its last output.
inline double time_reached(outcome ended, std::int64_t steps, double t0, double step, double last_output, double end) {
  if (ended == outcome::reached_end) return end;
  const double after_steps = t0 + static_cast<double>(steps) * step;
  return step < 0.0 ? std::fmin(after_steps, last_output) : std::fmax(after_steps, last_output);
}

}  // namespace pendula::inline PENDULA_MACHINE
