// Runs of one trajectory, built for several machines into one program, which takes the best that its processor has. All
// give the same bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "pendula/drive/outcome.hpp"
#include "pendula/kernels/request.hpp"

namespace pendula {

// What a run can be taken up from: the time (head and tail) and the stepper's memory, so many numbers.
struct step_memory {
  std::array<double, 24> numbers;
  std::size_t count;
};

struct two_doubles {  // an unevaluated sum
  double head, tail;
};

// The step that an adaptive run stands in, and the motion inside it.
struct step_motion {
  virtual two_doubles start() const = 0;                  // its time
  virtual double stop() const = 0;                        // up to here after it the motion is the run's
  virtual double time_after(double tau) const = 0;        // since the start
  virtual void angles(double tau, double* to) const = 0;  // at that time
  virtual void state(double tau, double* to) const = 0;
  virtual void remember(step_memory& to) const = 0;

 protected:
  ~step_motion() = default;
};

// Whom a run hands its results to; `y` is a state (angles, velocities).
struct receiver {
  // An output, by its place among them; false ends the run.
  virtual bool output(std::size_t place, double t, const double* y) = 0;
  virtual void event(int place, double t, const double* y) = 0;
  // Which way each joint slips from that time on, the start's and then each at which friction in one changes: 1 or −1,
  // or 0: it sticks.
  virtual void piece(double, std::span<const double>) {}
  virtual bool step(const step_motion&) = 0;  // of an adaptive method; false ends the run
  virtual bool go_on(double t) = 0;           // asked every few milliseconds

 protected:
  ~receiver() = default;
};

struct run_end {
  outcome ended = outcome::reached_end;
  std::int64_t steps = 0, evaluations = 0;
  double reached = 0.0;
};

// A run with a fixed step that goes on as often as it is asked.
struct grid_walk {
  virtual ~grid_walk() = default;
  virtual std::unique_ptr<grid_walk> copy() const = 0;
  virtual bool go_to(std::int64_t steps) = 0;  // in all, no fewer than it took; false: numbers are not finite there
  virtual std::int64_t steps() const = 0;
  virtual void state(double rest, double* to) const = 0;  // a shortened step of that length later; 0: where it stands
};

struct run_kernel {
  run_end (*solve)(const request&, receiver&);
  // The motion again at the request's times, which follow one another from the start of a step on; null where the
  // method knows nothing of the motion inside its steps.
  run_end (*revisit)(const request&, const step_memory& from, receiver&);
  // A run that stands at its start; null for methods that choose their steps.
  std::unique_ptr<grid_walk> (*walk)(const request&);
};

// The kernel of this processor for the request's method. Requests are checked before.
const run_kernel& kernel_for(const request&);

}  // namespace pendula
