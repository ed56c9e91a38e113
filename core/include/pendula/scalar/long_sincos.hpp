// Sine and cosine of numbers of many words, by their power series near zero and the formulas of the double angle.
#pragma once

#include <vector>

#include "pendula/scalar/long_number.hpp"

namespace pendula::inline PENDULA_MACHINE {

namespace detail {

// 1/1, −1/(2·3), −1/(4·5), … for the sine, and 1/1, −1/(3·4), −1/(5·6), … for 2 (1 − cosine)/x².
template <int words>
struct long_constants {
  using S = long_number<words>;
  static constexpr int halvings = 12;
  S half_pi, of_halvings{std::ldexp(1.0, -halvings)};
  std::vector<S> sine, cosine;

  long_constants() {
    // Machin (1706): π/4 = 4 arctan 1/5 − arctan 1/239
    const S quarter = S(4.0) * arctangent_of_inverse(5.0) - arctangent_of_inverse(239.0);
    half_pi = quarter + quarter;
    double log2_of_term = 0.0;
    for (double k = 2.0; log2_of_term > -64.0 * words; k += 2.0) {
      sine.push_back(-(S(1.0) / S(k * (k + 1.0))));
      cosine.push_back(-(S(1.0) / S((k + 1.0) * (k + 2.0))));
      log2_of_term -= 2.0 * halvings + std::log2(k * (k + 1.0));
    }
  }

  static S arctangent_of_inverse(double x) {
    S power = S(1.0) / S(x), sum = power;
    const S square = power * power;
    for (double k = 3.0; power.rough_log2() > -64.0 * words; k += 2.0) {
      power = -(power * square);
      sum = sum + power / S(k);
    }
    return sum;
  }

  static const long_constants& here() {
    static const long_constants all;
    return all;
  }
};

}  // namespace detail

template <int words>
struct elementary<long_number<words>> {
  using S = long_number<words>;

  static double rough(const S& x) { return x.rounded(); }
  static double rough_log2(const S& x) { return x.rough_log2(); }

  // For |x| < 2^50, with an error in parts of the last word of x.
  [[gnu::noinline]] static sine_cosine<S> sincos(const S& x) {
    const auto& constants = detail::long_constants<words>::here();
    const double quarters = std::nearbyint(x.rounded() * 0x1.45f306dc9c883p-1);  // 2/π
    const S angle = (x - S(quarters) * constants.half_pi) * constants.of_halvings, square = angle * angle;
    const S one(1.0), two(2.0);
    S of_sine = one, of_cosine = one;
    for (std::size_t i = constants.sine.size(); i-- > 0;) {
      of_sine = one + square * constants.sine[i] * of_sine;
      of_cosine = one + square * constants.cosine[i] * of_cosine;
    }
    // cos − 1 in place of cos keeps the digits: sin 2x = 2 sin x (1 + (cos x − 1)), cos 2x − 1 = −2 sin² x
    S sine = angle * of_sine, versed = S(-0.5) * square * of_cosine;
    for (int i = 0; i < detail::long_constants<words>::halvings; ++i) {
      const S doubled = two * sine, next = -(doubled * sine);
      sine = doubled + doubled * versed;
      versed = next;
    }
    return turned(static_cast<std::int64_t>(quarters), sine, one + versed);
  }

 private:
  static sine_cosine<S> turned(std::int64_t quarters, const S& sine, const S& cosine) {
    switch (quarters & 3) {
      case 0:
        return {sine, cosine};
      case 1:
        return {cosine, -sine};
      case 2:
        return {-sine, -cosine};
      default:
        return {-cosine, sine};
    }
  }
};

}  // namespace pendula::inline PENDULA_MACHINE
