// What comes back of runs: plain data with named fields, the same for every machine.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "pendula/drive/outcome.hpp"
#include "pendula/kernels/fault.hpp"
#include "pendula/kernels/request.hpp"

namespace pendula {

// Asked now and then by long work with the part of it that is done, 0 to 1; false ends it.
using watcher = std::function<bool(double done)>;

// A watcher of a part of the work, from one share of the whole to another.
watcher part_of(const watcher& whole, double from, double to);

// The work of a certified run that is the run itself; the rest goes into the shadow beside it.
inline constexpr double plain_share = 0.02;
// And the same of a run that is made again with its derivatives.
inline constexpr double derived_share = 0.2;

// Times and states (k, d) at which an event took place; in an ensemble, the trajectories too, rising.
struct crossings {
  std::vector<std::int64_t> trajectories;
  std::vector<double> times, states;
};

// Which way each of the joints slips from the start and from the times at which friction in one changed, (k,) and
// (k, joints): 1, −1, or 0 where it sticks. Empty for systems without such friction.
struct motion_pieces {
  std::vector<double> times, senses;
};

class dense_output;

// One run.
struct run_result {
  std::optional<fault> refused;  // then nothing was run
  outcome ended = outcome::reached_end;
  std::int64_t steps = 0, evaluations = 0;
  double reached = 0.0;               // the time up to which the run was made
  std::vector<double> times, states;  // of the outputs, (n,) and (n, d)
  std::vector<double> tails;          // what the states go on with, of runs with more digits
  std::vector<crossings> events;
  motion_pieces pieces;
  std::optional<double> trust_horizon;        // infinite: not within the run
  std::shared_ptr<const dense_output> dense;  // of methods that have it
};

// n runs with outputs at the same m times.
struct ensemble_result {
  std::optional<fault> refused;
  std::vector<outcome> ended;
  std::vector<std::int64_t> steps, evaluations;
  std::vector<double> reached;
  std::vector<double> states;       // (n, m, d); NaN where a run did not come so far
  std::vector<double> derivatives;  // by the columns asked for, (n, m, d, columns), the same
  std::vector<crossings> events;
  std::vector<double> trust_horizon;  // empty: not asked
  bool interrupted = false;
};

}  // namespace pendula
