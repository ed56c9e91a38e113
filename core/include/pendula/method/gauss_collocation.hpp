// Gauss–Legendre collocation in canonical variables: implicit, symplectic and symmetric, of twice as high an order as
// it has stages (Hairer, Lubich & Wanner 2006, II.1.3). In the form of Antoñana, Makazaga & Murua (2017), Numer. Algor.
// 76, 861, with L_i = h b_i f(Y_i), Y_i = z + Σ_j μ_ij L_j and μ_ij = a_ij / b_j, a step is symplectic as soon as μ_ij
// + μ_ji = 1, which doubles satisfy exactly.
#pragma once

#include "pendula/description.hpp"
#include "pendula/method/parts_of_step.hpp"
#include "pendula/method/stage_values.hpp"
#include "pendula/scalar/choose.hpp"
#include "pendula/scalar/compensated.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <std::size_t stages>
struct collocation_table {
  using square = std::array<std::array<double, stages>, stages>;

  std::string_view name;
  std::array<double, stages> nodes;                    // zeros of the Legendre polynomial on [0, 1]
  std::array<double, (stages - 1) / 2> outer_weights;  // the others are what is left of 1
  square below;                                        // μ_ij for i > j
  std::string_view source;

  constexpr square mu() const {
    square all{};
    for (std::size_t i = 0; i < stages; ++i)
      for (std::size_t j = 0; j < stages; ++j) all[i][j] = i > j ? below[i][j] : i < j ? 1.0 - below[j][i] : 0.5;
    return all;
  }

  // What the polynomial through the stages of a step is at those of the next one: Lagrange's factors.
  constexpr square onward() const {
    square all{};
    for (std::size_t i = 0; i < stages; ++i)
      for (std::size_t j = 0; j < stages; ++j) {
        all[i][j] = 1.0;
        for (std::size_t k = 0; k < stages; ++k)
          if (k != j) all[i][j] *= (1.0 + nodes[i] - nodes[k]) / (nodes[j] - nodes[k]);
      }
    return all;
  }
};

// What is carried from step to step.
template <Mechanical Sys, std::size_t stages>
struct collocated {
  using S = typename Sys::scalar;
  using at_stages = stage_values<S, stages, degrees_of_freedom<Sys>>;

  compensated_point<typename Sys::state> z;
  at_stages velocity, force;  // of the step before
  S evaluations;

  friend const typename Sys::state& head_of(const collocated& c) { return c.z.head; }
  friend std::int64_t evaluations_of(const collocated& c, int i) {
    return static_cast<std::int64_t>(lane(c.evaluations, i));
  }
  friend void retire_lane(collocated& c, int i) {
    for (auto* numbers : {&c.z.head, &c.z.tail})
      for (S& x : *numbers) set_lane(x, i, 0.0);
    for (auto* each : {&c.velocity, &c.force}) each->retire_lane(i);
  }
};

// A step's equations, iterated until rounding alone is left. The velocities follow from the momenta that the forces
// have just given, which makes each round worth two of the plain fixed point's.
template <Mechanical Sys, std::size_t stages, const auto& tableau>
class collocation_step {
 public:
  using carried = collocated<Sys, stages>;
  using S = typename Sys::scalar;

  PENDULA_INLINE collocation_step(const Sys& system, S t, const carried& from, S h) : system_(system), at_(from) {
    const auto part = parts_of_step<stages>(h, tableau.outer_weights);
    for (std::size_t g = 0; g < groups; ++g) {
      weight_[g] = at_stages::gathered([&](std::size_t i) { return part[i]; }, g);
      time_[g] = at_stages::gathered([&](std::size_t i) { return t + S(tableau.nodes[i]) * h; }, g);
    }
  }

  // What is carried on from the end of the step.
  PENDULA_INLINE carried solved() {
    guess();
    mask going = equal(S(0.0), S(0.0));
    for (int round = 0; round < most_rounds && any_lane(going); ++round) {
      at_.evaluations = choose(going, at_.evaluations + S(static_cast<double>(stages)), at_.evaluations);
      going = mask_and(going, improve(going));
    }
    for (std::size_t i = 0; i < freedom; ++i) {
      sum_[i] = turned_.total(i);
      sum_[freedom + i] = pushed_.total(i);
    }
    at_.z = at_.z.moved_by(sum_);
    at_.z.head[0] = choose(going, S(__builtin_nan("")), at_.z.head[0]);
    return at_;
  }

 private:
  static constexpr std::size_t freedom = degrees_of_freedom<Sys>;
  using at_stages = typename carried::at_stages;
  using number = typename at_stages::number;
  static constexpr std::size_t groups = at_stages::groups;
  using mask = decltype(less(S(0.0), S(0.0)));
  static constexpr auto mu = tableau.mu(), onward = tableau.onward();
  static constexpr int most_rounds = 100;
  static constexpr double blunder = 0x1p-30;  // of an angle: no rounding makes such changes

  PENDULA_INLINE void guess() {
    for (std::size_t g = 0; g < groups; ++g)
      for (std::size_t i = 0; i < freedom; ++i) {
        turned_[g][i] = weight_[g] * at_.velocity.weighted_sum(onward, g, i);
        pushed_[g][i] = weight_[g] * at_.force.weighted_sum(onward, g, i);
        least_[g] = number(__builtin_inf());
      }
    for (std::size_t g = 0; g < groups; ++g) {
      angles_[g] = moved(turned_, g, 0);
      momenta_[g] = moved(pushed_, g, freedom);
    }
  }

  // Y_i of a group: the components from `first` on.
  PENDULA_INLINE vec<number, freedom> moved(const at_stages& by, std::size_t g, std::size_t first) const {
    vec<number, freedom> to;
    for (std::size_t i = 0; i < freedom; ++i)
      to[i] = number(at_.z.head[first + i]) + (by.weighted_sum(mu, g, i) + number(at_.z.tail[first + i]));
    return to;
  }

  // One round for the lanes that go on, and where another is worth it.
  PENDULA_INLINE mask improve(mask going) {
    decltype(system_.configuration_at(angles_[0])) configuration[groups];
    for (std::size_t g = 0; g < groups; ++g) {
      configuration[g] = system_.configuration_at(angles_[g]);
      const auto force = system_.forces(time_[g], configuration[g], system_.velocities(configuration[g], momenta_[g]));
      keep(going, at_.force[g], force);
    }
    for (std::size_t g = 0; g < groups; ++g)
      for (std::size_t i = 0; i < freedom; ++i) pushed_[g][i] = weight_[g] * at_.force[g][i];
    mask better = less(S(0.0), S(0.0));
    for (std::size_t g = 0; g < groups; ++g) {
      momenta_[g] = moved(pushed_, g, freedom);
      keep(going, at_.velocity[g], system_.velocities(configuration[g], momenta_[g]));
      better = mask_or(better, at_any_stage<S>(turn(g)));
    }
    for (std::size_t g = 0; g < groups; ++g) angles_[g] = moved(turned_, g, 0);
    return better;
  }

  PENDULA_INLINE static void keep(mask going, vec<number, freedom>& old, const vec<number, freedom>& found) {
    for (std::size_t i = 0; i < freedom; ++i) {
      if constexpr (lanes<S>::count == 1) {
        old[i] = found[i];
      } else {
        old[i] = choose(going, found[i], old[i]);
      }
    }
  }

  // The group's new angles, and at which of its stages they have still come nearer, or are far off.
  PENDULA_INLINE auto turn(std::size_t g) {
    number change(0.0), scale(0.0);
    for (std::size_t i = 0; i < freedom; ++i) {
      const number next = weight_[g] * at_.velocity[g][i];
      change = change + magnitude(next - turned_[g][i]);
      scale = scale + (magnitude(next) + magnitude(angles_[g][i]));
      turned_[g][i] = next;
    }
    const auto nearer = mask_and(less(change, least_[g]), less(number(0.0), change));
    least_[g] = choose(less(change, least_[g]), change, least_[g]);
    return mask_or(nearer, less(number(blunder) * scale, change));
  }

  const Sys& system_;
  carried at_;
  at_stages turned_, pushed_, angles_, momenta_;  // h b_i of the velocities and forces; Y_i
  std::array<number, groups> weight_, time_, least_;
  typename Sys::state sum_;
};

template <const auto& tableau>
struct gauss_collocation {
  static constexpr std::size_t stages = tableau.nodes.size();
  static constexpr std::string_view name = tableau.name;
  static constexpr int order = 2 * static_cast<int>(stages);
  static constexpr int evaluations_per_step = 0;
  static constexpr bool adaptive = false, symplectic = true;
  static constexpr facet needs = facet::mechanical;
  static constexpr std::string_view source = tableau.source;

  template <Mechanical Sys>
  static collocated<Sys, stages> begin(const Sys& system, const typename Sys::state& y) {
    using S = typename Sys::scalar;
    collocated<Sys, stages> at{{system.canonical(y), {}}, {}, {}, S(0.0)};
    at.z.tail.fill(S(0.0));
    at.velocity.fill_with_zeros();
    at.force.fill_with_zeros();
    return at;
  }
  template <Mechanical Sys>
  static typename Sys::state state_of(const Sys& system, const collocated<Sys, stages>& at) {
    return system.from_canonical(at.z.head);
  }
  template <Mechanical Sys>
  static collocated<Sys, stages> step(const Sys& system, typename Sys::scalar t, const collocated<Sys, stages>& from,
                                      typename Sys::scalar h) {
    return collocation_step<Sys, stages, tableau>(system, t, from, h).solved();
  }
};

}  // namespace pendula::inline PENDULA_MACHINE
