// The linear pendulum in closed form: Herrera et al. (2024), eq. 11, and its derivative (9), where ω stands for ωn.
#pragma once

#include "pendula/scalar/sincos_of_half_turns.hpp"
#include "pendula/scalar/wide_sincos.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <class S>
class linear_motion {
 public:
  struct point {
    S theta, omega;
  };

  // From ωn with a tail, and half periods in a second, ωn/π, as three numbers (many_digits.hpp).
  linear_motion(const double frequency[2], const double rate[3], double theta, double omega)
      : theta_(theta),
        omega_(omega),
        frequency_(S(frequency[0]), S(frequency[1])),
        inverse_(wide<S>(1.0) / frequency_),
        rate_{S(rate[0]), S(rate[1]), S(rate[2])} {}

  // After the time t: with twice the digits, because of a large amplitude nearly all may cancel.
  PENDULA_INLINE point at(wide<S> t) const {
    const auto [product, product_tail] = two_product(t.hi, rate_[0]);
    const auto [second, second_tail] = two_product(t.hi, rate_[1]);
    const S whole = nearest_whole(product), sign = parity_sign(whole);
    const S small = second_tail + (t.lo * rate_[0] + t.hi * rate_[2]);
    const wide<S> rest(two_sum(product - whole, product_tail));
    const wide<S> x = wide_pi<S>::value() * settled(rest + wide<S>(second, small));
    const auto [sine, cosine] = wide_sincos(x.hi);
    const wide<S> s = scaled(sum_with_smaller(sine, cosine * x.lo), sign);
    const wide<S> c = scaled(sum_with_smaller(cosine, -(sine * x.lo)), sign);
    const S theta = rounded(quick_sum(c * theta_, s * inverse_ * omega_));
    const S omega = rounded(quick_sum(c * omega_, -(s * frequency_ * theta_)));
    const auto moved = mask_not(equal(t.hi, S(0.0)));
    return {choose(moved, theta, theta_), choose(moved, omega, omega_)};
  }

 private:
  S theta_, omega_;
  wide<S> frequency_, inverse_;
  S rate_[3];
};

}  // namespace pendula::inline PENDULA_MACHINE
