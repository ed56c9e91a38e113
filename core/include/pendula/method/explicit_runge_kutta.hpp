// Explicit Runge–Kutta methods: a Butcher tableau and a name are a method; this engine makes the step of each.
#pragma once

#include <numeric>
#include <utility>

#include "pendula/concepts.hpp"
#include "pendula/description.hpp"

namespace pendula::inline PENDULA_MACHINE {

// Coefficients as fractions, so that every scalar forms them in its own precision.
struct fraction {
  long long numerator = 0, denominator = 1;

  friend constexpr fraction operator+(fraction a, fraction b) {
    const long long n = a.numerator * b.denominator + b.numerator * a.denominator, d = a.denominator * b.denominator;
    return {n / std::gcd(n, d), d / std::gcd(n, d)};
  }
  friend constexpr fraction operator*(fraction a, fraction b) {
    const long long n = a.numerator * b.numerator, d = a.denominator * b.denominator;
    return {n / std::gcd(n, d), d / std::gcd(n, d)};
  }

  template <class S>
  PENDULA_INLINE constexpr S as() const {
    return S(static_cast<double>(numerator)) / S(static_cast<double>(denominator));
  }
};

template <std::size_t stages>
struct butcher_tableau {
  std::string_view name;
  int order;
  std::array<std::array<fraction, stages>, stages> a;  // strictly lower triangular
  std::array<fraction, stages> b;
  std::string_view source;

  // c_i = Σ_j a_ij: the part of the step after which stage i stands.
  constexpr fraction node(std::size_t i) const { return std::accumulate(a[i].begin(), a[i].end(), fraction{}); }

  // 1 + b₁ z + … + b_s z^s with the coefficients bᵀ A^{k−1} 1, from the lowest power on: what a step makes of y' = λ y,
  // z = λ h (Hairer & Wanner 1996, Solving Ordinary Differential Equations II, IV.2.2).
  constexpr std::array<double, stages + 1> stability_polynomial() const {
    std::array<double, stages + 1> coefficients{1.0};
    std::array<fraction, stages> power;
    power.fill({1, 1});
    for (std::size_t k = 1; k <= stages; ++k) {
      fraction sum{};
      for (std::size_t i = 0; i < stages; ++i) sum = sum + b[i] * power[i];
      coefficients[k] = static_cast<double>(sum.numerator) / static_cast<double>(sum.denominator);
      std::array<fraction, stages> next{};
      for (std::size_t i = 0; i < stages; ++i)
        for (std::size_t j = 0; j < stages; ++j) next[i] = next[i] + a[i][j] * power[j];
      power = next;
    }
    return coefficients;
  }
};

template <const auto& tableau>
struct explicit_runge_kutta {
  static constexpr std::string_view name = tableau.name;
  static constexpr int order = tableau.order;
  static constexpr std::size_t stages = tableau.b.size();
  static constexpr int evaluations_per_step = static_cast<int>(stages);
  static constexpr bool adaptive = false, symplectic = false;
  static constexpr facet needs = facet::flow;
  static constexpr std::string_view source = tableau.source;
  static constexpr auto stability_polynomial = tableau.stability_polynomial();

  // It carries the state from step to step and nothing else.
  template <Flow Sys>
  PENDULA_INLINE static typename Sys::state begin(const Sys&, const typename Sys::state& y) {
    return y;
  }
  template <Flow Sys>
  PENDULA_INLINE static typename Sys::state state_of(const Sys&, const typename Sys::state& carried) {
    return carried;
  }

  // From the state at time t that a time h later. h times each coefficient does not change from step to step: compilers
  // lift it out.
  template <Flow Sys, class S = typename Sys::scalar>
  PENDULA_INLINE static typename Sys::state step(const Sys& system, S t, const typename Sys::state& y, S h) {
    std::array<typename Sys::state, stages> k;
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      ((k[i] = system.rhs(t + tableau.node(i).template as<S>() * h, stage<i>(y, k, h))), ...);
    }(std::make_index_sequence<stages>{});
    return stage<stages>(y, k, h);
  }

 private:
  // y + Σ_j (h a_ij) k_j over the coefficients that are not zero; row `stages` stands for the b_j.
  template <std::size_t row, class State, class Slopes, class S>
  PENDULA_INLINE static State stage(const State& y, const Slopes& k, S h) {
    State result = y;
    if constexpr (row > 0) {
      for (std::size_t component = 0; component < y.size(); ++component)
        result[component] = y[component] + weighted_sum<row, row - 1>(k, component, h);
    }
    return result;
  }

  static constexpr fraction coefficient(std::size_t row, std::size_t j) {
    return row == stages ? tableau.b[j] : tableau.a[row][j];
  }

  static constexpr bool nothing_before(std::size_t row, std::size_t j) {
    for (std::size_t i = 0; i < j; ++i)
      if (coefficient(row, i).numerator != 0) return false;
    return true;
  }

  // The newest slope is added last: the earlier terms need not wait for it.
  template <std::size_t row, std::size_t j, class Slopes, class S>
  PENDULA_INLINE static S weighted_sum(const Slopes& k, std::size_t component, S h) {
    constexpr fraction c = coefficient(row, j);
    if constexpr (c.numerator == 0) {
      static_assert(j > 0, "a stage has at least one slope");
      return weighted_sum<row, j - 1>(k, component, h);
    } else {
      const S term = (h * c.template as<S>()) * k[j][component];
      if constexpr (nothing_before(row, j)) {
        return term;
      } else {
        return weighted_sum<row, j - 1>(k, component, h) + term;
      }
    }
  }
};

}  // namespace pendula::inline PENDULA_MACHINE
