// Sine and cosine with twice the digits, of a number given exactly.
#pragma once

#include <array>

#include "pendula/scalar/choose.hpp"
#include "pendula/scalar/rough_powers.hpp"
#include "pendula/scalar/wide.hpp"

namespace pendula::inline PENDULA_MACHINE {

inline constexpr double largest_wide_angle = 0x1p13;
// Errors in parts of the result, and of the angle: next to a multiple of π/2 all that is left of it is right.
inline constexpr double wide_sincos_error = 0x1p-98;

namespace detail {
// sin(j π/128) for a quarter turn, head and tail.
inline constexpr double quarter_of_sine_table[65][2] = {
    {0.0, 0.0},
    {0x1.92155f7a3667ep-6, -0x1.b1d63091a0130p-64},
    {0x1.91f65f10dd814p-5, -0x1.912bd0d569a90p-61},
    {0x1.2d52092ce19f6p-4, -0x1.9a088a8bf6b2cp-59},
    {0x1.917a6bc29b42cp-4, -0x1.e2718d26ed688p-60},
    {0x1.f564e56a9730ep-4, 0x1.a2704729ae56dp-59},
    {0x1.2c8106e8e613ap-3, 0x1.13000a89a11e0p-58},
    {0x1.5e214448b3fc6p-3, 0x1.531ff779ddac6p-57},
    {0x1.8f8b83c69a60bp-3, -0x1.26d19b9ff8d82p-57},
    {0x1.c0b826a7e4f63p-3, -0x1.af1439e521935p-62},
    {0x1.f19f97b215f1bp-3, -0x1.42deef11da2c4p-57},
    {0x1.111d262b1f677p-2, 0x1.824c20ab7aa9ap-56},
    {0x1.294062ed59f06p-2, -0x1.5d28da2c4612dp-56},
    {0x1.4135c94176601p-2, 0x1.0c97c4afa2518p-56},
    {0x1.58f9a75ab1fddp-2, -0x1.efdc0d58cf620p-62},
    {0x1.7088530fa459fp-2, -0x1.44b19e0864c5dp-56},
    {0x1.87de2a6aea963p-2, -0x1.72cedd3d5a610p-57},
    {0x1.9ef7943a8ed8ap-2, 0x1.6da81290bdbabp-57},
    {0x1.b5d1009e15cc0p-2, 0x1.5b362cb974183p-57},
    {0x1.cc66e9931c45ep-2, 0x1.6850e59c37f8fp-58},
    {0x1.e2b5d3806f63bp-2, 0x1.e0d891d3c6841p-58},
    {0x1.f8ba4dbf89abap-2, -0x1.2ec1fc1b776b8p-60},
    {0x1.073879922ffeep-1, -0x1.a5a014347406cp-55},
    {0x1.11eb3541b4b23p-1, -0x1.ef23b69abe4f1p-55},
    {0x1.1c73b39ae68c8p-1, 0x1.b25dd267f6600p-55},
    {0x1.26d054cdd12dfp-1, -0x1.5da743ef3770cp-55},
    {0x1.30ff7fce17035p-1, -0x1.efcc626f74a6fp-57},
    {0x1.3affa292050b9p-1, 0x1.e3e25e3954964p-56},
    {0x1.44cf325091dd6p-1, 0x1.8076a2cfdc6b3p-57},
    {0x1.4e6cabbe3e5e9p-1, 0x1.3c293edceb327p-57},
    {0x1.57d69348ceca0p-1, -0x1.75720992bfbb2p-55},
    {0x1.610b7551d2cdfp-1, -0x1.251b352ff2a37p-56},
    {0x1.6a09e667f3bcdp-1, -0x1.bdd3413b26456p-55},
    {0x1.72d0837efff96p-1, 0x1.0d4ef0f1d915cp-55},
    {0x1.7b5df226aafafp-1, -0x1.0f537acdf0ad7p-56},
    {0x1.83b0e0bff976ep-1, -0x1.6f420f8ea3475p-56},
    {0x1.8bc806b151741p-1, -0x1.2c5e12ed1336dp-55},
    {0x1.93a22499263fbp-1, 0x1.3d419a920df0bp-55},
    {0x1.9b3e047f38741p-1, -0x1.30ee286712474p-55},
    {0x1.a29a7a0462782p-1, -0x1.128bb015df175p-56},
    {0x1.a9b66290ea1a3p-1, 0x1.9f630e8b6dac8p-60},
    {0x1.b090a58150200p-1, -0x1.926da300ffccep-55},
    {0x1.b728345196e3ep-1, -0x1.bc69f324e6d61p-55},
    {0x1.bd7c0ac6f952ap-1, -0x1.825a732ac700ap-55},
    {0x1.c38b2f180bdb1p-1, -0x1.6e0b1757c8d07p-56},
    {0x1.c954b213411f5p-1, -0x1.2fb761e946603p-58},
    {0x1.ced7af43cc773p-1, -0x1.e7b6bb5ab58aep-58},
    {0x1.d4134d14dc93ap-1, -0x1.4ef5295d25af2p-55},
    {0x1.d906bcf328d46p-1, 0x1.457e610231ac2p-56},
    {0x1.ddb13b6ccc23cp-1, 0x1.83c37c6107db3p-55},
    {0x1.e212104f686e5p-1, -0x1.014c76c126527p-55},
    {0x1.e6288ec48e112p-1, -0x1.16b56f2847754p-57},
    {0x1.e9f4156c62ddap-1, 0x1.760b1e2e3f81ep-55},
    {0x1.ed740e7684963p-1, 0x1.e82c791f59cc2p-56},
    {0x1.f0a7efb9230d7p-1, 0x1.52c7adc6b4989p-56},
    {0x1.f38f3ac64e589p-1, -0x1.d7bafb51f72e6p-56},
    {0x1.f6297cff75cb0p-1, 0x1.562172a361fd3p-56},
    {0x1.f8764fa714ba9p-1, 0x1.ab256778ffcb6p-56},
    {0x1.fa7557f08a517p-1, -0x1.7a0a8ca13571fp-55},
    {0x1.fc26470e19fd3p-1, 0x1.1ec8668ecaceep-55},
    {0x1.fd88da3d12526p-1, -0x1.87df6378811c7p-55},
    {0x1.fe9cdad01883ap-1, 0x1.521ecd0c67e35p-57},
    {0x1.ff621e3796d7ep-1, -0x1.c57bc2e24aa15p-57},
    {0x1.ffd886084cd0dp-1, -0x1.1354d4556e4cbp-55},
    {0x1.0000000000000p+0, 0.0},
};
// For a turn, and on to where the cosine of its end stands.
inline constexpr auto sine_table = [] {
  std::array<std::array<double, 2>, 320> table{};
  for (std::size_t j = 0; j < table.size(); ++j) {
    const std::size_t within = j % 128, place = within <= 64 ? within : 128 - within;
    for (std::size_t part = 0; part < 2; ++part)
      table[j][part] = (j % 256 < 128 ? 1.0 : -1.0) * quarter_of_sine_table[place][part];
  }
  return table;
}();
// π/128 in parts of 33, 33, 53 and 53 bits: whole multiples below 2^20 of the first two are exact.
inline constexpr double table_step[4] = {0x1.921fb54400000p-6, 0x1.0b4611a600000p-40, 0x1.3198a2e037073p-75,
                                         0x1.129024e088a68p-129};
inline constexpr double steps_per_radian = 0x1.45f306dc9c883p+5;
}  // namespace detail

// x − n π/128, which keeps some 100 bits where nearly all of x cancels.
template <class S>
PENDULA_INLINE wide<S> reduce_by_table_step(S x, S n) {
  const auto [a, a_tail] = two_sum(x - n * S(detail::table_step[0]), -(n * S(detail::table_step[1])));
  const auto [third, third_tail] = two_product(n, S(detail::table_step[2]));
  const auto [b, b_tail] = two_sum(a, -third);
  return {b, (a_tail + b_tail) - (third_tail + n * S(detail::table_step[3]))};
}

template <class S>
struct wide_sine_cosine {
  wide<S> sin, cos;
};

// sin d and cos d − 1 for |d| ≤ π/256, by their power series.
template <class S>
PENDULA_INLINE wide_sine_cosine<S> wide_sincos_series(wide<S> d) {
  const wide<S> v = square(d);
  const S sixth = S(-1.0 / 5040.0) + v.hi * (S(1.0 / 362880.0) - v.hi * S(1.0 / 39916800.0));
  const S fifth = S(-1.0 / 720.0) + v.hi * (S(1.0 / 40320.0) - v.hi * S(1.0 / 3628800.0));
  const wide<S> fifth_of_sin(S(0x1.1111111111111p-7), S(0x1.1111111111111p-63));    // 1/120
  const wide<S> third_of_sin(S(-0x1.5555555555555p-3), S(-0x1.5555555555555p-57));  // −1/6
  const wide<S> fourth_of_cos(S(0x1.5555555555555p-5), S(0x1.5555555555555p-59));   // 1/24
  const wide<S> of_sin = sum_with_smaller(third_of_sin, v * sum_with_smaller(fifth_of_sin, v.hi * sixth));
  const wide<S> of_cos = sum_with_smaller(wide<S>(-0.5), v * sum_with_smaller(fourth_of_cos, v.hi * fifth));
  return {sum_with_smaller(d, d * (v * of_sin)), v * of_cos};
}

// For |x| < `largest_wide_angle`: sin(a + d) and cos(a + d) from the table's a (Gal 1986) and the rest d.
template <class S>
PENDULA_INLINE wide_sine_cosine<S> wide_sincos(S x) {
  const S n = nearest_whole(x * S(detail::steps_per_radian));
  const auto j = bits(n + S(whole_number_magic)) & 255;  // n in the low bits
  const auto entry = [](auto index) -> wide<S> {
    return {looked_up<S>(&detail::sine_table[0][0], index << 1), looked_up<S>(&detail::sine_table[0][1], index << 1)};
  };
  const wide<S> sine = entry(j), cosine = entry(j + 64);
  const auto [s, c] = wide_sincos_series(reduce_by_table_step(x, n));
  return {sum_with_smaller(sine, sum_with_smaller(cosine * s, sine * c)),
          sum_with_smaller(cosine, sum_with_smaller(-(sine * s), cosine * c))};
}

// Of a wide angle of any size that the tail still belongs to: whole turns come off first.
template <class R>
struct elementary<wide<R>> {
  static R rough(wide<R> x) { return x.hi; }
  static R rough_log2(wide<R> x) { return pendula::rough_log2(x.hi); }
  static sine_cosine<wide<R>> sincos(wide<R> x) {
    const R turns = nearest_whole(x.hi * R(0x1.45f306dc9c883p-3));  // 1/2π
    // 2π in parts of 27, 27 and 53 bits and the rest: whole multiples below 2^26 of the first two are exact
    wide<R> angle = x + wide<R>(turns * R(-0x1.921fb54p+2)) + wide<R>(turns * R(-0x1.10b4610p-28));
    angle =
        angle + wide<R>(two_product(turns, R(-0x1.a62633145c06ep-56))) + wide<R>(turns * R(-0x1.cd129024e088ap-113));
    const auto [s, c] = wide_sincos(angle.hi);
    const wide<R> rest(angle.lo), below = scaled(square(rest), R(0.5));  // the next power is below 2^-150
    return {s + (c * rest - s * below), c - (s * rest + c * below)};
  }
};

}  // namespace pendula::inline PENDULA_MACHINE
