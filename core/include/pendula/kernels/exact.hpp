// The closed forms over arrays: the loops for this machine, and more digits for the points that ask for them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include "pendula/exact/simple_many_digits.hpp"
#include "pendula/kernels/closed_forms.hpp"

namespace pendula::inline PENDULA_MACHINE {

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
inline constexpr std::size_t block = 65536;      // points between two looks at whether to go on: a millisecond
inline constexpr std::size_t slow_block = 1024;  // of what takes many digits: at most a tenth of a second

// One state with many digits.
class many_digit_motion {
 public:
  many_digit_motion(const exact_request& asked, std::size_t state)
      : prepared_(
            start_of_many_digits(asked.length, asked.gravity, asked.states[2 * state], asked.states[2 * state + 1])),
        motion_(simple_constants<double>(asked.length, asked.gravity), prepared_.start) {}

  simple_motion<double>::point at(double t, double t0) const {
    const wide<double> elapsed(two_sum(t, -t0));
    const double half_periods = motion_.half_periods(elapsed.hi);
    if (half_periods < counted_half_periods) return motion_.at(elapsed);
    if (!(half_periods < most_half_periods)) return {NAN, NAN, false};
    const auto [whole, parity, rest] = nearest_count(prepared_.rate * many_digits_of(elapsed));
    return motion_.at_phase(whole, parity, rest);
  }

 private:
  many_digit_start prepared_;
  simple_motion<double> motion_;
};

// The points of one state that need more digits. `refused`: some for which no digits help.
template <class GoOn>
exact_outcome with_many_digits(const exact_request& asked, std::size_t state, const unsigned char* lacking, double* out,
                               GoOn&& go_on) {
  const double fastest = largest_start_speed * std::sqrt(asked.gravity / asked.length);
  const bool able =
      std::fabs(asked.states[2 * state]) < largest_start_angle && std::fabs(asked.states[2 * state + 1]) < fastest;
  std::optional<many_digit_motion> motion;
  bool all = true;
  for (std::size_t j = 0; j < asked.time_count; ++j) {
    if (j % slow_block == slow_block - 1 && !go_on()) return exact_outcome::stopped;
    if (!lacking[j]) continue;
    if (able && !motion) motion.emplace(asked, state);
    const auto point = able ? motion->at(asked.times[j], asked.t0) : simple_motion<double>::point{NAN, NAN, false};
    out[2 * j] = point.theta;
    out[2 * j + 1] = point.omega;
    all = all && !std::isnan(point.theta);
  }
  return all ? exact_outcome::complete : exact_outcome::refused;
}

// Many states at each of a few times.
template <class GoOn>
bool time_by_time(const exact_kernel& kernels, const exact_request& asked, double* out, unsigned char* lacking,
                  GoOn&& go_on) {
  const std::size_t n = asked.time_count;
  std::vector<double> then(n == 1 ? 0 : 2 * block);
  std::vector<unsigned char> lacking_then(n == 1 ? 0 : block);
  for (std::size_t first = 0; first < asked.state_count; first += block) {
    const std::size_t m = std::min(block, asked.state_count - first);
    const auto at_time = [&](std::size_t j, double* to, unsigned char* lacks) {
      kernels.states(asked.length, asked.gravity, asked.states + 2 * first, m, asked.times[j], asked.t0, to, lacks);
    };
    if (n == 1) at_time(0, out + 2 * first, lacking + first);
    for (std::size_t j = 0; n > 1 && j < n; ++j) {
      std::memset(lacking_then.data(), 0, m);
      at_time(j, then.data(), lacking_then.data());
      for (std::size_t i = 0; i < m; ++i) {
        lacking[(first + i) * n + j] = lacking_then[i];
        std::memcpy(out + 2 * ((first + i) * n + j), then.data() + 2 * i, 2 * sizeof(double));
      }
    }
    if (!go_on()) return false;
  }
  return true;
}

// Many times for each of some states.
template <class GoOn>
bool state_by_state(const exact_kernel& kernels, const exact_request& asked, double* out, unsigned char* lacking,
                    GoOn&& go_on) {
  const std::size_t n = asked.time_count;
  std::size_t points = 0;
  for (std::size_t i = 0; i < asked.state_count; ++i)
    for (std::size_t first = 0; first < n; first += block) {
      const std::size_t count = std::min(block, n - first), place = i * n + first;
      kernels.times(asked.length, asked.gravity, asked.states + 2 * i, asked.times + first, count, asked.t0,
                    out + 2 * place, lacking + place);
      if ((points += count) < block) continue;
      points = 0;
      if (!go_on()) return false;
    }
  return true;
}

}  // namespace detail

// States (state_count, time_count, 2) of the simple pendulum. `go_on` is asked now and then whether to.
template <class GoOn>
exact_outcome exact_simple(const exact_kernel& kernels, const exact_request& asked, double* out, GoOn&& go_on) {
  const std::size_t m = asked.state_count, n = asked.time_count;
  std::vector<unsigned char> lacking(m * n, 0);
  const bool done = n < detail::times_worth_a_setup
                        ? detail::time_by_time(kernels, asked, out, lacking.data(), go_on)
                        : detail::state_by_state(kernels, asked, out, lacking.data(), go_on);
  if (!done) return exact_outcome::stopped;
  if (m * n == 0 || std::memchr(lacking.data(), 1, m * n) == nullptr) return exact_outcome::complete;
  bool all = true;
  std::size_t slow = 0;
  for (std::size_t i = 0; i < m; ++i) {
    if (std::memchr(lacking.data() + i * n, 1, n) == nullptr) continue;
    const auto outcome = detail::with_many_digits(asked, i, lacking.data() + i * n, out + 2 * i * n, go_on);
    if (outcome == exact_outcome::stopped) return outcome;
    all = all && outcome == exact_outcome::complete;
    if (++slow % detail::slow_block == 0 && !go_on()) return exact_outcome::stopped;
  }
  return all ? exact_outcome::complete : exact_outcome::refused;
}

// The same of the linear pendulum.
template <class GoOn>
exact_outcome exact_linear(const exact_kernel& kernels, const exact_request& asked, double* out, GoOn&& go_on) {
  const many_digits frequency = natural_frequency_in_many_digits(asked.length, asked.gravity);
  const auto [head, tail] = wide_of(frequency);
  const auto [rate, middle, rest] = words_of(frequency / pi_in_many_digits());
  const double frequency_words[2] = {head, tail}, rate_words[3] = {rate, middle, rest};
  const auto within = [&](double t) { return std::fabs(t - asked.t0) * rate < counted_half_periods; };
  const double* const last = asked.times + asked.time_count;
  if (asked.state_count == 0) return exact_outcome::complete;
  const double fastest = largest_start_speed * frequency_words[0];
  for (std::size_t i = 0; i < asked.state_count; ++i)
    if (!(std::fabs(asked.states[2 * i]) < largest_start_speed && std::fabs(asked.states[2 * i + 1]) < fastest)) {
      std::fill_n(out, 2 * asked.state_count * asked.time_count, 0.0);
      std::fill_n(out + 2 * i * asked.time_count, 2 * asked.time_count, NAN);
      return exact_outcome::refused;
    }
  if (const double* far = std::find_if_not(asked.times, last, within); far != last) {
    std::fill_n(out, 2 * asked.state_count * asked.time_count, 0.0);
    out[2 * (far - asked.times)] = NAN;  // marks which
    return exact_outcome::refused;
  }
  std::size_t points = 0;
  for (std::size_t i = 0; i < asked.state_count; ++i)
    for (std::size_t first = 0; first < asked.time_count; first += detail::block) {
      const std::size_t count = std::min(detail::block, asked.time_count - first), place = i * asked.time_count + first;
      kernels.linear(frequency_words, rate_words, asked.states + 2 * i, asked.times + first, count, asked.t0,
                     out + 2 * place);
      if ((points += count) < detail::block) continue;
      points = 0;
      if (!go_on()) return exact_outcome::stopped;
    }
  return exact_outcome::complete;
}

}  // namespace pendula::inline PENDULA_MACHINE
