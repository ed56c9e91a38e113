// What the language has no operator for: square roots of lanes, and the rounding error of a product.
#pragma once

#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "pendula/scalar/pack.hpp"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace pendula::inline PENDULA_MACHINE {

namespace detail {
// Lane i gets the number place(i) of those of a and b, counted through.
template <class Vector, class Place, int... i>
PENDULA_INLINE Vector shuffled(Vector a, Vector b, Place place, std::integer_sequence<int, i...>) {
  return __builtin_shufflevector(a, b, place(i)...);
}
template <int W, class Place>
PENDULA_INLINE pack<double, W> shuffled(pack<double, W> a, pack<double, W> b, Place place) {
  return pack<double, W>(shuffled(a.v, b.v, place, std::make_integer_sequence<int, W>{}));
}
template <class Vector, int... i>
PENDULA_INLINE auto joined(Vector low, Vector high, std::integer_sequence<int, i...>) {
  return __builtin_shufflevector(low, high, i...);
}
template <int first, class Vector, int... i>
PENDULA_INLINE auto part(Vector all, std::integer_sequence<int, i...>) {
  return __builtin_shufflevector(all, all, (first + i)...);
}
}  // namespace detail

// Lanes from and to memory, as they lie there and as pairs, whose first numbers go to one and second ones to the other.
PENDULA_INLINE void load(const double* from, double& x) { x = *from; }
PENDULA_INLINE void store(double x, double* to) { *to = x; }
template <int W>
PENDULA_INLINE void load(const double* from, pack<double, W>& x) {
  std::memcpy(&x, from, sizeof x);
}
template <int W>
PENDULA_INLINE void store(pack<double, W> x, double* to) {
  std::memcpy(to, &x, sizeof x);
}
template <int W>
PENDULA_INLINE void load_pairs(const double* from, pack<double, W>& first, pack<double, W>& second) {
  if constexpr (W > lanes_of_machine) {
    load_pairs(from, first.low, second.low);
    load_pairs(from + W, first.high, second.high);
  } else {
    pack<double, W> a, b;
    load(from, a);
    load(from + W, b);
    first = detail::shuffled(a, b, [](int i) { return 2 * i; });
    second = detail::shuffled(a, b, [](int i) { return 2 * i + 1; });
  }
}
template <int W>
PENDULA_INLINE void store_pairs(pack<double, W> first, pack<double, W> second, double* to) {
  if constexpr (W > lanes_of_machine) {
    store_pairs(first.low, second.low, to);
    store_pairs(first.high, second.high, to + W);
  } else {
    store(detail::shuffled(first, second, [](int i) { return i / 2 + (i % 2) * W; }), to);
    store(detail::shuffled(first, second, [](int i) { return (i + W) / 2 + (i % 2) * W; }), to + W);
  }
}

// Twice as many lanes, and each half of them; in registers, where a copy through memory would be waited for.
template <int W>
PENDULA_INLINE pack<double, 2 * W> joined(pack<double, W> low, pack<double, W> high) {
  if constexpr (2 * W > lanes_of_machine) {
    return {low, high};
#if defined(__AVX__)
  } else if constexpr (W == 2) {  // the compiler's own way takes a slower instruction
    return pack<double, 4>(_mm256_insertf128_pd(_mm256_castpd128_pd256(low.v), high.v, 1));
#endif
  } else {
    return pack<double, 2 * W>(detail::joined(low.v, high.v, std::make_integer_sequence<int, 2 * W>{}));
  }
}
template <int W>
PENDULA_INLINE std::array<pack<double, W / 2>, 2> halves(pack<double, W> both) {
  if constexpr (W > lanes_of_machine) {
    return {both.low, both.high};
#if defined(__AVX__)
  } else if constexpr (W == 4) {
    return {pack<double, 2>(_mm256_castpd256_pd128(both.v)), pack<double, 2>(_mm256_extractf128_pd(both.v, 1))};
#endif
  } else {
    constexpr auto half = std::make_integer_sequence<int, W / 2>{};
    return {pack<double, W / 2>(detail::part<0>(both.v, half)), pack<double, W / 2>(detail::part<W / 2>(both.v, half))};
  }
}

// The lanes in another order, or some of them more than once.
template <int... from>
PENDULA_INLINE pack<double, sizeof...(from)> rearranged(pack<double, sizeof...(from)> x) {
  constexpr int width = sizeof...(from);
  pack<double, width> result;
  if constexpr (width > lanes_of_machine) {
    int to = 0;
    (result.set(to++, x[from]), ...);
  } else {
    result.v = __builtin_shufflevector(x.v, x.v, from...);
  }
  return result;
}
template <class... Numbers>
PENDULA_INLINE pack<double, sizeof...(Numbers)> lanes_of(Numbers... numbers) {
  pack<double, sizeof...(Numbers)> result;
  if constexpr (sizeof...(Numbers) > lanes_of_machine) {
    int to = 0;
    (result.set(to++, numbers), ...);
  } else {
    result.v = decltype(result.v){numbers...};
  }
  return result;
}

PENDULA_INLINE double square_root(double x) { return std::sqrt(x); }
template <int W>
PENDULA_INLINE pack<double, W> square_root(pack<double, W> x) {
  if constexpr (W > lanes_of_machine) {
    return {square_root(x.low), square_root(x.high)};
#if defined(__AVX512F__)
  } else if constexpr (W == 8) {
    return pack<double, W>(_mm512_sqrt_pd(x.v));
#endif
#if defined(__AVX__)
  } else if constexpr (W == 4) {
    return pack<double, W>(_mm256_sqrt_pd(x.v));
#endif
#if defined(__SSE2__)
  } else if constexpr (W == 2) {
    return pack<double, W>(_mm_sqrt_pd(x.v));
#endif
  } else {  // no intrinsic: other processors, WebAssembly
    for (int l = 0; l < W; ++l) x.set(l, std::sqrt(x[l]));
    return x;
  }
}

// table[index], lane by lane.
template <class S>
PENDULA_INLINE S looked_up(const double* table, decltype(bits(S(0.0))) index) {
  if constexpr (lanes<S>::count == 1) {
    return table[index];
  } else if constexpr (lanes<S>::count > lanes_of_machine) {
    return {looked_up<typename S::half>(table, index.low), looked_up<typename S::half>(table, index.high)};
  } else {
#if defined(__AVX512F__)
    if constexpr (lanes<S>::count == 8) return S(_mm512_i64gather_pd((__m512i)index, table, 8));
#endif
    S found;
    for (int l = 0; l < lanes<S>::count; ++l) found.set(l, table[index[l]]);
    return found;
  }
}

// a b − p with one rounding: where p is the rounded product it is its error, exactly. This is the one use of a fused
// multiply-add: the same bits as Dekker's products (product.hpp), in a tenth of the time.
#if defined(__FMA__)
inline constexpr bool fused_multiply_add = true;
PENDULA_INLINE double product_minus(double a, double b, double p) { return __builtin_fma(a, b, -p); }
template <int W>
PENDULA_INLINE pack<double, W> product_minus(pack<double, W> a, pack<double, W> b, pack<double, W> p) {
  if constexpr (W > lanes_of_machine) {
    return {product_minus(a.low, b.low, p.low), product_minus(a.high, b.high, p.high)};
#if defined(__AVX512F__)
  } else if constexpr (W == 8) {
    return pack<double, W>(_mm512_fmsub_pd(a.v, b.v, p.v));
#endif
  } else if constexpr (W == 4) {
    return pack<double, W>(_mm256_fmsub_pd(a.v, b.v, p.v));
  } else {
    static_assert(W == 2);
    return pack<double, W>(_mm_fmsub_pd(a.v, b.v, p.v));
  }
}
#else
inline constexpr bool fused_multiply_add = false;
template <class S>
S product_minus(S a, S b, S p);
#endif

}  // namespace pendula::inline PENDULA_MACHINE
