// Numbers at the stages of an implicit step. Of one trajectory the stages are worked on side by side, in the lanes of
// one pack; of several, whose numbers are lanes already, one stage after the other. Both do the same operations.
#pragma once

#include <bit>

#include "pendula/scalar/choose.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <class S, std::size_t stages>
struct side_by_side {
  using number = S;
  static constexpr std::size_t width = 1;
};
template <std::size_t stages>
  requires(stages > 1)
struct side_by_side<double, stages> {
  static constexpr std::size_t width = std::bit_ceil(stages);
  using number = pack<double, static_cast<int>(width)>;
};

template <class S, std::size_t stages, std::size_t components>
struct stage_values {
  static constexpr std::size_t width = side_by_side<S, stages>::width, groups = width == 1 ? stages : 1;
  using number = typename side_by_side<S, stages>::number;
  using table = std::array<std::array<double, stages>, stages>;

  std::array<vec<number, components>, groups> group;

  PENDULA_INLINE vec<number, components>& operator[](std::size_t g) { return group[g]; }
  PENDULA_INLINE const vec<number, components>& operator[](std::size_t g) const { return group[g]; }

  // One stage's number, wherever it is wanted.
  PENDULA_INLINE number of_stage(std::size_t j, std::size_t component) const {
    if constexpr (width == 1) {
      return group[j][component];
    } else {
      return number(group[0][component][static_cast<int>(j)]);
    }
  }

  // Σ_j a_ij x_j for the stages i of a group, in pairs.
  PENDULA_INLINE number weighted_sum(const table& a, std::size_t g, std::size_t component) const {
    return sum_of<0, stages>(a, g, component);
  }

  // The sum over the stages.
  PENDULA_INLINE S total(std::size_t component) const {
    S sum = stage(0, component);
    for (std::size_t j = 1; j < stages; ++j) sum = sum + stage(j, component);
    return sum;
  }

  void fill_with_zeros() {
    for (auto& each : group) each.fill(number(0.0));
  }
  void retire_lane(int lane_index) {
    for (auto& each : group)
      for (number& x : each) {
        if constexpr (width == 1) {
          set_lane(x, lane_index, 0.0);
        } else {
          x = number(0.0);
        }
      }
  }

  // Numbers of the stages of a group out of those of all; lanes without a stage hold 0.
  template <class Numbers>
  PENDULA_INLINE static number gathered(const Numbers& of_stages, std::size_t g) {
    if constexpr (width == 1) {
      return number(of_stages(g));
    } else {
      number result(0.0);
      for (std::size_t i = 0; i < stages; ++i) result.set(static_cast<int>(i), of_stages(i));
      return result;
    }
  }

 private:
  PENDULA_INLINE S stage(std::size_t j, std::size_t component) const {
    if constexpr (width == 1) {
      return group[j][component];
    } else {
      return group[0][component][static_cast<int>(j)];
    }
  }

  template <std::size_t from, std::size_t count>
  PENDULA_INLINE number sum_of(const table& a, std::size_t g, std::size_t component) const {
    if constexpr (count == 1) {
      return gathered([&](std::size_t i) { return a[i][from]; }, g) * of_stage(from, component);
    } else {
      return sum_of<from, count / 2>(a, g, component) + sum_of<from + count / 2, count - count / 2>(a, g, component);
    }
  }
};

// Where something holds at some of the stages of a group, lane by lane of the trajectories.
template <class S, class M>
PENDULA_INLINE auto at_any_stage(M at_stages) {
  if constexpr (lanes<S>::count == 1) {
    return any_lane(at_stages);
  } else {
    return at_stages;
  }
}

}  // namespace pendula::inline PENDULA_MACHINE
