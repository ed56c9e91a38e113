// Many trajectories at once, built for several machines into one program, which takes the best that its processor has.
// All give the same bits, which are those of each trajectory run alone.
#pragma once

#include <cstddef>
#include <span>

#include "pendula/kernels/ensemble.hpp"
#include "pendula/kernels/run_kernels.hpp"

namespace pendula {

// Whom the trajectories of an ensemble hand their results to. Several threads may call at once, each for other
// trajectories.
struct ensemble_receiver {
  // The next trajectory to run, or no_more_work.
  virtual std::size_t next() = 0;
  virtual void output(std::size_t trajectory, std::size_t place, const double* y) = 0;
  virtual void event(std::size_t trajectory, int place, double t, const double* y) = 0;
  virtual void finish(std::size_t trajectory, const run_end&) = 0;
  virtual bool go_on() = 0;

 protected:
  ~ensemble_receiver() = default;
};

// Runs trajectories through lanes until the receiver has no more of them; false, and runs none, where it is not built
// for the method.
struct lanes_kernel {
  bool (*run)(const request&, const ensemble_rows&, ensemble_receiver&);
};

// Those that this processor runs and that may be built for the request's method, the best one last.
std::span<const lanes_kernel* const> lanes_kernels_for(const request&);

}  // namespace pendula
