// That a step preserves the symplectic form: its Jacobian J in canonical variables, by dual numbers, has JᵀΩJ = Ω.
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "pendula/catalog.hpp"

namespace {

// A number and its derivatives with respect to the four (or two) canonical variables of the start.
struct dual {
  double value = 0.0;
  std::array<double, 4> d{};

  dual() = default;
  dual(double x) : value(x) {}
  dual(double x, const std::array<double, 4>& by) : value(x), d(by) {}
};

template <class Rule>
dual differentiated(double value, Rule&& derivative) {
  dual result(value);
  for (std::size_t i = 0; i < 4; ++i) result.d[i] = derivative(i);
  return result;
}

dual operator-(const dual& a) {
  return differentiated(-a.value, [&](auto i) { return -a.d[i]; });
}
dual operator+(const dual& a, const dual& b) {
  return differentiated(a.value + b.value, [&](auto i) { return a.d[i] + b.d[i]; });
}
dual operator-(const dual& a, const dual& b) { return a + -b; }
dual operator*(const dual& a, const dual& b) {
  return differentiated(a.value * b.value, [&](auto i) { return a.d[i] * b.value + a.value * b.d[i]; });
}
dual operator/(const dual& a, const dual& b) {
  return differentiated(a.value / b.value, [&](auto i) { return (a.d[i] - a.value / b.value * b.d[i]) / b.value; });
}
bool less(const dual& a, const dual& b) { return a.value < b.value; }
bool equal(const dual& a, const dual& b) { return a.value == b.value; }
dual choose(bool condition, const dual& yes, const dual& no) { return condition ? yes : no; }
// Of all its numbers, so that an iteration goes on until the derivatives, too, have settled.
dual magnitude(const dual& a) {
  double sum = std::fabs(a.value);
  for (double each : a.d) sum += std::fabs(each);
  return sum;
}

}  // namespace

template <>
struct pendula::elementary<dual> {
  static sine_cosine<dual> sincos(const dual& x) {
    const double s = std::sin(x.value), c = std::cos(x.value);
    return {differentiated(s, [&](auto i) { return c * x.d[i]; }),
            differentiated(c, [&](auto i) { return -s * x.d[i]; })};
  }
};

using namespace pendula;

namespace {

// The largest entry of JᵀΩJ − Ω after some steps.
template <class Method, class Sys>
double distortion(const Sys& system, double h) {
  constexpr std::size_t n = Sys::dimension / 2;
  typename Sys::state z;
  for (std::size_t i = 0; i < 2 * n; ++i) {
    z[i] = dual(1.1 - 0.4 * static_cast<double>(i));
    z[i].d[i] = 1.0;
  }
  auto at = Method::begin(system, system.from_canonical(z));
  for (int i = 0; i < 5; ++i) at = Method::step(system, dual(0.0), at, dual(h));
  const auto end = system.canonical(Method::state_of(system, at));
  double largest = 0.0;
  for (std::size_t a = 0; a < 2 * n; ++a)
    for (std::size_t b = 0; b < 2 * n; ++b) {
      double sum = 0.0;
      for (std::size_t i = 0; i < n; ++i) sum += end[i].d[a] * end[n + i].d[b] - end[n + i].d[a] * end[i].d[b];
      largest = std::fmax(largest, std::fabs(sum - (b == a + n ? 1.0 : a == b + n ? -1.0 : 0.0)));
    }
  return largest;
}

}  // namespace

BOOST_AUTO_TEST_CASE(symplectic_methods_and_no_others_preserve_the_form) {
  const std::vector<dual> parameters{0.7, 0.83, 0.96, 1.09, 9.81};
  for_each<ideal_systems>([&]<class Entry>() {
    const auto system = Entry::template make<dual>(0, parameters.data());
    for_each<fixed_methods>([&]<class Method>() {
      if constexpr (takes<Method, Entry>) {
        const double found = distortion<Method>(system, 0.1);
        if (Method::symplectic) {
          BOOST_TEST(found < 1e-12, Entry::name << " " << Method::name << " " << found);
        } else {
          BOOST_TEST(found > 1e-9, Entry::name << " " << Method::name << " " << found);
        }
      }
    });
  });
}
