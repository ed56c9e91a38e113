// What to run: one description for every method, alone, in lanes, with twice and with many digits. Plain data, the same
// for every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pendula/drive/event.hpp"

namespace pendula {

// A system of the catalogue: its name, the place of its form in the list of forms, and that form's parameters.
struct system_description {
  std::string name;
  std::size_t form = 0;
  std::vector<double> parameters;
};

// The options of a run; option_rows() in options.hpp has their units, ranges and meanings.
struct run_options {
  std::optional<double> step, tolerance, certify;
  std::optional<std::int64_t> max_steps, digits;
};

struct request {
  system_description system;
  std::string method;
  std::vector<double> state;  // (angles…, angular velocities…) at time t0
  double t0 = 0.0;
  std::vector<double> times;  // of the outputs, strictly monotonic from t0 on; or
  bool own_steps = false;     // the method's own steps are the outputs, and the one time is their end
  run_options options;
  std::vector<event> events;

  double end() const { return times.back(); }
  double direction() const { return end() < t0 ? -1.0 : 1.0; }
  // The step in the direction of time; 0 where the method chooses its own.
  double signed_step() const { return direction() * options.step.value_or(0.0); }
  std::int64_t step_limit() const { return options.max_steps.value_or(std::int64_t{1} << 53); }
};

// Most steps of an adaptive method as outputs where no limit is named: 400 MB.
inline constexpr std::int64_t most_own_steps = 10'000'000;
// Most outputs of a fixed-step method's own steps: 3 to 4 GB of states.
inline constexpr double most_outputs = 1e8;

inline constexpr double best_tolerance = 0x1p-52, largest_tolerance = 1e-3;
inline constexpr double largest_certify = 1.0;   // rad
inline constexpr std::int64_t most_digits = 15;  // that a double holds
inline constexpr double largest_count = 0x1p53;  // whole numbers are exact in a double up to here
inline constexpr double largest_phase = 1e-3;    // that a small swing may turn between two neighbouring times [rad]

// log2 of the tolerance of an adaptive method, to so few digits that every C library gives the same.
double log2_of_tolerance(const run_options&);

}  // namespace pendula
