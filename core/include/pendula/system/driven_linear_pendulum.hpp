// The linear pendulum with viscous friction and a harmonic drive: m L² (θ̈ + (g/L) θ) = −b ω + τ cos(Ω t + φ).
#pragma once

#include "pendula/system/driven_pendulum.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <class S>
class driven_linear_pendulum_series;

struct driven_linear_pendulum : one_bob {
  static constexpr std::string_view name = "driven-linear";
  static constexpr capabilities can{.conservative = false,
                                    .autonomous = false,
                                    .closed_form = true,
                                    .period = false,
                                    .mapped = false,
                                    .periodic = false};
  static constexpr std::array parameters =
      with_more(one_bob::parameters, std::array{driven_pendulum::real[0], driven_pendulum::real[4],
                                                driven_pendulum::real[5], driven_pendulum::real[6]});
  static constexpr std::array forms{form{"", "point mass on a massless rod, with friction and a drive", parameters}};

  template <class S>
  struct over : one_bob::over<S> {
    using state = typename one_bob::over<S>::state;
    using series = driven_linear_pendulum_series<S>;

    S viscous;          // per moment of inertia
    harmonic<S> drive;  // torque, per moment of inertia

    PENDULA_INLINE state rhs(const S& t, const state& y) const {
      return {y[1], drive.at({t, S(0.0)}) - (this->frequency_squared * y[0] + viscous * y[1])};
    }
    // not in canonical variables, which the methods for conservative systems take
    void velocities() = delete;
    void forces() = delete;

    S potential_energy(const state& y) const {
      return S(0.5) * this->mass * this->gravity * this->length * y[0] * y[0];
    }
    static constexpr std::array<std::string_view, 2> power_names{"drive", "viscous"};
    static constexpr std::size_t works = 1;
    vec<S, 2> powers(const head_and_tail<S>& t, const state& y) const {
      const S of = this->mass * this->length * this->length * y[1];
      return {of * drive.at(t), of * y[1] * viscous};
    }
    S largest_frequency_squared() const {
      return this->frequency_squared + viscous * viscous + drive.frequency_squared();
    }
    roughly<S> forced_amplitude_squared() const {
      const auto forced = rough(drive.amplitude) / rough(this->frequency_squared);
      return forced * forced;
    }
  };

  template <class S>
  static over<S> make(std::size_t, const S* p) {
    const S per = S(1.0) / (p[2] * p[0] * p[0]);
    return {{p[0], p[1], p[2]}, p[3] * per, {p[4] * per, p[5], p[6]}};
  }
};

// θ' = ω, ω' = −(g/L) θ − b ω + the drive.
template <class S>
class driven_linear_pendulum_series : public one_bob_series<S> {
 public:
  using one_bob_series<S>::one_bob_series;

  PENDULA_INLINE void expand(const driven_linear_pendulum::over<S>& of, const head_and_tail<S>& t,
                             const vec<S, 2>& point, const vec<S, 2>&, const S* inverse) {
    S* const w = this->velocity_.data();
    harmonic_series<S> drive;
    drive.start(of.drive, t);
    S angle = point[0];
    w[0] = point[1];
    for (int k = 0; k < this->order_; ++k) {
      w[k + 1] = (drive.order() - (of.frequency_squared * angle + of.viscous * w[k])) * inverse[k + 1];
      angle = w[k] * inverse[k + 1];
      drive.advance(sine_with_cosine<S>::factor(inverse[k + 1]));
    }
  }
};

}  // namespace pendula::inline PENDULA_MACHINE
