// What a step adds to an angle and its velocity, summed so that it is there soon: every fourth order for itself (after
// Estrin 1960), four sums side by side.
#pragma once

#include <array>
#include <concepts>

#include "pendula/scalar/pack.hpp"

namespace pendula::inline PENDULA_MACHINE {

namespace detail {

// The first numbers of an array that has so many left; zero where there is none.
template <class T, class S>
PENDULA_INLINE T numbers_of(const S* from, int left) {
  T numbers(S(0.0));
  if constexpr (std::same_as<T, S>) {
    if (left > 0) numbers = *from;
  } else if (left >= lanes<T>::count) {
    __builtin_memcpy(&numbers, from, sizeof(T));
  } else {
    for (int i = 0; i < left; ++i) numbers.set(i, from[i]);
  }
  return numbers;
}

// Of angle and velocity, the sums over orders first, first + 4 … in powers of h⁴, even and odd ones side by side; with
// T four doubles, those of four neighbours at once.
template <class T, class S>
PENDULA_INLINE std::array<T, 2> sums_of_fourths(int order, const S* velocity, const S* inverse, int first,
                                                const S& fourth_power) {
  const T fourth(fourth_power), eighth = fourth * fourth;
  int k = (order - 1) / 4 * 4 + first;
  const int left = order - k;
  T angle = numbers_of<T>(velocity + k, left) * numbers_of<T>(inverse + k + 1, left);
  T speed = numbers_of<T>(velocity + k + 1, left), other_angle(S(0.0)), other_speed(S(0.0));
  for (k -= 4; k >= 0; k -= 4) {
    const T next_angle = other_angle * eighth + numbers_of<T>(velocity + k, 4) * numbers_of<T>(inverse + k + 1, 4);
    const T next_speed = other_speed * eighth + numbers_of<T>(velocity + k + 1, 4);
    other_angle = angle;
    other_speed = speed;
    angle = next_angle;
    speed = next_speed;
  }
  return {angle + other_angle * fourth, speed + other_speed * fourth};
}

}  // namespace detail

// Added to (θ, ω) in a time h, by the orders of the velocity from 0 to `order`; inverse[k] is 1/k.
template <class S>
PENDULA_INLINE vec<S, 2> increment_by_fourths(int order, const S* velocity, const S* inverse, const S& h) {
  const S square = h * h, fourth = square * square;
  const auto joined = [&](const auto& x) { return ((x[0] + x[1] * h) + (x[2] + x[3] * h) * square) * h; };
  if constexpr (std::same_as<S, double>) {
    const auto [angle, speed] = detail::sums_of_fourths<pack<double, 4>>(order, velocity, inverse, 0, fourth);
    return {joined(angle), joined(speed)};
  } else {
    vec<S, 4> angle, speed;
    for (int first = 0; first < 4; ++first) {
      const auto [of_angle, of_speed] = detail::sums_of_fourths<S>(order, velocity, inverse, first, fourth);
      angle[static_cast<std::size_t>(first)] = of_angle;
      speed[static_cast<std::size_t>(first)] = of_speed;
    }
    return {joined(angle), joined(speed)};
  }
}

}  // namespace pendula::inline PENDULA_MACHINE
