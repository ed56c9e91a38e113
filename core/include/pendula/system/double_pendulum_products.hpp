// The products that the Taylor series of the double pendulum is made of, for any scalar and, for one trajectory of
// doubles or of wide numbers, four at a time: the same operations on the same numbers, hence the same bits.
#pragma once

#include "pendula/scalar/choose.hpp"
#include "pendula/scalar/machine.hpp"
#include "pendula/scalar/wide_lanes.hpp"

namespace pendula::inline PENDULA_MACHINE::detail {

template <class S>
struct double_inverse {  // of the mass matrix, which is symmetric
  S i11, i12, i22;
};

// One more product in a sum of many: wide numbers take the sum that errs in parts of the larger of the two, as the sum
// before them does anyway.
template <class S>
PENDULA_INLINE S with_product(S sum, S product) {
  return sum + product;
}
template <class S>
PENDULA_INLINE wide<S> with_product(wide<S> sum, wide<S> product) {
  return quick_sum(sum, product);
}

template <class S>
struct double_products {
  // D cos θ1, D sin θ1, E cos θ2, E sin θ2, C cos δ, C sin δ
  struct factor {
    S c1, s1, c2, s2, c, s;
    PENDULA_INLINE S first_sine() const { return s1; }
    PENDULA_INLINE S second_sine() const { return s2; }
    PENDULA_INLINE S first_cosine() const { return c1; }
    PENDULA_INLINE S second_cosine() const { return c2; }
    PENDULA_INLINE S coupling_cosine() const { return c; }
    PENDULA_INLINE S coupling_sine() const { return s; }
  };
  struct velocity {
    S first{0.0}, second{0.0};
    PENDULA_INLINE friend velocity operator+(const velocity& a, const velocity& b) {
      return {a.first + b.first, a.second + b.second};
    }
    PENDULA_INLINE friend velocity operator*(const velocity& a, const S& b) { return {a.first * b, a.second * b}; }
  };

  S c1{0.0}, s1{0.0}, c2{0.0}, s2{0.0}, c_first{0.0}, s_first{0.0}, c_second{0.0}, s_second{0.0};

  PENDULA_INLINE void add(const factor& a, const velocity& w) {
    add_coupling(a, w);
    c1 = with_product(c1, a.c1 * w.first);
    s1 = with_product(s1, a.s1 * w.first);
    c2 = with_product(c2, a.c2 * w.second);
    s2 = with_product(s2, a.s2 * w.second);
    s_second = with_product(s_second, a.s * w.second);
  }
  // Without what only the factors' next order needs.
  PENDULA_INLINE void add_coupling(const factor& a, const velocity& w) {
    c_first = with_product(c_first, a.c * w.first);
    s_first = with_product(s_first, a.s * w.first);
    c_second = with_product(c_second, a.c * w.second);
  }
  // The velocities of an order from its momenta and the products with all orders before.
  PENDULA_INLINE velocity solved(const double_inverse<S>& m, S p1, S p2) const {
    const S r1 = p1 - c_second, r2 = p2 - c_first;
    return {m.i11 * r1 + m.i12 * r2, m.i12 * r1 + m.i22 * r2};
  }
  PENDULA_INLINE S sine_first() const { return s_first; }
  PENDULA_INLINE S sine_second() const { return s_second; }
  PENDULA_INLINE S cosine_first() const { return c_first; }
  PENDULA_INLINE S cosine_second() const { return c_second; }
  // The factors' next order.
  PENDULA_INLINE factor integrated(S inverse_order) const {
    const S less = -inverse_order;
    return {s1 * less,
            c1 * inverse_order,
            s2 * less,
            c2 * inverse_order,
            (s_second - s_first) * inverse_order,
            (c_first - c_second) * inverse_order};
  }
  PENDULA_INLINE static factor factor_of(S c1, S s1, S c2, S s2, S c, S s) { return {c1, s1, c2, s2, c, s}; }
  PENDULA_INLINE static velocity velocity_of(S first, S second) { return {first, second}; }
  PENDULA_INLINE static S first(const velocity& w) { return w.first; }
  PENDULA_INLINE static S second(const velocity& w) { return w.second; }
};

// c1, s1, c2, s2 and c, s, c, s in four lanes each.
template <class S, class Four>
struct products_in_lanes {
  struct factor {
    Four outer;     // c1, s1, c2, s2
    Four coupling;  // c, s, c, s
    PENDULA_INLINE S first_sine() const { return lane(outer, 1); }
    PENDULA_INLINE S second_sine() const { return lane(outer, 3); }
    PENDULA_INLINE S first_cosine() const { return lane(outer, 0); }
    PENDULA_INLINE S second_cosine() const { return lane(outer, 2); }
    PENDULA_INLINE S coupling_cosine() const { return lane(coupling, 0); }
    PENDULA_INLINE S coupling_sine() const { return lane(coupling, 1); }
  };
  using velocity = Four;  // first, first, second, second

  Four outer{0.0}, coupling{0.0};

  PENDULA_INLINE void add(const factor& a, const velocity& w) {
    outer = with_product(outer, a.outer * w);
    add_coupling(a, w);
  }
  PENDULA_INLINE void add_coupling(const factor& a, const velocity& w) {
    coupling = with_product(coupling, a.coupling * w);
  }
  PENDULA_INLINE velocity solved(const double_inverse<S>& m, S p1, S p2) const {
    const Four r1 = spread<4>(p1) - rearranged<2, 2, 2, 2>(coupling),
               r2 = spread<4>(p2) - rearranged<0, 0, 0, 0>(coupling);
    return lanes_of(m.i11, m.i11, m.i12, m.i12) * r1 + lanes_of(m.i12, m.i12, m.i22, m.i22) * r2;
  }
  PENDULA_INLINE S sine_first() const { return lane(coupling, 1); }
  PENDULA_INLINE S sine_second() const { return lane(coupling, 3); }
  PENDULA_INLINE S cosine_first() const { return lane(coupling, 0); }
  PENDULA_INLINE S cosine_second() const { return lane(coupling, 2); }
  PENDULA_INLINE factor integrated(S inverse_order) const {
    const Four inverse = spread<4>(inverse_order);
    const Four turned = rearranged<1, 0, 3, 2>(outer) * inverse;
    const Four difference = rearranged<3, 0, 3, 0>(coupling) - rearranged<1, 2, 1, 2>(coupling);
    return {times_sign_of(turned, lanes_of(-1.0, 1.0, -1.0, 1.0)), difference * inverse};
  }
  PENDULA_INLINE static factor factor_of(S c1, S s1, S c2, S s2, S c, S s) {
    return {lanes_of(c1, s1, c2, s2), lanes_of(c, s, c, s)};
  }
  PENDULA_INLINE static velocity velocity_of(S first, S second) { return lanes_of(first, first, second, second); }
  PENDULA_INLINE static S first(const velocity& w) { return lane(w, 0); }
  PENDULA_INLINE static S second(const velocity& w) { return lane(w, 2); }
};

template <>
struct double_products<double> : products_in_lanes<double, pack<double, 4>> {};
template <>
struct double_products<wide<double>> : products_in_lanes<wide<double>, wide<pack<double, 4>>> {};

}  // namespace pendula::inline PENDULA_MACHINE::detail
