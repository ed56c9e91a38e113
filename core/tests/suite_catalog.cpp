// What every system and every method of the catalogue has to pass.
#include <boost/test/unit_test.hpp>
#include <vector>

#include "pendula/catalog.hpp"
#include "pendula/drive/fixed.hpp"

using namespace pendula;

namespace {

// Parameters all different, so that none can stand in for another.
template <class Sys>
std::vector<double> some_parameters(const form& f) {
  std::vector<double> p;
  for (std::size_t i = 0; i < f.parameters.size(); ++i)
    p.push_back(f.parameters[i].name == "gravity" ? 9.81 : 0.7 + 0.13 * i);
  return p;
}

template <class Visitor>
void for_each_system(Visitor&& visit) {
  for_each<systems>([&]<class Sys>() {
    for (std::size_t f = 0; f < Sys::forms.size(); ++f) {
      const auto system = Sys::template make<double>(f, some_parameters<Sys>(Sys::forms[f]).data());
      typename Sys::template over<double>::state start{};
      for (std::size_t i = 0; i < start.size(); ++i) start[i] = 0.9 - 0.5 * static_cast<double>(i);
      BOOST_TEST_CONTEXT(Sys::name << " " << Sys::forms[f].name) { visit(system, start); }
    }
  });
}

template <class Method, class Sys>
typename Sys::state at(const Sys& system, const typename Sys::state& start, double t, std::int64_t steps) {
  typename Sys::state end{};
  const fixed_output last[] = {{steps, 0.0}};
  fixed_run<Method, Sys>(system, start, t / static_cast<double>(steps), steps)
      .through(last, [&](std::size_t, const auto& y) { end = y; }, [](auto) { return true; });
  return end;
}

template <class State>
double distance(const State& a, const State& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::fabs(a[i] - b[i]));
  return largest;
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_method_converges_with_its_order) {
  for_each_system([]<class Sys>(const Sys& system, const typename Sys::state& start) {
    const auto truth = at<rk4>(system, start, 1.0, 1 << 14);
    for_each<methods>([&]<class Method>() {
      const std::int64_t steps = Method::order == 1 ? 1 << 13 : Method::order == 2 ? 1 << 10 : 1 << 8;
      const double coarse = distance(at<Method>(system, start, 1.0, steps), truth);
      const double fine = distance(at<Method>(system, start, 1.0, 2 * steps), truth);
      BOOST_TEST(std::fabs(std::log2(coarse / fine) - Method::order) < 0.1,
                 Method::name << " " << std::log2(coarse / fine));
    });
  });
}

BOOST_AUTO_TEST_CASE(every_method_goes_back_where_it_came_from) {
  for_each_system([]<class Sys>(const Sys& system, const typename Sys::state& start) {
    for_each<methods>([&]<class Method>() {
      const auto there = at<Method>(system, start, 0.5, 4096), back = at<Method>(system, there, -0.5, 4096);
      // no method here is symmetric: what is left is its own error, h^order
      BOOST_TEST(distance(back, start) < 50.0 * std::pow(0.5 / 4096, Method::order) + 1e-12, Method::name);
    });
  });
}

BOOST_AUTO_TEST_CASE(every_system_conserves_its_energy_along_its_flow) {
  for_each_system([]<class Sys>(const Sys& system, const typename Sys::state& start) {
    const auto energy = [&](const auto& y) { return system.kinetic_energy(y) + system.potential_energy(y); };
    const double before = energy(start), after = energy(at<rk4>(system, start, 2.0, 1 << 15));
    BOOST_TEST(std::fabs(after - before) < 1e-12 * std::fabs(before));
    BOOST_TEST(before > 0.0);
  });
}

BOOST_AUTO_TEST_CASE(every_system_rests_at_the_lowest_point) {
  for_each_system([]<class Sys>(const Sys& system, const typename Sys::state&) {
    const typename Sys::state rest{};
    BOOST_TEST(distance(system.rhs(rest), rest) == 0.0);
    BOOST_TEST(system.kinetic_energy(rest) + system.potential_energy(rest) == 0.0);
  });
}

// The ends are where the angles say: each as far from the one before as the rod is long, whatever the angles.
BOOST_AUTO_TEST_CASE(every_system_keeps_its_lengths) {
  for_each_system([]<class Sys>(const Sys& system, const typename Sys::state& start) {
    const auto lengths = [&](const auto& y) {
      std::vector<double> found;
      vec<double, 2> previous{0.0, 0.0};
      for (const auto& end : system.positions(y)) {
        found.push_back(std::hypot(end[0] - previous[0], end[1] - previous[1]));
        previous = end;
      }
      return found;
    };
    const auto before = lengths(start), after = lengths(at<rk4>(system, start, 1.0, 1 << 12));
    for (std::size_t i = 0; i < before.size(); ++i) BOOST_TEST(std::fabs(after[i] - before[i]) < 1e-14);
  });
}
