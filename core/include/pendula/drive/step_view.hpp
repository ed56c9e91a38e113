// The step that a stepper of one trajectory stands in, for those who look inside it: numbers rounded to doubles,
// whatever the stepper computes with, so that what looks is compiled once.
#pragma once

#include <span>

#include "pendula/concepts.hpp"
#include "pendula/scalar/polynomial_roots.hpp"
#include "pendula/scalar/product.hpp"
#include "pendula/scalar/rough_powers.hpp"

namespace pendula::inline PENDULA_MACHINE {

struct step_view {
  virtual int angles() const = 0;
  virtual double length() const = 0;
  // On [0, 1] for the whole step.
  virtual polynomial angle_polynomial(int i) const = 0;
  virtual polynomial velocity_polynomial(int i) const = 0;
  // A time tau into the step.
  virtual head_and_tail<double> angle(double tau, int i) const = 0;
  virtual double velocity(double tau, int i) const = 0;
  virtual double tip_height(double tau) const = 0;
  // Of the rods that hold the tip; none: the system has no positions.
  virtual std::span<const double> lengths() const = 0;
  // What the motion is as large as, in radians, and its highest frequency.
  virtual double amplitude() const = 0;
  virtual double frequency() const = 0;

 protected:
  ~step_view() = default;
};

template <class Stepper>
class view_of final : public step_view {
 public:
  using System = std::remove_cvref_t<decltype(std::declval<const Stepper&>().of())>;
  static constexpr std::size_t freedom = degrees_of_freedom<System>;

  explicit view_of(const Stepper& stepper) : stepper_(stepper) {
    if constexpr (Positioned<System>) {
      const auto lengths = stepper.of().lengths();
      for (std::size_t i = 0; i < freedom; ++i) lengths_[i] = rough(lengths[i]);
    }
  }

  int angles() const override { return static_cast<int>(freedom); }
  double length() const override { return stepper_.length(); }
  polynomial angle_polynomial(int i) const override { return stepper_.angle_polynomial(i); }
  polynomial velocity_polynomial(int i) const override { return stepper_.velocity_polynomial(i); }
  head_and_tail<double> angle(double tau, int i) const override {
    const auto point = stepper_.after(tau);
    return {rough(point.head[i]), rough(point.tail[i])};
  }
  double velocity(double tau, int i) const override { return rough(state(tau)[freedom + i]); }
  double tip_height(double tau) const override {
    if constexpr (Positioned<System>) {
      return rough(stepper_.of().positions(state(tau)).back()[1]);
    } else {
      return __builtin_nan("");  // every system of the catalogue has positions
    }
  }
  std::span<const double> lengths() const override { return {lengths_.data(), Positioned<System> ? freedom : 0}; }
  double amplitude() const override { return stepper_.amplitude(); }
  double frequency() const override { return stepper_.frequency(); }

 private:
  auto state(double tau) const { return stepper_.state_of(stepper_.after(tau)); }

  const Stepper& stepper_;
  std::array<double, freedom> lengths_{};
};

}  // namespace pendula::inline PENDULA_MACHINE
