// A pendulum that is driven, for the tests: its equations depend on time.
#pragma once

#include "pendula/system/one_bob_series.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <class S>
class driven_bob_series;

// θ̈ = −(g/L) sin θ + a cos Ωt.
struct driven_bob : one_bob {
  static constexpr std::string_view name = "driven";
  static constexpr capabilities can{.conservative = false,
                                    .autonomous = false,
                                    .closed_form = false,
                                    .period = false,
                                    .mapped = false,
                                    .periodic = true};
  static constexpr std::array parameters{
      one_bob::parameters[0], gravity_row, one_bob::parameters[2],
      parameter{"drive", "rad/s^2", 1.0, range::not_negative, "amplitude a of the drive"},
      parameter{"frequency", "rad/s", 1.0, range::not_negative, "frequency Ω of the drive"}};
  static constexpr std::array forms{form{"", "point mass on a massless rod, driven", parameters}};

  template <class S>
  struct over : one_bob::over<S> {
    using state = typename one_bob::over<S>::state;
    using series = driven_bob_series<S>;

    S drive, frequency;

    template <class T>
    PENDULA_INLINE configuration<T> configuration_at(const vec<T, 1>& angles) const {
      return {-(T(this->frequency_squared) * sincos(angles[0]).sin)};
    }
    template <class T>
    PENDULA_INLINE vec<T, 1> forces(const T& t, const configuration<T>& at, const vec<T, 1>&) const {
      return {at.acceleration + T(drive) * sincos(T(frequency) * t).cos};
    }
    template <class T>
    PENDULA_INLINE vec<T, 1> accelerations(const T& t, const vec<T, 1>& angles) const {
      return forces<T>(t, configuration_at<T>(angles), {});
    }
    PENDULA_INLINE state rhs(const S& t, const state& y) const { return {y[1], accelerations<S>(t, {y[0]})[0]}; }

    S potential_energy(const state& y) const {  // without the drive
      return this->mass * this->gravity * this->length * one_minus_cos(y[0]);
    }
  };

  template <class S>
  static over<S> make(std::size_t, const S* p) {
    return {{p[0], p[1], p[2]}, p[3], p[4]};
  }
};

// Of the simple pendulum, with ω' = −(g/L) s + d and d = a cos Ωt, whose orders follow from d' = −e, e' = Ω² d.
template <class S>
class driven_bob_series : public one_bob_series<S> {
 public:
  explicit driven_bob_series(int order)
      : one_bob_series<S>(order), sine_(this->velocity_.size()), cosine_(this->velocity_.size()) {}

  PENDULA_INLINE void expand(const driven_bob::over<S>& of, const head_and_tail<S>& t, const vec<S, 2>& point,
                             const vec<S, 2>& tail, const S* inverse) {
    const auto [s, c] = sincos_with_tail(sincos(point[0]), tail[0]);
    const auto phase = sincos_with_tail(sincos(of.frequency * t.head), of.frequency * t.tail);
    S d = of.drive * phase.cos, e = of.drive * of.frequency * phase.sin;
    S* const w = this->velocity_.data();
    sine_[0] = s;
    cosine_[0] = c;
    w[0] = point[1];
    for (int k = 0; k < this->order_; ++k) {
      S of_sine(0.0), of_cosine(0.0);
      for (int j = 0; j <= k; ++j) {
        of_sine = of_sine + sine_[j] * w[k - j];
        of_cosine = of_cosine + cosine_[j] * w[k - j];
      }
      w[k + 1] = (d - of.frequency_squared * sine_[k]) * inverse[k + 1];
      sine_[k + 1] = of_cosine * inverse[k + 1];
      cosine_[k + 1] = -(of_sine * inverse[k + 1]);
      const S next = -(e * inverse[k + 1]);
      e = of.frequency * of.frequency * d * inverse[k + 1];
      d = next;
    }
  }

 private:
  std::vector<S> sine_, cosine_;
};

}  // namespace pendula::inline PENDULA_MACHINE
