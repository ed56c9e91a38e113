// Sums of many small increments that keep what rounding takes from them.
#pragma once

#include "pendula/scalar/product.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <class State>
struct compensated_point {
  State head, tail;

  // Kahan (1965), Comm. ACM 8, 40, with the exact error of each sum; higher precision needs no compensation.
  PENDULA_INLINE compensated_point moved_by(const State& increment) const {
    compensated_point to = *this;
    for (std::size_t i = 0; i < head.size(); ++i) {
      if constexpr (carries_rounding<typename State::value_type>) {
        const auto sum = two_sum(head[i], increment[i] + tail[i]);
        to.head[i] = sum.head;
        to.tail[i] = sum.tail;
      } else {
        to.head[i] = head[i] + increment[i];
      }
    }
    return to;
  }
};

// A time with its tail, so much later.
template <class S>
PENDULA_INLINE head_and_tail<S> later(const head_and_tail<S>& t, const S& tau) {
  const auto moved = compensated_point<vec<S, 1>>{{t.head}, {t.tail}}.moved_by({tau});
  return {moved.head[0], moved.tail[0]};
}

}  // namespace pendula::inline PENDULA_MACHINE
