// What the closed form takes from a state, with many digits: where next to the separatrix all but a few of k'² cancel,
// and where so many periods have passed that those of a `wide` rate do not reach.
#pragma once

#include "pendula/exact/many_digits.hpp"
#include "pendula/exact/simple.hpp"

namespace pendula::inline PENDULA_MACHINE {

inline many_digits natural_frequency_in_many_digits(double length, double gravity) {
  return sqrt(many_digits(gravity) / length);
}

struct many_digit_start {
  simple_start<double> start;
  many_digits rate;  // half periods in a second; 0 on the separatrix
};

// For |θ| < 2^50, where its own last bit is a small part of a turn.
inline many_digit_start start_of_many_digits(double length, double gravity, double theta, double omega) {
  const many_digits& pi = pi_in_many_digits();
  const many_digits turns = round(theta / (2 * pi));
  const many_digits half = theta / many_digits(2) - turns * pi,
                    frequency = natural_frequency_in_many_digits(length, gravity);
  const many_digits a = sin(half), b = omega / (2 * frequency), c = cos(half);
  const many_digits difference = c * c - b * b, k = sqrt(a * a + b * b);
  const bool rotating = difference < 0;
  const many_digits stretch = rotating ? k : many_digits(1), complement = sqrt(abs(difference)) / stretch;

  simple_start<double> y(theta, omega);
  y.turns = turns.convert_to<double>();
  y.a = a.convert_to<double>();
  y.b = b.convert_to<double>();
  y.c = c.convert_to<double>();
  y.c2 = wide_of(many_digits(c * c));
  y.complement = wide_of(complement);
  y.half_inverse = 0.5 / y.complement.hi;
  y.stretch = wide_of(stretch);
  y.rotating = rotating ? 1.0 : 0.0;
  y.spread = 1.0;  // and nothing cancelled: good at any time
  y.cancelled = 0.0;
  if (complement == 0) return {y, 0};
  const many_digits rate = half_periods_in_many_digits(complement, frequency * stretch);
  const auto [head, middle, tail] = words_of(rate);
  y.rate = {head, middle};
  y.rate_tail = tail;
  return {y, rate};
}

}  // namespace pendula::inline PENDULA_MACHINE
