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

// Whom a derived run hands its results to: the changes of each component of a state, and of the time of an event.
struct derivative_receiver {
  virtual void output(const double* changes) = 0;  // (d, derived_at_once)
  virtual void event(int place, const double* of_time, const double* of_state) = 0;
  virtual bool go_on(double t) = 0;

 protected:
  ~derivative_receiver() = default;
};

// The run of a request of the Taylor method, with outputs at times of their own; columns beyond those asked are empty.
struct derivative_kernel {
  outcome (*run)(const request&, std::span<const double> outputs, std::span<const derived_by> columns,
                 derivative_receiver&);
};
const derivative_kernel& best_derivative_kernel();  // for this processor

struct crossing_derivatives {
  std::vector<double> times, states;  // (k, columns) and (k, d, columns)
};

struct run_derivatives {
  std::vector<double> states;  // (n, d, columns)
  std::vector<crossing_derivatives> events;
  bool interrupted = false;
};

// Of a run that was made, at its outputs and events, by each of the columns.
run_derivatives derivatives_of(const request&, std::span<const double> outputs, std::span<const derived_by> columns,
                               const watcher&);

}  // namespace pendula
