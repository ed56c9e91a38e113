// pack<T, W>: W numbers that move in lock step through one instruction stream. Every operation is the
// elementwise IEEE operation, so a lane carries the same bits as the scalar run.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "pendula/concepts.hpp"

namespace pendula::inline PENDULA_MACHINE {

// Lanes that one register holds.
#if defined(__AVX512F__)
inline constexpr int lanes_of_machine = 8;
#elif defined(__AVX__)
inline constexpr int lanes_of_machine = 4;
#else
inline constexpr int lanes_of_machine = 2;
#endif

namespace detail {
template <class T, int W>
struct vector_extension {
  typedef T type __attribute__((vector_size(W * sizeof(T))));
};

// Two of a kind, worked on one after the other: the second fills the time that the first one's result takes.
template <class Half>
struct two_halves {
  Half low, high;

  PENDULA_INLINE std::int64_t operator[](int i) const {
    constexpr int half = sizeof(Half) / sizeof(std::int64_t);
    return i < half ? low[i] : high[i - half];
  }
  PENDULA_INLINE friend two_halves operator-(two_halves a) { return {-a.low, -a.high}; }
  PENDULA_INLINE friend two_halves operator~(two_halves a) { return {~a.low, ~a.high}; }
  PENDULA_INLINE friend two_halves operator+(two_halves a, two_halves b) { return {a.low + b.low, a.high + b.high}; }
  PENDULA_INLINE friend two_halves operator-(two_halves a, two_halves b) { return {a.low - b.low, a.high - b.high}; }
  PENDULA_INLINE friend two_halves operator&(two_halves a, two_halves b) { return {a.low & b.low, a.high & b.high}; }
  PENDULA_INLINE friend two_halves operator|(two_halves a, two_halves b) { return {a.low | b.low, a.high | b.high}; }
  PENDULA_INLINE friend two_halves operator^(two_halves a, two_halves b) { return {a.low ^ b.low, a.high ^ b.high}; }
  PENDULA_INLINE friend two_halves operator+(two_halves a, std::int64_t b) { return {a.low + b, a.high + b}; }
  PENDULA_INLINE friend two_halves operator-(std::int64_t a, two_halves b) { return {a - b.low, a - b.high}; }
  PENDULA_INLINE friend two_halves operator&(two_halves a, std::int64_t b) { return {a.low & b, a.high & b}; }
  PENDULA_INLINE friend two_halves operator<<(two_halves a, int b) { return {a.low << b, a.high << b}; }
  PENDULA_INLINE friend two_halves operator>>(two_halves a, int b) { return {a.low >> b, a.high >> b}; }
};
}  // namespace detail

template <class T, int W>
struct pack {
  static_assert(W > 1 && (W & (W - 1)) == 0, "one lane is the plain scalar; more come in powers of two");
  static_assert(sizeof(T) == sizeof(std::int64_t), "masks and bit patterns are 64 bits wide");
  using vector = typename detail::vector_extension<T, W>::type;
  using integers = typename detail::vector_extension<std::int64_t, W>::type;

  vector v;

  pack() = default;
  PENDULA_INLINE pack(T x) : v(x - vector{}) {}  // x − 0 keeps the sign of −0, 0 + x does not
  PENDULA_INLINE explicit pack(vector x) : v(x) {}

  PENDULA_INLINE T operator[](int lane) const { return v[lane]; }
  PENDULA_INLINE void set(int lane, T x) { v[lane] = x; }

  PENDULA_INLINE friend pack operator+(pack a, pack b) { return pack(a.v + b.v); }
  PENDULA_INLINE friend pack operator-(pack a, pack b) { return pack(a.v - b.v); }
  PENDULA_INLINE friend pack operator*(pack a, pack b) { return pack(a.v * b.v); }
  PENDULA_INLINE friend pack operator/(pack a, pack b) { return pack(a.v / b.v); }
  PENDULA_INLINE friend pack operator-(pack a) { return pack(-a.v); }
  PENDULA_INLINE friend integers equal(pack a, pack b) { return a.v == b.v; }
  PENDULA_INLINE friend integers less(pack a, pack b) { return a.v < b.v; }
  PENDULA_INLINE friend pack choose(integers condition, pack yes, pack no) { return pack(condition ? yes.v : no.v); }
  // Bit patterns, for signs and quadrants without branches.
  PENDULA_INLINE friend integers bits(pack x) { return (integers)x.v; }
  PENDULA_INLINE static pack from(integers pattern) { return pack((vector)pattern); }
};

// More lanes than a register holds.
template <class T, int W>
  requires(W > lanes_of_machine)
struct pack<T, W> {
  using half = pack<T, W / 2>;
  using integers = detail::two_halves<typename half::integers>;

  half low, high;

  pack() = default;
  PENDULA_INLINE pack(T x) : low(x), high(x) {}
  PENDULA_INLINE pack(half a, half b) : low(a), high(b) {}

  PENDULA_INLINE T operator[](int lane) const { return lane < W / 2 ? low[lane] : high[lane - W / 2]; }
  PENDULA_INLINE void set(int lane, T x) { lane < W / 2 ? low.set(lane, x) : high.set(lane - W / 2, x); }

  PENDULA_INLINE friend pack operator+(pack a, pack b) { return {a.low + b.low, a.high + b.high}; }
  PENDULA_INLINE friend pack operator-(pack a, pack b) { return {a.low - b.low, a.high - b.high}; }
  PENDULA_INLINE friend pack operator*(pack a, pack b) { return {a.low * b.low, a.high * b.high}; }
  PENDULA_INLINE friend pack operator/(pack a, pack b) { return {a.low / b.low, a.high / b.high}; }
  PENDULA_INLINE friend pack operator-(pack a) { return {-a.low, -a.high}; }
  PENDULA_INLINE friend integers equal(pack a, pack b) { return {equal(a.low, b.low), equal(a.high, b.high)}; }
  PENDULA_INLINE friend integers less(pack a, pack b) { return {less(a.low, b.low), less(a.high, b.high)}; }
  PENDULA_INLINE friend pack choose(integers condition, pack yes, pack no) {
    return {choose(condition.low, yes.low, no.low), choose(condition.high, yes.high, no.high)};
  }
  PENDULA_INLINE friend integers bits(pack x) { return {bits(x.low), bits(x.high)}; }
  PENDULA_INLINE static pack from(integers pattern) { return {half::from(pattern.low), half::from(pattern.high)}; }
};

// The handful of things that differ between a number and lanes of numbers.
template <class S>
struct lanes {  // plain scalars: one lane
  static constexpr int count = 1;
};
template <class T, int W>
struct lanes<pack<T, W>> {
  static constexpr int count = W;
};

// Whether signs, exponents and quadrants can be taken from the bits of a number: bits(x), from_bits<S>(pattern).
template <class S>
inline constexpr bool has_bit_pattern = false;
template <>
inline constexpr bool has_bit_pattern<double> = true;
template <class T, int W>
inline constexpr bool has_bit_pattern<pack<T, W>> = true;

// Whether coefficients with the digits of a double are as good as any.
template <class S>
inline constexpr bool has_double_precision = has_bit_pattern<S>;

// Whether the rounding error of a sum or product is worth carrying along: not where there are digits to spare.
template <class S>
inline constexpr bool carries_rounding = has_bit_pattern<S>;

PENDULA_INLINE double lane(double x, int) { return x; }
template <class T, int W>
PENDULA_INLINE T lane(const pack<T, W>& x, int i) {
  return x[i];
}

PENDULA_INLINE void set_lane(double& x, int, double value) { x = value; }
template <class T, int W>
PENDULA_INLINE void set_lane(pack<T, W>& x, int i, T value) {
  x.set(i, value);
}

// A lane of all numbers in a struct of nothing but S, from the same struct of plain numbers.
template <class Lanes, class Numbers>
void set_lanes(Lanes& to, int i, const Numbers& from) {
  constexpr std::size_t count = sizeof(Numbers) / sizeof(double), width = sizeof(Lanes) / sizeof(Numbers);
  static_assert(sizeof(Lanes) == width * sizeof(Numbers) && std::is_trivially_copyable_v<Lanes>);
  const double* const numbers = reinterpret_cast<const double*>(&from);
  double* const lanes = reinterpret_cast<double*>(&to);
  for (std::size_t n = 0; n < count; ++n) lanes[n * width + i] = numbers[n];
}

PENDULA_INLINE bool equal(double a, double b) { return a == b; }
PENDULA_INLINE bool less(double a, double b) { return a < b; }
PENDULA_INLINE double choose(bool condition, double yes, double no) { return condition ? yes : no; }

// Masks: a bool, or 64-bit integers with all bits set where true.
template <class M>
concept LaneMask = (sizeof(M) > sizeof(std::int64_t));

PENDULA_INLINE bool all_lanes(bool m) { return m; }
template <LaneMask M>
PENDULA_INLINE bool all_lanes(M mask) {
  std::int64_t joined = -1;
  for (std::size_t i = 0; i < sizeof(M) / sizeof(std::int64_t); ++i) joined &= mask[i];
  return joined != 0;
}

PENDULA_INLINE bool lane_of(bool m, int) { return m; }
template <LaneMask M>
PENDULA_INLINE bool lane_of(M mask, int i) {
  return mask[i] != 0;
}

PENDULA_INLINE std::int64_t bits(double x) { return std::bit_cast<std::int64_t>(x); }

template <class S>
PENDULA_INLINE S from_bits(decltype(bits(S(0.0))) pattern) {
  if constexpr (lanes<S>::count == 1) {
    return std::bit_cast<S>(pattern);
  } else {
    return S::from(pattern);
  }
}

// True where every component is neither infinite nor NaN (nor so large that their sum is): x − x is 0 for those alone.
template <class S, std::size_t d>
PENDULA_INLINE auto finite(const vec<S, d>& y) {
  S sum = y[0];
  for (std::size_t i = 1; i < d; ++i) sum = sum + y[i];
  return equal(sum - sum, S(0.0));
}

}  // namespace pendula::inline PENDULA_MACHINE
