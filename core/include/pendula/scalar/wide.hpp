// wide<S>: the unevaluated sum of a number and a tail of about its rounding error, 104 bits in all, or of two lanes of
// numbers. After Joldes, Muller & Popescu (2017), ACM Trans. Math. Softw. 44, 15: their accurate sum (algorithm 6);
// product, quotient and root leave out the last step, which makes the tail at most half a unit, because nothing here
// needs it.
#pragma once

#include "pendula/scalar/choose.hpp"
#include "pendula/scalar/product.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <class S>
struct wide {
  S hi, lo;

  wide() = default;
  PENDULA_INLINE wide(double x) : hi(x), lo(0.0) {}
  PENDULA_INLINE explicit wide(S x)
    requires(!std::same_as<S, double>)
      : hi(x), lo(0.0) {}
  PENDULA_INLINE wide(S head, S tail) : hi(head), lo(tail) {}
  PENDULA_INLINE explicit wide(head_and_tail<S> exact) : hi(exact.head), lo(exact.tail) {}

  PENDULA_INLINE friend wide operator-(wide a) { return {-a.hi, -a.lo}; }
  PENDULA_INLINE friend wide operator+(wide a, wide b) {
    const auto [head, of_head] = two_sum(a.hi, b.hi);
    const auto [tail, of_tail] = two_sum(a.lo, b.lo);
    const auto [sum, rest] = fast_two_sum(head, of_head + tail);
    return wide(fast_two_sum(sum, rest + of_tail));
  }
  PENDULA_INLINE friend wide operator-(wide a, wide b) { return a + -b; }
  PENDULA_INLINE friend wide operator*(wide a, wide b) {
    const auto [head, tail] = two_product(a.hi, b.hi);
    return {head, tail + (a.hi * b.lo + a.lo * b.hi)};
  }
  PENDULA_INLINE friend wide operator*(wide a, S b) {
    const auto [head, tail] = two_product(a.hi, b);
    return {head, tail + a.lo * b};
  }
  PENDULA_INLINE friend wide operator/(wide a, wide b) { return quotient(a, b, S(1.0) / b.hi); }

  // a/b where 1/b.hi is known.
  PENDULA_INLINE friend wide quotient(wide a, wide b, S inverse) {
    const S ratio = a.hi * inverse;
    const auto [head, tail] = two_product(ratio, b.hi);
    return {ratio, (((a.hi - head) - tail) + (a.lo - ratio * b.lo)) * inverse};
  }
};

template <class S>
PENDULA_INLINE wide<S> square(wide<S> a) {
  const auto [head, tail] = two_product(a.hi, a.hi);
  return {head, tail + (a.hi + a.hi) * a.lo};
}

template <class S>
struct root_and_inverse {
  wide<S> root;
  S half_inverse;  // 1/(2 root)
};

// Of a number above zero, where 1/(2x) is known, which saves a division.
template <class S>
PENDULA_INLINE root_and_inverse<S> square_root_by(wide<S> x, S half_inverse_of_x) {
  const S root = square_root(x.hi), half_inverse = root * half_inverse_of_x;
  const auto [head, tail] = two_product(root, root);
  return {{root, (((x.hi - head) - tail) + x.lo) * half_inverse}, half_inverse};
}
template <class S>
PENDULA_INLINE wide<S> square_root(wide<S> x) {
  return square_root_by(x, S(0.5) / x.hi).root;
}

// a + b with an error in parts of the larger of the two, which is the result's where they do not cancel.
template <class S>
PENDULA_INLINE wide<S> quick_sum(wide<S> a, wide<S> b) {
  const auto [head, tail] = two_sum(a.hi, b.hi);
  return {head, tail + (a.lo + b.lo)};
}
// The same where |a| is at least about |b|.
template <class S>
PENDULA_INLINE wide<S> sum_with_smaller(wide<S> a, wide<S> b) {
  const auto [head, tail] = fast_two_sum(a.hi, b.hi);
  return {head, tail + (a.lo + b.lo)};
}
template <class S>
PENDULA_INLINE wide<S> sum_with_smaller(wide<S> a, S b) {
  const auto [head, tail] = fast_two_sum(a.hi, b);
  return {head, tail + a.lo};
}

template <class S, class M>
PENDULA_INLINE wide<S> choose(M condition, wide<S> yes, wide<S> no) {
  return {choose(condition, yes.hi, no.hi), choose(condition, yes.lo, no.lo)};
}

// The same number where the head of a sum has cancelled and the tail is no longer small beside it.
template <class S>
PENDULA_INLINE wide<S> settled(wide<S> x) {
  return wide<S>(fast_two_sum(x.hi, x.lo));
}

template <class S>
PENDULA_INLINE S rounded(wide<S> x) {
  return x.hi + x.lo;
}

// By a power of two.
template <class S>
PENDULA_INLINE wide<S> scaled(wide<S> x, S power) {
  return {x.hi * power, x.lo * power};
}

}  // namespace pendula::inline PENDULA_MACHINE
