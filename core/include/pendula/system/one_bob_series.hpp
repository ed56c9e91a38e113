// Taylor series of a motion with one angle: the orders of its velocity, and what follows from them.
#pragma once

#include <vector>

#include "pendula/system/one_bob.hpp"
#include "pendula/system/series.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <class S>
class one_bob_series {
 public:
  // The order is even.
  explicit one_bob_series(int order) : order_(order), velocity_(static_cast<std::size_t>(order) + 1) {}

  PENDULA_INLINE S velocity(int, int k) const { return velocity_[k]; }

  // What is added to (θ, ω) in a time h: even and odd orders side by side.
  PENDULA_INLINE vec<S, 2> increment(S h, const S* inverse) const {
    const S square = h * h;
    S angle(0.0), angle_below(0.0), speed(0.0), speed_below(0.0);
    for (int k = order_; k >= 2; k -= 2) {
      angle = angle * square + velocity_[k - 1] * inverse[k];
      speed = speed * square + velocity_[k];
      angle_below = angle_below * square + velocity_[k - 2] * inverse[k - 1];
      speed_below = speed_below * square + velocity_[k - 1];
    }
    return {(angle * h + angle_below) * h, (speed * h + speed_below) * h};
  }

 protected:
  int order_;
  std::vector<S> velocity_;
};

}  // namespace pendula::inline PENDULA_MACHINE
