// The closed forms over arrays: the loops for this machine, and more digits for the points that ask for them.
#pragma once

#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include "pendula/drive/exact_kernels.hpp"
#include "pendula/exact/linear.hpp"
#include "pendula/exact/simple_many_digits.hpp"

namespace pendula {

inline constexpr double most_half_periods =
    0x1p50;  // of |ωn t/2K|: beyond, the rounding of t itself is part of a period
inline constexpr double largest_start_angle = 0x1p50;

// Some states (θ0, ω0), one after the other, and some times for each.
struct exact_request {
  double length, gravity;
  const double* states;
  std::size_t state_count;
  const double* times;
  std::size_t time_count;
  double t0;
};

namespace detail {

inline constexpr std::size_t times_worth_a_setup = 8;

// The points of one state that need more digits; those that no digits help become NaN.
inline bool with_many_digits(const exact_request& asked, std::size_t state, const unsigned char* lacking, double* out) {
  const double theta = asked.states[2 * state], omega = asked.states[2 * state + 1];
  std::optional<simple_motion<double>> motion;
  bool all = true;
  for (std::size_t j = 0; j < asked.time_count; ++j) {
    if (!lacking[j]) continue;
    if (!motion && std::fabs(theta) < largest_start_angle)
      motion.emplace(simple_constants<double>(asked.length, asked.gravity),
                     start_of_many_digits(asked.length, asked.gravity, theta, omega));
    const wide<double> elapsed(two_sum(asked.times[j], -asked.t0));
    const bool within = motion && motion->half_periods(elapsed.hi) < most_half_periods;
    const auto point = within ? motion->at(elapsed) : simple_motion<double>::point{NAN, NAN, false};
    out[2 * j] = point.theta;
    out[2 * j + 1] = point.omega;
    all = all && within;
  }
  return all;
}

inline void time_by_time(const pendula_kernels::exact& kernels, const exact_request& asked, double* out,
                         unsigned char* lacking) {
  const std::size_t m = asked.state_count, n = asked.time_count;
  std::vector<double> then(2 * m);
  for (std::size_t j = 0; j < n; ++j) {
    std::vector<unsigned char> lacking_then(m, 0);
    kernels.states(asked.length, asked.gravity, asked.states, m, asked.times[j], asked.t0, then.data(),
                   lacking_then.data());
    for (std::size_t i = 0; i < m; ++i) {
      lacking[i * n + j] = lacking_then[i];
      std::memcpy(out + 2 * (i * n + j), then.data() + 2 * i, 2 * sizeof(double));
    }
  }
}

}  // namespace detail

// States (state_count, time_count, 2) of the simple pendulum. Where an angle or a time is too large they are NaN, and
// the result is false.
inline bool exact_simple(const pendula_kernels::exact& kernels, const exact_request& asked, double* out) {
  const std::size_t m = asked.state_count, n = asked.time_count;
  std::vector<unsigned char> lacking(m * n, 0);
  if (n == 1) {
    kernels.states(asked.length, asked.gravity, asked.states, m, asked.times[0], asked.t0, out, lacking.data());
  } else if (n < detail::times_worth_a_setup) {
    detail::time_by_time(kernels, asked, out, lacking.data());
  } else {
    for (std::size_t i = 0; i < m; ++i)
      kernels.times(asked.length, asked.gravity, asked.states + 2 * i, asked.times, n, asked.t0, out + 2 * i * n,
                    lacking.data() + i * n);
  }
  bool all = true;
  if (std::memchr(lacking.data(), 1, m * n))
    for (std::size_t i = 0; i < m; ++i)
      if (std::memchr(lacking.data() + i * n, 1, n))
        all = detail::with_many_digits(asked, i, lacking.data() + i * n, out + 2 * i * n) && all;
  return all;
}

// The same of the linear pendulum.
inline bool exact_linear(const exact_request& asked, double* out) {
  bool all = true;
  const linear_motion motion(asked.length, asked.gravity);
  for (std::size_t i = 0; i < asked.state_count; ++i)
    for (std::size_t j = 0; j < asked.time_count; ++j, out += 2) {
      const wide<double> elapsed(two_sum(asked.times[j], -asked.t0));
      const bool within = motion.half_periods(elapsed.hi) < most_half_periods;
      const auto [theta, omega] =
          within ? motion.at(elapsed, asked.states[2 * i], asked.states[2 * i + 1]) : std::array<double, 2>{NAN, NAN};
      out[0] = theta;
      out[1] = omega;
      all = all && within;
    }
  return all;
}

}  // namespace pendula
