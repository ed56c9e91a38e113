// Products with their rounding error.
#pragma once

#include "pendula/concepts.hpp"

namespace pendula {

// a b as head + tail exactly (Dekker 1971), for factors well away from the ends of the range. Written with
// multiplications alone, so that machines with and without a fused multiply-add give the same bits.
template <class S>
struct head_and_tail {
  S head, tail;
};

template <class S>
PENDULA_INLINE head_and_tail<S> split(S x) {
  const S t = x * S(134217729.0);  // 2^27 + 1
  const S head = t - (t - x);
  return {head, x - head};
}

template <class S>
PENDULA_INLINE head_and_tail<S> two_product(S a, S b) {
  const S product = a * b;
  const auto [ah, al] = split(a);
  const auto [bh, bl] = split(b);
  return {product, ((ah * bh - product) + ah * bl + al * bh) + al * bl};
}

// a b − c d to a rounding or two, however much cancels (Kahan; Jeannerod, Louvet & Muller 2013).
template <class S>
PENDULA_INLINE S difference_of_products(S a, S b, S c, S d) {
  const auto [p, p_error] = two_product(a, b);
  const auto [q, q_error] = two_product(c, d);
  return (p - q) + (p_error - q_error);
}

}  // namespace pendula
