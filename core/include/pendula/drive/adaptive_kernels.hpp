// Runs of the adaptive methods, built for several machines into one program, which takes the best that its processor
// has. All give the same bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

// Not in `pendula`, which is another name for each machine (core/src/adaptive_kernels.cpp): plain data and functions.
namespace pendula_kernels {

// An event as `pendula::event` has it.
struct event_row {
  std::uint8_t kind;
  int index;
  double value, value_tail;
  bool every_turn;
  int direction;
  std::int64_t at_most;
};

struct adaptive_request {
  std::string_view system;  // of the catalogue, with its form and parameters
  std::size_t form;
  const double* parameters;
  std::string_view method;
  const double* state;
  double t0, end, log2_of_tolerance;
  std::int64_t step_limit;
};

// What a run can be taken up from: the time (head and tail) and the stepper's memory.
using step_memory = std::array<double, 24>;

// What a run tells; `y` is a state (angles, velocities).
struct receiver {
  virtual void output(double t, const double* y) = 0;
  virtual void event(int place, double t, const double* y) = 0;
  virtual void step(const step_memory& start) = 0;
  virtual bool go_on(double t, std::int64_t steps) = 0;

 protected:
  ~receiver() = default;
};

struct adaptive_outcome {
  std::uint8_t ended;  // a `pendula::outcome`
  std::int64_t steps, evaluations;
  double reached;
};

struct adaptive {
  // Outputs at the times, or, where there are none, at the start, every step and the end.
  adaptive_outcome (*solve)(const adaptive_request&, std::span<const double> times, std::span<const event_row>,
                            receiver&);
  // Outputs at the times, which follow one another from the start of a step on.
  adaptive_outcome (*revisit)(const adaptive_request&, const step_memory& from, std::span<const double> times,
                              receiver&);
};

// Those that this processor can run, the best one last.
std::span<const adaptive* const> all_adaptive();

}  // namespace pendula_kernels
