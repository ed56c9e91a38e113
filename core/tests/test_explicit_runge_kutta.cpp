#include <boost/rational.hpp>
#include <boost/test/unit_test.hpp>

#include "pendula/catalog.hpp"

using rational = boost::rational<long long>;

namespace {

rational exact(pendula::fraction f) { return {f.numerator, f.denominator}; }

// The order conditions of Butcher (1963) up to order four, in exact arithmetic: one for each rooted tree.
template <std::size_t s>
int order_of(const pendula::butcher_tableau<s>& table) {
  std::array<rational, s> c{}, ac{}, ac2{}, aac{};
  for (std::size_t i = 0; i < s; ++i)
    for (std::size_t j = 0; j < i; ++j) c[i] += exact(table.a[i][j]);
  for (std::size_t i = 0; i < s; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      ac[i] += exact(table.a[i][j]) * c[j];
      ac2[i] += exact(table.a[i][j]) * c[j] * c[j];
    }
  for (std::size_t i = 0; i < s; ++i)
    for (std::size_t j = 0; j < i; ++j) aac[i] += exact(table.a[i][j]) * ac[j];
  const auto sum = [&](auto&& term) {
    rational total = 0;
    for (std::size_t i = 0; i < s; ++i) total += exact(table.b[i]) * term(i);
    return total;
  };
  if (sum([](auto) { return rational(1); }) != rational(1)) return 0;
  if (sum([&](auto i) { return c[i]; }) != rational(1, 2)) return 1;
  if (sum([&](auto i) { return c[i] * c[i]; }) != rational(1, 3) ||
      sum([&](auto i) { return ac[i]; }) != rational(1, 6))
    return 2;
  if (sum([&](auto i) { return c[i] * c[i] * c[i]; }) != rational(1, 4) ||
      sum([&](auto i) { return c[i] * ac[i]; }) != rational(1, 8) ||
      sum([&](auto i) { return ac2[i]; }) != rational(1, 12) || sum([&](auto i) { return aac[i]; }) != rational(1, 24))
    return 3;
  return 4;
}

}  // namespace

BOOST_AUTO_TEST_CASE(tableaux_satisfy_the_conditions_of_their_order_and_no_more) {
  BOOST_TEST(order_of(pendula::euler_tableau) == pendula::euler_tableau.order);
  BOOST_TEST(order_of(pendula::heun_tableau) == pendula::heun_tableau.order);
  BOOST_TEST(order_of(pendula::rk4_tableau) == pendula::rk4_tableau.order);
}

BOOST_AUTO_TEST_CASE(a_step_is_what_the_paper_writes) {
  const double p[] = {0.8, 9.81, 1.0}, h = 0.05;
  const auto system = pendula::simple_pendulum::make<double>(0, p);
  const auto f = [&](std::array<double, 2> u) { return system.rhs(0.0, u); };
  const std::array<double, 2> u0{1.2, -0.4};
  const auto plus = [](std::array<double, 2> u, double c, std::array<double, 2> k) {
    return std::array<double, 2>{u[0] + c * k[0], u[1] + c * k[1]};
  };
  const auto k1 = f(u0), euler = plus(u0, h, k1), w = f(euler);  // (52)
  const auto heun = plus(plus(u0, h / 2, k1), h / 2, w);         // (54) with its h
  const auto k2 = f(plus(u0, h / 2, k1)), k3 = f(plus(u0, h / 2, k2)), k4 = f(plus(u0, h, k3));
  const auto rk4 = plus(plus(plus(plus(u0, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);  // (56)
  for (int i = 0; i < 2; ++i) {
    BOOST_TEST(std::abs(pendula::euler::step(system, 0.0, u0, h)[i] - euler[i]) < 1e-15);
    BOOST_TEST(std::abs(pendula::heun::step(system, 0.0, u0, h)[i] - heun[i]) < 1e-15);
    BOOST_TEST(std::abs(pendula::rk4::step(system, 0.0, u0, h)[i] - rk4[i]) < 1e-15);
  }
}
