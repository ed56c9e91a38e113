// The planar double pendulum. Two uniform rods, two bobs on massless rods and any two rigid bodies are one system
// with five constants,
//     T = ½A ω1² + ½B ω2² + C ω1 ω2 cos(θ1−θ2),   V = D (1 − cos θ1) + E (1 − cos θ2),
// and the equations of motion, with δ = θ1 − θ2,
//     A ω̇1 + C cos δ ω̇2 = −C sin δ ω2² − D sin θ1,
//     C cos δ ω̇1 + B ω̇2 = +C sin δ ω1² − E sin θ2:
// Herrera, Avila, Martinez & Acuña (2024), eq. 47, whose solution (49), (50) holds once the l1 of (50) is l2.
#pragma once

#include "pendula/description.hpp"
#include "pendula/scalar/product.hpp"
#include "pendula/scalar/sincos.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <class S, bool keeps_products = false>
class double_pendulum_series;

struct double_pendulum {
  static constexpr std::string_view name = "double";
  static constexpr capabilities can{.conservative = true,
                                    .autonomous = true,
                                    .closed_form = false,
                                    .period = false,
                                    .mapped = true,
                                    .periodic = true};
  static constexpr std::array components{
      component{"theta1", "rad", 2.0943951023931957,
                "angle of rod 1 from the downward vertical, counter-clockwise"},                      // 120°
      component{"theta2", "rad", -0.17453292519943295, "angle of rod 2 from the downward vertical"},  // −10°
      component{"omega1", "rad/s", 0.0, "angular velocity of rod 1"},
      component{"omega2", "rad/s", 0.0, "angular velocity of rod 2"}};

  static constexpr std::array rods{parameter{"m1", "kg", 1.0, range::positive, "mass of rod 1"},
                                   parameter{"m2", "kg", 1.0, range::positive, "mass of rod 2"},
                                   parameter{"l1", "m", 1.0, range::positive, "length of rod 1"},
                                   parameter{"l2", "m", 1.0, range::positive, "length of rod 2"}, gravity_row};
  static constexpr std::array bobs{parameter{"m1", "kg", 1.0, range::positive, "mass of bob 1"},
                                   parameter{"m2", "kg", 1.0, range::positive, "mass of bob 2"},
                                   parameter{"l1", "m", 1.0, range::positive, "length of rod 1"},
                                   parameter{"l2", "m", 1.0, range::positive, "length of rod 2"}, gravity_row};
  static constexpr std::array bodies{
      parameter{"m1", "kg", to_be_named, range::positive, "mass of body 1"},
      parameter{"m2", "kg", to_be_named, range::positive, "mass of body 2"},
      parameter{"l1", "m", to_be_named, range::positive, "distance from the pivot to the joint"},
      parameter{"c1", "m", to_be_named, range::not_negative, "distance from the pivot to the centre of mass of body 1"},
      parameter{"c2", "m", to_be_named, range::not_negative, "distance from the joint to the centre of mass of body 2"},
      parameter{"I1", "kg m^2", to_be_named, range::not_negative,
                "moment of inertia of body 1 about its centre of mass"},
      parameter{"I2", "kg m^2", to_be_named, range::not_negative,
                "moment of inertia of body 2 about its centre of mass"},
      gravity_row,
      parameter{"l2", "m", to_be_named, range::not_negative, "length of body 2, for drawing only", "c2"}};
  static constexpr std::array forms{form{"rods", "two uniform rods", rods},
                                    form{"bobs", "two bobs on massless rods", bobs},
                                    form{"bodies", "two rigid bodies", bodies}};

  template <class S>
  struct over {
    using scalar = S;
    static constexpr std::size_t dimension = 4;
    using state = vec<S, dimension>;
    using series = double_pendulum_series<S>;

    S A, B, C, D, E;
    S l1, l2;             // drawn, not in the equations
    S determinant_floor;  // A B − C², the mass matrix' least determinant

    PENDULA_INLINE state rhs(const S&, const state& y) const {
      const auto [first, second] = sincos(y[0], y[1]);
      const auto [s1, c1] = first;
      const auto [s2, c2] = second;
      // sin δ and cos δ from the sines at hand: a third pair of polynomials would cost a third of the step
      const S sin_delta = s1 * c2 - c1 * s2, cos_delta = c1 * c2 + s1 * s2;
      const S coupling = C * cos_delta, turning = C * sin_delta;
      const S drop1 = D * s1 + turning * (y[3] * y[3]),
              drop2 = E * s2 - turning * (y[2] * y[2]);                    // minus the right-hand sides
      const S inverse = S(1.0) / (determinant_floor + turning * turning);  // A B − C² cos² δ, without cancellation
      return {y[2], y[3], (coupling * drop2 - B * drop1) * inverse, (coupling * drop1 - A * drop2) * inverse};
    }

    // All that the canonical equations need of the angles. T is the system's scalar or lanes of it.
    template <class T>
    struct configuration {
      T sine1, sine2;
      T turning, coupling;  // C sin δ, C cos δ
      T inverse;            // 1/(A B − C² cos² δ)
    };
    template <class T>
    PENDULA_INLINE configuration<T> configuration_at(const vec<T, 2>& angles) const {
      const auto [first, second] = sincos(angles[0], angles[1]);
      const auto [s1, c1] = first;
      const auto [s2, c2] = second;
      const T turning = T(C) * (s1 * c2 - c1 * s2), coupling = T(C) * (c1 * c2 + s1 * s2);
      return {s1, s2, turning, coupling, T(1.0) / (T(determinant_floor) + turning * turning)};
    }
    // p1 = A ω1 + C cos δ ω2, p2 = C cos δ ω1 + B ω2, solved for the velocities.
    template <class T>
    PENDULA_INLINE vec<T, 2> velocities(const configuration<T>& at, const vec<T, 2>& p) const {
      return {(T(B) * p[0] - at.coupling * p[1]) * at.inverse, (T(A) * p[1] - at.coupling * p[0]) * at.inverse};
    }
    // ṗ1 = −C ω1 ω2 sin δ − D sin θ1, ṗ2 = +C ω1 ω2 sin δ − E sin θ2.
    template <class T>
    PENDULA_INLINE vec<T, 2> forces(const T&, const configuration<T>& at, const vec<T, 2>& omega) const {
      const T exchange = at.turning * (omega[0] * omega[1]);
      return {-(exchange + T(D) * at.sine1), exchange - T(E) * at.sine2};
    }

    PENDULA_INLINE state canonical(const state& y) const {
      const S coupling = configuration_at<S>({y[0], y[1]}).coupling;
      return {y[0], y[1], A * y[2] + coupling * y[3], coupling * y[2] + B * y[3]};
    }
    PENDULA_INLINE state from_canonical(const state& z) const {
      const auto omega = velocities<S>(configuration_at<S>({z[0], z[1]}), {z[2], z[3]});
      return {z[0], z[1], omega[0], omega[1]};
    }

    S kinetic_energy(const state& y) const {
      const auto [first, second] = sincos(y[0], y[1]);  // the difference of two angles in range can be beyond it
      const S cos_delta = first.cos * second.cos + first.sin * second.sin;
      return S(0.5) * (A * y[2] * y[2] + B * y[3] * y[3]) + C * y[2] * y[3] * cos_delta;
    }
    S potential_energy(const state& y) const { return D * one_minus_cos(y[0]) + E * one_minus_cos(y[1]); }
    std::array<constant<S>, 7> constants() const {
      return {{{"A", A},
               {"B", B},
               {"C", C, true},
               {"D", D},
               {"E", E, true},
               {"determinant_floor", determinant_floor},
               {"energy_scale", energy_scale()}}};
    }

    S energy_scale() const { return D + E; }
    vec<S, 2> lengths() const { return {l1, l2}; }
    // The sum over both modes of small oscillations, hardly more than that of the fast one.
    S largest_frequency_squared() const { return (A * E + B * D) / determinant_floor; }

    std::array<vec<S, 2>, 2> positions(const state& y) const {
      const auto [s1, c1] = sincos(y[0]);
      const auto [s2, c2] = sincos(y[1]);
      const vec<S, 2> joint{l1 * s1, -(l1 * c1)};
      return {joint, {joint[0] + l2 * s2, joint[1] - l2 * c2}};
    }
  };

  // A B − C². Below a light upper body it is a difference of which rounding leaves little: there it is what it comes to
  // in the parameters, a sum of positive terms.
  template <class S>
  static S determinant(const S& A, const S& B, const S& C, const S& sum) {
    if constexpr (carries_rounding<S>) {
      const S difference = difference_of_products(A, B, C, C);
      return choose(less(difference, S(0x1p-4) * (A * B)), sum, difference);
    } else {
      return sum;
    }
  }

  // The rows of a form's parameters, in their order, make the constants, in the precision of the run.
  template <class S>
  static over<S> make(std::size_t form, const S* p) {
    const S m1 = p[0], m2 = p[1], l1 = p[2];
    if (form == 2) {
      const S c1 = p[3], c2 = p[4], gravity = p[7];
      const S of_joint = m2 * l1 * l1, A = p[5] + m1 * c1 * c1 + of_joint, B = p[6] + m2 * c2 * c2, C = m2 * l1 * c2;
      const S least = determinant(A, B, C, (p[5] + m1 * c1 * c1) * B + of_joint * p[6]);
      return {A, B, C, (m1 * c1 + m2 * l1) * gravity, m2 * c2 * gravity, l1, p[8], least};
    }
    const S l2 = p[3], gravity = p[4];
    if (form == 1) {
      const S A = (m1 + m2) * l1 * l1, B = m2 * l2 * l2, C = m2 * l1 * l2;
      const S least = determinant(A, B, C, m1 * l1 * l1 * B);
      return {A, B, C, (m1 + m2) * gravity * l1, m2 * gravity * l2, l1, l2, least};
    }
    const S half(0.5), third_m1 = m1 / S(3.0), third_m2 = m2 / S(3.0);
    const S A = (third_m1 + m2) * l1 * l1, B = third_m2 * l2 * l2, C = half * m2 * l1 * l2;
    const S least = difference_of_products(A, B, C, C);  // at least a quarter of A B
    return {A, B, C, (half * m1 + m2) * gravity * l1, half * m2 * gravity * l2, l1, l2, least};
  }
};

}  // namespace pendula::inline PENDULA_MACHINE

#include "pendula/system/double_pendulum_series.hpp"
