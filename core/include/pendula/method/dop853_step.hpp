// The sums over slopes that a step of DOP853, its error estimates and its dense output are made of.
#pragma once

#include <concepts>
#include <type_traits>
#include <utility>

#include "pendula/method/dop853_tableau.hpp"
#include "pendula/method/joints.hpp"
#include "pendula/scalar/machine.hpp"
#include "pendula/scalar/polynomial_roots.hpp"

namespace pendula::inline PENDULA_MACHINE {

// Its slope at a state, of the piece of motion that it is in.
template <class Sys>
PENDULA_INLINE typename Sys::state slope_of(const Sys& system, const typename Sys::scalar& t,
                                            const typename Sys::state& y) {
  if constexpr (Piecewise<Sys>) {
    return system.rhs_in_piece(t, y);
  } else {
    return system.rhs(t, y);
  }
}

// y + x (d0 + (1 − x) (d1 + x (d2 + …))) in powers of x (dop853.f: contd8).
inline polynomial dense_polynomial(double y, const std::array<double, 7>& d) {
  polynomial p;
  p.coefficient[0] = d[6];
  const auto times_x = [&p] {
    for (int k = ++p.degree; k > 0; --k) p.coefficient[k] = p.coefficient[k - 1];
    p.coefficient[0] = 0.0;
  };
  for (int j = 5; j >= 0; --j) {
    const polynomial q = p;
    times_x();
    if (j % 2 == 0)
      for (int k = 0; k <= p.degree; ++k) p.coefficient[k] = q.coefficient[k] - p.coefficient[k];
    p.coefficient[0] += d[static_cast<std::size_t>(j)];
  }
  times_x();
  p.coefficient[0] = y;
  return p;
}

template <SecondOrder Sys>
struct dop853_step {
  using S = typename Sys::scalar;
  using state = typename Sys::state;
  // One trajectory works on two components in one vector: the same operations on the same numbers.
  static constexpr std::size_t abreast = std::same_as<S, double> ? 2 : 1, pairs = Sys::dimension / abreast;
  using number = std::conditional_t<abreast == 2, pack<double, 2>, S>;
  using components = std::array<number, pairs>;
  using slopes = std::array<components, 16>;

  PENDULA_INLINE static components paired(const state& y) {
    if constexpr (abreast == 1) {
      return y;
    } else {
      return each([&]<std::size_t i> { return lanes_of(y[2 * i], y[2 * i + 1]); });
    }
  }
  PENDULA_INLINE static state unpaired(const components& y) {
    if constexpr (abreast == 1) {
      return y;
    } else {
      return [&]<std::size_t... i>(std::index_sequence<i...>) {
        return state{y[i / 2][i % 2]...};
      }(std::make_index_sequence<Sys::dimension>{});
    }
  }

  // Σ_j (h w_j) k_j over a row. The newest slope is added last: the earlier terms need not wait for it.
  template <const auto& table, std::size_t row>
  PENDULA_INLINE static components sum(const slopes& k, const number& h) {
    constexpr auto weights = std::get<row>(table);
    return each([&]<std::size_t i> {
      return [&]<std::size_t... j>(std::index_sequence<j...>) {
        number total = (h * number(weights[0].coefficient)) * k[weights[0].slope][i];
        ((total = total + (h * number(weights[j + 1].coefficient)) * k[weights[j + 1].slope][i]), ...);
        return total;
      }(std::make_index_sequence<weights.size() - 1>{});
    });
  }

  template <std::size_t slope>
  PENDULA_INLINE static void add_slope(const Sys& system, const S& t, const components& y, slopes& k, const S& length) {
    const components increment = sum<dop853_table::toward, slope - 1>(k, number(length));
    k[slope] = paired(slope_of(system, t + S(dop853_table::node[slope]) * length,
                               unpaired(each([&]<std::size_t i> { return y[i] + increment[i]; }))));
  }

  // From the slope at y, the first of the list, what a step from time t adds to y.
  PENDULA_INLINE static components increment(const Sys& system, const S& t, const components& y, slopes& k,
                                             const S& length) {
    constexpr std::size_t stages = dop853_table::stages;
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      (add_slope<i + 1>(system, t, y, k, length), ...);
    }(std::make_index_sequence<stages - 1>{});
    return sum<dop853_table::toward, stages - 1>(k, number(length));
  }

  // In the order of the components, in pairs or not: the same sum.
  PENDULA_INLINE static S sum_of_squares(const components& a) {
    const state squares = unpaired(each([&]<std::size_t i> { return a[i] * a[i]; }));
    S total = squares[0];
    for (std::size_t i = 1; i < squares.size(); ++i) total = total + squares[i];
    return total;
  }

  // {value<0>(), value<1>(), …}
  template <class Value>
  PENDULA_INLINE static components each(Value&& value) {
    return [&]<std::size_t... i>(std::index_sequence<i...>) {
      return components{value.template operator()<i>()...};
    }(std::make_index_sequence<pairs>{});
  }
};

}  // namespace pendula::inline PENDULA_MACHINE
