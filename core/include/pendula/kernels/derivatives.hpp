// How a run changes with its start and with the parameters: each number is followed through the whole run together with
// its derivatives (scalar/dual.hpp), across events and the switches of friction.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "pendula/kernels/result.hpp"
#include "pendula/kernels/run_kernels.hpp"

namespace pendula {

// What a run is derived by: a component of its start, counted from 0, or, from the count of components on, a parameter.
using derived_by = std::size_t;

inline constexpr std::size_t derived_at_once = 4;

// A step of a derived run: the state at a time tau after its start, (d,), and its changes, (d, derived_at_once).
struct derived_step {
  virtual double start() const = 0;  // its time
  virtual void at(double tau, double* values, double* changes) const = 0;

 protected:
  ~derived_step() = default;
};

// Whom a derived run hands its results to.
struct derivative_receiver {
  virtual void output(const derived_step&, double tau) = 0;
  // Its time and the state then, and the changes of both.
  virtual void event(int, double, const double* /*state*/, const double* /*of_time*/, const double* /*of_state*/) {}
  // After the outputs and events of each step, which the run goes on from at `stop`.
  virtual void step(const derived_step&, double /*stop*/) {}
  // Asked before the next step: a matrix (derived_at_once, derived_at_once) that the changes of all numbers are then
  // multiplied by from the right; null: none.
  virtual const double* mixing() { return nullptr; }
  virtual bool go_on(double t) = 0;

 protected:
  ~derivative_receiver() = default;
};

// The changes that a run begins with: of the state and, after it, of the parameters, (d + p, derived_at_once).
using first_changes = std::span<const double>;

struct derivative_kernel {
  // The run of a request of the Taylor method, with outputs at times of their own, those after its start: where the
  // request asks for steps of its own, at the times that a run before has told.
  run_end (*run)(const request&, std::span<const double> outputs, first_changes, derivative_receiver&);
};
const derivative_kernel& best_derivative_kernel();  // for this processor

struct crossing_derivatives {
  std::vector<double> times, states;  // (k, columns) and (k, d, columns)
};

struct run_derivatives {
  run_result run;              // but for its pieces and its dense output
  std::vector<double> states;  // of its outputs, (n, d, columns)
  std::vector<crossing_derivatives> events;
  bool interrupted = false;
};

// Of a run at outputs and events, by each of the columns: at the request's times or, where that asks for steps of its
// own, at those that the run has told.
run_derivatives derivatives_of(const request&, std::span<const double> outputs, std::span<const derived_by> columns,
                               const watcher&);

}  // namespace pendula
