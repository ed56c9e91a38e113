// The closed forms over arrays: motion, period, action, and when an angle is passed.
#pragma once

#include <span>
#include <string_view>

#include "pendula/kernels/derivatives.hpp"
#include "pendula/kernels/exact_kernels.hpp"
#include "pendula/kernels/result.hpp"

namespace pendula {

// Of a system of the catalogue that says `closed_form`, with its parameters; states are (θ, ω).
struct closed_form {
  std::string_view system;
  // States (m, n, 2) at times (n,) from states (m, 2) at t0, into `out`.
  exact_outcome (*solve)(const double* parameters, std::span<const double> states, std::span<const double> times,
                         double t0, double* out, const watcher&);
  // Derivatives (n, 2, columns) of one state's motion at times (n,); false where `watch` ended it.
  bool (*derivatives)(const double* parameters, const double* state, std::span<const double> times, double t0,
                      std::span<const derived_by> columns, double* out, const watcher&);
  // Those that follow are null where friction or a drive leaves no such thing.
  double (*period)(const double* parameters, const double* state);                 // s
  double (*action)(const double* parameters, const double* state);                 // J s
  double (*time_at)(const double* parameters, const double* state, double theta);  // from the state on [s]
};

std::span<const closed_form> closed_forms();
const closed_form* closed_form_of(std::string_view system);  // null: it has none

inline constexpr double counted_half_periods = 0x1p50;  // that three doubles count; beyond, a hundred digits do
inline constexpr double most_half_periods = 0x1p200;    // that those count; of the linear pendulum, the former
inline constexpr double largest_start_angle = 0x1p50;
inline constexpr double largest_start_speed = 0x1p900;  // in natural frequencies

bool derivatives_of_linear(const double* parameters, const double* state, std::span<const double> times, double t0,
                           std::span<const derived_by> columns, double* out, const watcher&);
bool derivatives_of_simple(const double* parameters, const double* state, std::span<const double> times, double t0,
                           std::span<const derived_by> columns, double* out, const watcher&);
bool derivatives_of_driven_linear(const double* parameters, const double* state, std::span<const double> times,
                                  double t0, std::span<const derived_by> columns, double* out, const watcher&);

// f(parameters, state) and the like for each of states (n, 2); false where `watch` ended it.
bool periods_of(const closed_form&, const double* parameters, std::span<const double> states, double* out,
                const watcher&);
bool actions_of(const closed_form&, const double* parameters, std::span<const double> states, double* out,
                const watcher&);
bool times_at(const closed_form&, const double* parameters, std::span<const double> states,
              std::span<const double> theta, double* out, const watcher&);

}  // namespace pendula
