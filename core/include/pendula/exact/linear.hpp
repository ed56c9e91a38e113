// The linear pendulum in closed form: Herrera et al. (2024), eq. 11, and its derivative (9), where ω stands for ωn.
#pragma once

#include "pendula/exact/many_digits.hpp"
#include "pendula/scalar/sincos_of_half_turns.hpp"

namespace pendula {

inline many_digits natural_frequency_in_many_digits(double length, double gravity) {
  return sqrt(many_digits(gravity) / length);
}

class linear_motion {
 public:
  linear_motion(double length, double gravity) {
    const many_digits frequency = natural_frequency_in_many_digits(length, gravity);
    frequency_ = frequency.convert_to<double>();
    rate_ = words_of(frequency / pi_in_many_digits());
  }

  // The state, the time t after it was (θ, ω).
  std::array<double, 2> at(wide<double> t, double theta, double omega) const {
    if (t.hi == 0.0) return {theta, omega};
    const auto [product, product_tail] = two_product(t.hi, rate_.head);
    const auto [second, second_tail] = two_product(t.hi, rate_.middle);
    const double whole = nearest_whole(product), small = second_tail + (t.lo * rate_.head + t.hi * rate_.tail);
    const wide<double> rest(two_sum(product - whole, product_tail));
    const auto [sine, cosine] = sincos_of_half_turns(settled(rest + wide<double>(second, small)));
    const double s = parity_sign(whole) * sine, c = parity_sign(whole) * cosine;
    return {theta * c + omega / frequency_ * s, omega * c - theta * frequency_ * s};
  }
  double half_periods(double t) const { return magnitude(t * rate_.head); }

 private:
  double frequency_;
  three_words rate_;  // half periods in a second, ωn/π
};

}  // namespace pendula
