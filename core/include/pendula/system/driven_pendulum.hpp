// One rigid body with friction, a driving torque and a moving pivot:
//     I θ̈ = −m g c sin θ − b ω − τc sgn ω − d |ω| ω − r ω³ + τ cos(Ω t + φ) − m c (ẍ cos θ + ÿ sin θ),
// with the pivot at (x, y) = a (cos α, sin α) cos(Ωp t + φp). All coefficients are carried per moment of inertia.
// Energy is that seen from the pivot: its motion is a force that does work.
#pragma once

#include "pendula/system/harmonic.hpp"
#include "pendula/system/one_bob_series.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <class S>
class driven_pendulum_series;

struct driven_pendulum {
  static constexpr std::string_view name = "driven";
  static constexpr capabilities can{.conservative = false,
                                    .autonomous = false,
                                    .closed_form = false,
                                    .period = false,
                                    .mapped = false,
                                    .periodic = true};
  static constexpr auto components = one_bob::components;

  // The same of every form with units.
  static constexpr std::array real{
      parameter{"viscous", "N m s", 0.0, range::not_negative, "friction torque over angular velocity"},
      parameter{"coulomb", "N m", 0.0, range::not_negative, "torque of dry friction"},
      parameter{"quadratic", "N m s^2", 0.0, range::not_negative, "drag torque over angular velocity squared"},
      parameter{"cubic", "N m s^3", 0.0, range::not_negative, "friction torque over angular velocity cubed"},
      parameter{"torque", "N m", 0.0, range::any, "amplitude of the driving torque"},
      parameter{"drive_frequency", "rad/s", 0.0, range::not_negative, "angular frequency of the driving torque"},
      parameter{"drive_phase", "rad", 0.0, range::any, "phase of the driving torque at t = 0"},
      parameter{"pivot_amplitude", "m", 0.0, range::any, "amplitude of the pivot's motion"},
      parameter{"pivot_frequency", "rad/s", 0.0, range::not_negative, "angular frequency of the pivot's motion"},
      parameter{"pivot_phase", "rad", 0.0, range::any, "phase of the pivot's motion at t = 0"},
      parameter{"pivot_direction", "rad", 1.5707963267948966, range::any,
                "direction of the pivot's motion from the x axis; a quarter turn is up and down"}};
  static constexpr auto bob = with_more(one_bob::parameters, real);
  static constexpr auto body = with_more(
      std::array{
          parameter{"mass", "kg", to_be_named, range::positive, "mass of the body"},
          parameter{"centre", "m", to_be_named, range::positive, "distance from the pivot to the centre of mass"},
          parameter{"inertia", "kg m^2", to_be_named, range::positive, "moment of inertia about the pivot"},
          gravity_row},
      real);
  static constexpr std::array scaled{
      parameter{"q", "", to_be_named, range::positive, "quality factor: the friction is ω/q"},
      parameter{"a", "", to_be_named, range::any, "amplitude of the drive"},
      parameter{"drive_frequency", "", to_be_named, range::not_negative, "angular frequency of the drive"},
      parameter{"drive_phase", "rad", 0.0, range::any, "phase of the drive at t = 0"}};
  static constexpr std::array forms{form{"bob", "point mass on a massless rod", bob},
                                    form{"body", "rigid body about a pivot", body},
                                    form{"scaled", "without units, θ̈ + θ̇/q + sin θ = a cos(Ω t + φ)", scaled}};

  template <class S>
  struct over {
    using scalar = S;
    static constexpr std::size_t dimension = 2, joints = 1;
    static constexpr int more_orders = 12;  // 0.60 ms for 1000 time units of a chaotic drive become 0.48 ms
    using state = vec<S, dimension>;
    using series = driven_pendulum_series<S>;

    S weight, inertia, length;             // m g c, I; length is drawn alone
    S frequency_squared;                   // m g c / I
    S viscous, coulomb, quadratic, cubic;  // per I
    harmonic<S> drive;                     // torque, per I
    harmonic<S> pivot;                     // m c times the pivot's acceleration, per I, turned round
    S across, along;                       // cos α, sin α
    vec<S, 1> senses = {S(1.0)};           // of the motion: 1 forward, −1 backward, 0 at rest (drive/pieces.hpp)

    // All that moves it but dry friction and drag.
    PENDULA_INLINE S smooth_torque(const head_and_tail<S>& t, const state& y) const {
      const auto [s, c] = sincos(y[0]);
      const S friction = (viscous + cubic * (y[1] * y[1])) * y[1];
      return (drive.at(t) + pivot.at(t) * (across * c + along * s)) - (frequency_squared * s + friction);
    }
    PENDULA_INLINE state rhs(const S& t, const state& y) const {
      const S drag = coulomb + quadratic * (y[1] * y[1]);
      const S still = choose(less(S(0.0), y[1]), drag, S(0.0));
      return {y[1], smooth_torque({t, S(0.0)}, y) - choose(less(y[1], S(0.0)), -drag, still)};
    }
    PENDULA_INLINE state rhs_in_piece(const S& t, const state& y) const {
      return {y[1], joints_at({t, S(0.0)}, y).accelerations[0]};
    }

    PENDULA_INLINE state canonical(const state& y) const { return y; }
    PENDULA_INLINE state from_canonical(const state& z) const { return z; }

    S kinetic_energy(const state& y) const { return S(0.5) * inertia * y[1] * y[1]; }
    S potential_energy(const state& y) const { return weight * one_minus_cos(y[0]); }
    S energy_scale() const { return weight; }
    // Of what drives it and of what friction takes, too.
    S largest_frequency_squared() const {
      return frequency_squared + viscous * viscous + drive.frequency_squared() + pivot.frequency_squared();
    }
    roughly<S> forced_amplitude_squared() const {
      const auto forced = magnitude(rough(drive.amplitude)) + magnitude(rough(pivot.amplitude));
      const auto small_swing = forced / rough(frequency_squared);
      return small_swing * small_swing;
    }

    static constexpr std::array<std::string_view, 6> power_names{"drive",   "pivot",     "viscous",
                                                                 "coulomb", "quadratic", "cubic"};
    static constexpr std::size_t works = 2;
    vec<S, 6> powers(const head_and_tail<S>& t, const state& y) const {
      const auto [s, c] = sincos(y[0]);
      const S speed = magnitude(y[1]), square = speed * speed, of = inertia * y[1], lost = inertia * square;
      return {of * drive.at(t),         of * pivot.at(t) * (across * c + along * s),
              lost * viscous,           inertia * speed * coulomb,
              lost * speed * quadratic, lost * square * cubic};
    }

    // Dry friction, per I, that can hold it; whether its friction changes where it turns round.
    vec<S, 1> holding() const { return {coulomb}; }
    std::array<bool, 1> switching() const { return {present(coulomb) || present(quadratic)}; }
    PENDULA_INLINE joint_motion<S, 1> joints_at(const head_and_tail<S>& t, const state& y) const {
      const S torque = smooth_torque(t, y), moving = senses[0] * senses[0];
      return {{torque}, {moving * (torque - senses[0] * (coulomb + quadratic * (y[1] * y[1])))}};
    }
    bool driven() const { return present(drive.amplitude) || present(pivot.amplitude); }
    // Which of its terms are there.
    std::array<bool, 5> terms() const {
      return {present(viscous), present(quadratic), present(cubic), present(drive.amplitude), present(pivot.amplitude)};
    }
    state with_joint_at_rest(const state& y, int) const { return {y[0], S(0.0)}; }

    std::array<constant<S>, 3> constants() const {
      return {{{"natural_frequency_squared", frequency_squared}, {"energy_scale", weight}, {"inertia", inertia}}};
    }
    vec<S, 1> lengths() const { return {length}; }
    std::array<vec<S, 2>, 1> positions(const state& y) const {
      const auto [s, c] = sincos(y[0]);
      return {{{length * s, -(length * c)}}};
    }
  };

  template <class S>
  static S without_rounding(const S& of_turn) {
    const roughly<S> value = rough(of_turn), zero(0.0);
    return of_turn - S(choose(less(magnitude(value), roughly<S>(0x1p-52)), value, zero));
  }

  template <class S>
  static over<S> make(std::size_t form, const S* p) {
    const S one(1.0), zero(0.0);
    if (form == 2)
      return {one, one, one, one, one / p[0], zero, zero, zero, {p[1], p[2], p[3]}, {zero, zero, zero}, zero, one};
    const bool is_bob = form == 0;
    const S length = is_bob ? p[0] : p[1], mass = is_bob ? p[2] : p[0], gravity = is_bob ? p[1] : p[3];
    const S inertia = is_bob ? mass * length * length : p[2];
    const S moment = mass * length, per = one / inertia;
    const S* const r = p + (is_bob ? 3 : 4);
    const auto [along, across] = sincos(r[10]);  // an axis is met exactly, as no double is a quarter turn
    // m c a Ωp² / I; of a bob m c / I is 1 / L
    const S acceleration = r[7] * r[8] * r[8],
            lever = is_bob ? acceleration / length : acceleration * (moment / inertia);
    const S frequency_squared = is_bob ? gravity / length : moment * gravity / inertia;
    return {moment * gravity,
            inertia,
            length,
            frequency_squared,
            r[0] * per,
            r[1] * per,
            r[2] * per,
            r[3] * per,
            {r[4] * per, r[5], r[6]},
            {lever, r[8], r[9]},
            without_rounding(across),
            without_rounding(along)};
  }
};

}  // namespace pendula::inline PENDULA_MACHINE

#include "pendula/system/driven_pendulum_series.hpp"
