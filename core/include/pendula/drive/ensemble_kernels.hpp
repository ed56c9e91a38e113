// Many trajectories at once, built for several machines into one program, which takes the best that its processor has.
// All give the same bits, which are those of each trajectory run alone.
#pragma once

#include "pendula/drive/adaptive_kernels.hpp"
#include "pendula/drive/fixed_kernels.hpp"

namespace pendula_kernels {

struct ensemble_request {
  std::string_view system;  // of the catalogue, with its form and parameters
  std::size_t form;
  const double* parameters;
  std::size_t parameters_apart;  // from one trajectory's to the next one's; 0: all have the same system
  std::string_view method;
  const double* states;  // (angles, velocities) of one trajectory after another
  double t0, end;
  double step;               // of a method of fixed step, 0 for the others; negative: backward
  double log2_of_tolerance;  // of an adaptive one
  std::int64_t step_limit;
  std::span<const double> times;      // of the outputs, which follow one another from t0 on
  std::span<const event_row> events;  // of an adaptive method
};

// What an ensemble tells. Several threads may tell and ask at once, each of other trajectories.
struct ensemble_receiver {
  // The next trajectory to run, or none: `no_more`.
  virtual std::size_t next() = 0;
  virtual void output(std::size_t trajectory, std::size_t place, const double* y) = 0;
  virtual void event(std::size_t trajectory, int place, double t, const double* y) = 0;
  // How it ended, a `pendula::outcome`, and the time up to which its motion is known.
  virtual void finish(std::size_t trajectory, std::uint8_t ended, std::int64_t steps, double reached) = 0;
  virtual bool go_on() = 0;

 protected:
  ~ensemble_receiver() = default;
};

inline constexpr std::size_t no_more = static_cast<std::size_t>(-1);

// Runs trajectories through lanes until the receiver has no more of them; false, and runs none, where it is not built
// for the method. `places` are those of the times on the grid of a method of fixed step.
struct lanes_kernel {
  bool (*run)(const ensemble_request&, std::span<const fixed_place> places, ensemble_receiver&);
};

// Runs trajectories of any method until the receiver has no more of them: through lanes, or one by one
// where the lanes do not find its events. `dimension` is that of a state.
void run_ensemble(const ensemble_request&, std::size_t dimension, ensemble_receiver&);

}  // namespace pendula_kernels
