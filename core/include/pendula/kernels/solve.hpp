// One run of any method of the catalogue, with its dense output and its trust horizon.
#pragma once

#include <span>

#include "pendula/kernels/result.hpp"
#include "pendula/kernels/run_kernels.hpp"

namespace pendula {

// The run that is asked for, and its trust horizon where the request says `certify`. What does not go together is
// refused (check.hpp). Runs with `digits` are those of long_runs.hpp.
run_result solve(const request&, const watcher&);

// Starts of steps, from which the motion between can be worked out again: every eighth, or fewer. All of them would
// take a sixth of a run's time, which goes into new memory.
class step_starts {
 public:
  void add(const step_motion&);
  std::size_t size() const { return width_ == 0 ? 0 : numbers_.size() / width_; }
  step_memory operator[](std::size_t i) const;
  double time(std::size_t i) const { return numbers_[i * width_]; }

 private:
  std::vector<double> numbers_;  // those of one start after the other: no more than there are, as memory is slow
  std::size_t width_ = 0;
  std::int64_t stride_ = 8, counted_ = 0;  // the stride a power of two
};

// States at any times of a run that was made.
class dense_output {
 public:
  // `last`: the state of the event that ended the run, between two bits of its time; empty where none did.
  dense_output(request run, step_starts starts, double reached, std::vector<double> last);

  double reached() const { return reached_; }  // the time up to which the run was made
  // States (n, d) at times (n,) that follow one another in the direction of the run, within it. One next to the end of
  // a step is left to the step before, which goes on to the next if the run itself did. False where `watch` ended it.
  bool at(std::span<const double> times, double* states, const watcher& watch) const;

 private:
  request run_;
  step_starts starts_;
  double reached_;
  std::vector<double> last_;
};

}  // namespace pendula
