#include <boost/test/unit_test.hpp>
#include <cstring>
#include <vector>

#include "pendula/exact/simple_times.hpp"
#include "pendula/kernels/exact.hpp"
#include "pendula/kernels/machine.hpp"
#include "random.hpp"

using pendula::exact_outcome;

namespace {

bool always() { return true; }

// Of swings, turns and the neighbourhood of the separatrix.
std::vector<double> some_states(std::size_t count) {
  auto random = generator();
  std::uniform_real_distribution<double> angle(-20.0, 20.0), speed(-9.0, 9.0);
  std::vector<double> states;
  for (std::size_t i = 0; i < count; ++i) {
    const double theta = angle(random), top = 2.0 * std::sqrt(9.81) * std::fabs(std::cos(0.5 * theta));
    states.push_back(theta);
    states.push_back(i % 3 == 0 ? 0.0 : i % 3 == 1 ? speed(random) : top * (1.0 + 1e-7 * speed(random)));
  }
  return states;
}

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_machine_and_every_number_of_points_gives_the_same_bits) {
  const auto all = pendula::all_exact();
  const std::vector<double> times{-3.0, 0.0, 0.1, 7.0, 1e3, 1e8, -4e8, 2.0, 5.0, 3e9, 1e12};
  for (std::size_t count : {1, 2, 5, 16, 37}) {
    const auto states = some_states(count);
    const pendula::exact_request asked{1.0, 9.81, states.data(), count, times.data(), times.size(), 0.25};
    std::vector<double> first(2 * count * times.size()), out(first.size()), singly(first.size());
    BOOST_TEST((pendula::exact_simple(*all[0], asked, first.data(), always) == exact_outcome::complete));
    std::vector<double> linear(first.size());
    pendula::exact_linear(*all[0], asked, linear.data(), always);
    for (std::size_t machine = 0; machine < all.size(); ++machine) {
      const auto* const kernels = all[machine];
      const auto name = pendula::machine_names[machine];
      pendula::exact_linear(*kernels, asked, out.data(), always);
      BOOST_TEST(same(out, linear), name << " linear " << count);
      pendula::exact_simple(*kernels, asked, out.data(), always);
      BOOST_TEST(same(out, first), name << " " << count);
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < times.size(); ++j)
          pendula::exact_simple(*kernels, {1.0, 9.81, &states[2 * i], 1, &times[j], 1, 0.25},
                                &singly[2 * (i * times.size() + j)], always);
      BOOST_TEST(same(singly, first), name << " one by one, " << count);
    }
  }
}

BOOST_AUTO_TEST_CASE(what_is_too_large_is_refused) {
  const auto& kernels = *pendula::all_exact().back();
  const double far = 1e62, near = 1.0, states[] = {1.0, 0.0, 1e16, 0.0};
  double out[4];
  BOOST_TEST(
      (pendula::exact_simple(kernels, {1.0, 9.81, states, 1, &far, 1, 0.0}, out, always) == exact_outcome::refused));
  BOOST_TEST(std::isnan(out[0]));
  BOOST_TEST(
      (pendula::exact_simple(kernels, {1.0, 9.81, states, 2, &near, 1, 0.0}, out, always) == exact_outcome::refused));
  BOOST_TEST((std::isfinite(out[0]) && std::isnan(out[2])));
  BOOST_TEST(
      (pendula::exact_linear(kernels, {1.0, 9.81, states, 1, &far, 1, 0.0}, out, always) == exact_outcome::refused));
}

BOOST_AUTO_TEST_CASE(work_stops_when_asked_to) {
  const auto& kernels = *pendula::all_exact().back();
  const auto states = some_states(1);
  const std::vector<double> times(200000, 1.0);
  std::vector<double> out(2 * times.size(), -1.0);
  const pendula::exact_request asked{1.0, 9.81, states.data(), 1, times.data(), times.size(), 0.0};
  const auto never = [] { return false; };
  BOOST_TEST((pendula::exact_simple(kernels, asked, out.data(), never) == exact_outcome::stopped));
  BOOST_TEST(out.back() == -1.0);
  BOOST_TEST((pendula::exact_linear(kernels, asked, out.data(), never) == exact_outcome::stopped));
}

BOOST_AUTO_TEST_CASE(many_digits_go_on_where_wide_numbers_end) {  // on both sides of their border, the same motion
  const double length = 1.0, gravity = 9.81;
  const pendula::simple_constants<double> constants(length, gravity);
  const pendula::simple_motion<double> wide(constants, pendula::start_of(constants, 2.0, 1.0));
  const pendula::simple_motion<double> many(constants, pendula::start_of_many_digits(length, gravity, 2.0, 1.0).start);
  for (double t : {0.3, -70.0, 1e6, 1e10}) {
    const auto a = wide.at(pendula::wide<double>(t)), b = many.at(pendula::wide<double>(t));
    BOOST_TEST(a.digits_enough);
    BOOST_TEST(std::fabs(a.theta - b.theta) < 1e-15, t);
    BOOST_TEST(std::fabs(a.omega - b.omega) < 4e-15, t);
  }
  BOOST_TEST(!wide.at(pendula::wide<double>(1e12)).digits_enough);
}

BOOST_AUTO_TEST_CASE(a_release_next_to_the_top_falls) {
  const double top = 3.141592653589793;  // is below π
  const double quarter = 0.25 * pendula::simple_period(1.0, 9.81, top, 0.0), states[] = {top, 0.0};
  double out[2];
  pendula::exact_simple(*pendula::all_exact().back(), {1.0, 9.81, states, 1, &quarter, 1, 0.0}, out, always);
  BOOST_TEST(std::fabs(out[0]) < 1e-14);
  BOOST_TEST(std::fabs(out[1] + 2.0 * std::sqrt(9.81)) < 1e-14);
}
