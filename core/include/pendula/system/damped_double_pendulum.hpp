// The planar double pendulum with friction in its joints: joint 1 turns with v1 = ω1, joint 2 with v2 = ω2 − ω1, and
// friction exerts f_j = −b_j v_j − τ_j sgn v_j in them. The generalised torques Q1 = f1 − f2, Q2 = f2 come to the
// right-hand sides of the equations of motion (double_pendulum.hpp).
#pragma once

#include "pendula/system/double_pendulum.hpp"
#include "pendula/system/harmonic.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <class S>
class damped_double_pendulum_series;

struct damped_double_pendulum {
  static constexpr std::string_view name = "damped-double";
  static constexpr capabilities can{.conservative = false,
                                    .autonomous = true,
                                    .closed_form = false,
                                    .period = false,
                                    .mapped = false,
                                    .periodic = true};
  static constexpr auto components = double_pendulum::components;

  static constexpr std::array real{
      parameter{"viscous1", "N m s", 0.0, range::not_negative, "friction torque over angular velocity in the pivot"},
      parameter{"viscous2", "N m s", 0.0, range::not_negative, "friction torque over relative velocity in the joint"},
      parameter{"coulomb1", "N m", 0.0, range::not_negative, "torque of dry friction in the pivot"},
      parameter{"coulomb2", "N m", 0.0, range::not_negative, "torque of dry friction in the joint"}};
  static constexpr auto rods = with_more(double_pendulum::rods, real);
  static constexpr auto bobs = with_more(double_pendulum::bobs, real);
  static constexpr auto bodies = with_more(double_pendulum::bodies, real);
  static constexpr std::array forms{form{"rods", "two uniform rods, with friction in the joints", rods},
                                    form{"bobs", "two bobs on massless rods, with friction in the joints", bobs},
                                    form{"bodies", "two rigid bodies, with friction in the joints", bodies}};

  template <class S>
  struct over {
    using scalar = S;
    static constexpr std::size_t dimension = 4, joints = 2;
    using state = vec<S, dimension>;
    using series = damped_double_pendulum_series<S>;

    double_pendulum::over<S> ideal;
    vec<S, 2> viscous, coulomb;
    vec<S, 2> senses = {S(1.0), S(1.0)};  // of the joints: drive/pieces.hpp

    PENDULA_INLINE state rhs(const S&, const state& y) const { return slope(y, {sign_of(y[2]), sign_of(y[3] - y[2])}); }
    PENDULA_INLINE state rhs_in_piece(const S& t, const state& y) const {
      if (present(senses[0]) && present(senses[1])) return slope(y, senses);
      const auto [first, second] = joints_at({t, S(0.0)}, y).accelerations;
      return {y[2], y[3], first, first + second};
    }

    PENDULA_INLINE state canonical(const state& y) const { return ideal.canonical(y); }
    PENDULA_INLINE state from_canonical(const state& z) const { return ideal.from_canonical(z); }

    S kinetic_energy(const state& y) const { return ideal.kinetic_energy(y); }
    S potential_energy(const state& y) const { return ideal.potential_energy(y); }
    S energy_scale() const { return ideal.energy_scale(); }
    // That of what friction takes, too: the trace of its matrix over the mass matrix, at δ = 0.
    S largest_frequency_squared() const {
      const S two(2.0), of_first = ideal.B * (viscous[0] + viscous[1]), of_second = ideal.A * viscous[1];
      const S rate = (of_first + two * ideal.C * viscous[1] + of_second) / ideal.determinant_floor;
      return ideal.largest_frequency_squared() + rate * rate;
    }

    static constexpr std::array<std::string_view, 4> power_names{"viscous1", "viscous2", "coulomb1", "coulomb2"};
    static constexpr std::size_t works = 0;
    vec<S, 4> powers(const head_and_tail<S>&, const state& y) const {
      const S first = magnitude(y[2]), second = magnitude(y[3] - y[2]);
      return {viscous[0] * first * first, viscous[1] * second * second, coulomb[0] * first, coulomb[1] * second};
    }

    vec<S, 2> holding() const { return coulomb; }
    std::array<bool, 2> switching() const { return {present(coulomb[0]), present(coulomb[1])}; }
    bool driven() const { return false; }
    // In the coordinates θ1 and θ2 − θ1, on whose velocities friction acts, the mass matrix is n11, n12, n12, n22.
    joint_motion<S, 2> joints_at(const head_and_tail<S>&, const state& y) const {
      const parts at = parts_of(y);
      const S n12 = ideal.B + at.coupling, n11 = (ideal.A + at.coupling) + n12, n22 = ideal.B, zero(0.0);
      const S both = at.torque1 + at.torque2, f1 = friction(0, y[2], senses[0]),
              f2 = friction(1, y[3] - y[2], senses[1]);
      const bool slips1 = present(senses[0]), slips2 = present(senses[1]);
      if (slips1 && slips2) {
        const state slopes = slope(y, senses);
        return {{zero, zero}, {slopes[2], slopes[3] - slopes[2]}};
      }
      const S first = slips1 ? (both + f1) / n11 : zero, second = slips2 ? (at.torque2 + f2) / n22 : zero;
      return {{both - n12 * second, at.torque2 - n12 * first}, {first, second}};
    }
    state with_joint_at_rest(const state& y, int joint) const {
      return joint == 0 ? state{y[0], y[1], S(0.0), y[3]} : state{y[0], y[1], y[2], y[2]};
    }

    std::array<constant<S>, 7> constants() const { return ideal.constants(); }
    vec<S, 2> lengths() const { return ideal.lengths(); }
    std::array<vec<S, 2>, 2> positions(const state& y) const { return ideal.positions(y); }

   private:
    struct parts {
      S coupling, turning;  // C cos δ, C sin δ
      S torque1, torque2;   // without friction
    };
    PENDULA_INLINE parts parts_of(const state& y) const {
      const auto [first, second] = sincos(y[0], y[1]);
      const S turning = ideal.C * (first.sin * second.cos - first.cos * second.sin);
      const S coupling = ideal.C * (first.cos * second.cos + first.sin * second.sin);
      return {coupling, turning, -(turning * (y[3] * y[3]) + ideal.D * first.sin),
              turning * (y[2] * y[2]) - ideal.E * second.sin};
    }
    PENDULA_INLINE S friction(int joint, const S& velocity, const S& sense) const {
      return -(viscous[joint] * velocity + sense * coulomb[joint]);
    }
    PENDULA_INLINE static S sign_of(const S& x) {
      const S zero(0.0);
      return choose(less(zero, x), S(1.0), choose(less(x, zero), S(-1.0), zero));
    }
    PENDULA_INLINE state slope(const state& y, const vec<S, 2>& slips) const {
      const parts at = parts_of(y);
      const S f2 = friction(1, y[3] - y[2], slips[1]);
      const S q1 = at.torque1 + (friction(0, y[2], slips[0]) - f2), q2 = at.torque2 + f2;
      const S inverse = S(1.0) / (ideal.determinant_floor + at.turning * at.turning);
      return {y[2], y[3], (ideal.B * q1 - at.coupling * q2) * inverse, (ideal.A * q2 - at.coupling * q1) * inverse};
    }
  };

  template <class S>
  static over<S> make(std::size_t form, const S* p) {
    const S* const r = p + double_pendulum::forms[form].parameters.size();
    return {double_pendulum::make<S>(form, p), {r[0], r[1]}, {r[2], r[3]}};
  }
};

}  // namespace pendula::inline PENDULA_MACHINE

#include "pendula/system/damped_double_pendulum_series.hpp"
