// Sums and products with their rounding error.
#pragma once

#include "pendula/scalar/machine.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <class S>
struct head_and_tail {
  S head, tail;
};

// a + b exactly (Knuth 1969); the second for |a| ≥ |b| or a = 0 (Dekker 1971).
template <class S>
PENDULA_INLINE head_and_tail<S> two_sum(S a, S b) {
  const S sum = a + b, of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}
template <class S>
PENDULA_INLINE head_and_tail<S> fast_two_sum(S a, S b) {
  const S sum = a + b;
  return {sum, b - (sum - a)};
}

template <class S>
PENDULA_INLINE head_and_tail<S> split(S x) {
  const S t = x * S(134217729.0);  // 2^27 + 1
  const S head = t - (t - x);
  return {head, x - head};
}

// a b exactly, for factors well away from the ends of the range: by a fused multiply-add, or by multiplications alone
// (Dekker 1971), to the same bits.
template <class S>
PENDULA_INLINE head_and_tail<S> two_product(S a, S b) {
  const S product = a * b;
  if constexpr (fused_multiply_add) {
    return {product, product_minus(a, b, product)};
  } else {
    const auto [ah, al] = split(a);
    const auto [bh, bl] = split(b);
    return {product, ((ah * bh - product) + ah * bl + al * bh) + al * bl};
  }
}

// a b − c d to a rounding or two, however much cancels (Kahan; Jeannerod, Louvet & Muller 2013); higher
// precision needs no compensation.
template <class S>
PENDULA_INLINE S difference_of_products(S a, S b, S c, S d) {
  if constexpr (!carries_rounding<S>) {
    return a * b - c * d;
  } else {
    const auto [p, p_error] = two_product(a, b);
    const auto [q, q_error] = two_product(c, d);
    return (p - q) + (p_error - q_error);
  }
}

}  // namespace pendula::inline PENDULA_MACHINE
