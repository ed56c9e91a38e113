#include <bit>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "pendula/scalar/product.hpp"
#include "pendula/scalar/sincos.hpp"
#include "random.hpp"

using pendula::lane, pendula::pack, pendula::set_lane;

namespace {

bool same_bits(double a, double b) { return std::bit_cast<std::int64_t>(a) == std::bit_cast<std::int64_t>(b); }

// Every lane of f(packs) against f(scalars), on numbers of every size and on the special ones.
template <int W, class Function>
void lanes_equal_scalars(Function&& f) {
  const double special[] = {0.0, -0.0, 1.0, -1.0, 1e-320, 1e300, HUGE_VAL, -HUGE_VAL};
  auto random = generator();
  std::uniform_real_distribution<double> exponent(-30, 24);
  for (int round = 0; round < 500; ++round) {
    double a[W], b[W];
    pack<double, W> x(0.0), y(0.0);
    for (int i = 0; i < W; ++i) {
      a[i] = round < 8 ? special[(round + i) % 8] : std::exp2(exponent(random)) - std::exp2(exponent(random));
      b[i] = round < 8 ? special[(round + 3 * i) % 8] : std::exp2(exponent(random)) - std::exp2(exponent(random));
      set_lane(x, i, a[i]);
      set_lane(y, i, b[i]);
    }
    const auto packed = f(x, y);
    for (int i = 0; i < W; ++i) {
      const double got = lane(packed, i), want = f(a[i], b[i]);
      BOOST_TEST((same_bits(got, want) || (std::isnan(got) && std::isnan(want))),
                 "lane " << i << " of " << W << ": " << got << " is not " << want << " for " << a[i] << ", " << b[i]);
    }
  }
}

template <class Function>
void lanes_equal_scalars_at_all_widths(Function&& f) {
  lanes_equal_scalars<2>(f);
  lanes_equal_scalars<4>(f);
  lanes_equal_scalars<8>(f);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_lane_of_each_operation_is_the_scalar_operation) {
  lanes_equal_scalars_at_all_widths([](auto a, auto b) { return a + b; });
  lanes_equal_scalars_at_all_widths([](auto a, auto b) { return a - b; });
  lanes_equal_scalars_at_all_widths([](auto a, auto b) { return a * b; });
  lanes_equal_scalars_at_all_widths([](auto a, auto b) { return a / b; });
  lanes_equal_scalars_at_all_widths([](auto a, auto) { return -a; });
}

BOOST_AUTO_TEST_CASE(a_lane_of_each_function_is_the_scalar_function) {
  lanes_equal_scalars_at_all_widths([](auto a, auto) { return pendula::sincos(a).sin; });
  lanes_equal_scalars_at_all_widths([](auto a, auto) { return pendula::sincos(a).cos; });
  lanes_equal_scalars_at_all_widths([](auto a, auto b) { return pendula::two_product(a, b).tail; });
}

BOOST_AUTO_TEST_CASE(a_broadcast_keeps_the_sign_of_zero) {
  BOOST_TEST(std::signbit(lane(pack<double, 4>(-0.0), 3)));
  BOOST_TEST(!std::signbit(lane(pack<double, 4>(0.0), 3)));
}

BOOST_AUTO_TEST_CASE(finite_tells_lanes_apart) {
  pack<double, 4> a(1.0), b(2.0);
  set_lane(a, 1, HUGE_VAL);
  set_lane(b, 2, std::nan(""));
  const auto well = pendula::finite<pack<double, 4>>(pendula::vec<pack<double, 4>, 2>{a, b});
  for (int i = 0; i < 4; ++i) BOOST_TEST(pendula::lane_of(well, i) == (i == 0 || i == 3), i);
  BOOST_TEST(!pendula::all_lanes(well));
}

BOOST_AUTO_TEST_CASE(two_product_is_exact) {  // what a fused multiply-add says the error is
  auto random = generator();
  std::uniform_real_distribution<double> factor(-1e3, 1e3);
  for (int i = 0; i < 1000; ++i) {
    const double a = factor(random), b = factor(random);
    BOOST_TEST(pendula::two_product(a, b).tail == std::fma(a, b, -(a * b)), a << " times " << b);
  }
}

BOOST_AUTO_TEST_CASE(difference_of_products_does_not_cancel) {
  const double a = 1.0 + 0x1p-30, d = 1.0 - 0x1p-30;
  BOOST_TEST(pendula::difference_of_products(a, d, 1.0, 1.0) == -0x1p-60);  // (1 + ε)(1 − ε) − 1 = −ε²; plainly 0
}
