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
  fixed_run<Method, Sys>(system, start, 0.0, t / static_cast<double>(steps), steps)
      .through(last, [&](std::size_t, const auto& y) { end = y; }, [](auto) { return true; });
  return end;
}

template <class State>
double distance(const State& a, const State& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::fabs(a[i] - b[i]));
  return largest;
}

// Calls visit.operator()<Method>() for the methods that take the system.
template <class Sys, class Visitor>
void for_each_method(Visitor&& visit) {
  for_each<fixed_methods>([&]<class Method>() {
    if constexpr (Takes<Method, Sys>) visit.template operator()<Method>();
  });
}

// Steps in a unit of time whose errors are small enough for the order to show, and still far above rounding.
template <class Method, class Sys>
std::int64_t telling_steps(const Sys& system, const typename Sys::state& start, const typename Sys::state& truth) {
  const double small = Method::order == 1 ? 1e-4 : Method::order == 2 ? 1e-6 : 1e-11;
  std::int64_t steps = 8;
  while (!(distance(at<Method>(system, start, 1.0, 2 * steps), truth) < small)) steps *= 2;
  return steps;
}

struct energies {
  double drift, width;  // over the run, along the straight line that fits best, and of what goes up and down about it
};

template <class Method, class Sys>
energies energies_of(const Sys& system, const typename Sys::state& start, double h, std::int64_t steps) {
  std::vector<fixed_output> outputs;
  for (std::int64_t n = 0; n <= steps; n += 4) outputs.push_back({n, 0.0});
  std::vector<double> energy;
  fixed_run<Method, Sys>(system, start, 0.0, h, steps)
      .through(
          outputs,
          [&](std::size_t, const auto& y) { energy.push_back(system.kinetic_energy(y) + system.potential_energy(y)); },
          [](auto) { return true; });
  const double n = static_cast<double>(energy.size()), middle = 0.5 * (n - 1.0);
  double mean = 0.0, slope = 0.0;
  for (double e : energy) mean += e / n;
  for (std::size_t i = 0; i < energy.size(); ++i)
    slope += (static_cast<double>(i) - middle) * (energy[i] - mean) / (n * (n * n - 1.0) / 12.0);
  double low = 0.0, high = 0.0;
  for (std::size_t i = 0; i < energy.size(); ++i) {
    const double rest = energy[i] - mean - slope * (static_cast<double>(i) - middle);
    low = std::min(low, rest);
    high = std::max(high, rest);
  }
  return {std::fabs(slope * n), high - low};
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_method_converges_with_its_order) {
  for_each_system([]<class Sys>(const Sys& system, const typename Sys::state& start) {
    const auto truth = at<rk4>(system, start, 1.0, 1 << 14);
    for_each_method<Sys>([&]<class Method>() {
      const std::int64_t steps = telling_steps<Method>(system, start, truth);
      const double coarse = distance(at<Method>(system, start, 1.0, steps), truth);
      const double fine = distance(at<Method>(system, start, 1.0, 2 * steps), truth);
      BOOST_TEST(std::fabs(std::log2(coarse / fine) - Method::order) < (Method::order == 8 ? 0.25 : 0.1),
                 Method::name << " " << std::log2(coarse / fine) << " " << fine);
    });
  });
}

BOOST_AUTO_TEST_CASE(every_method_goes_back_where_it_came_from) {
  for_each_system([]<class Sys>(const Sys& system, const typename Sys::state& start) {
    for_each_method<Sys>([&]<class Method>() {
      const std::int64_t steps = 256;
      const auto there = at<Method>(system, start, 0.5, steps), back = at<Method>(system, there, -0.5, steps);
      // the symmetric ones are those of even order that are symplectic; of the rest their own error is left
      constexpr bool symmetric = Method::symplectic && Method::order % 2 == 0;
      const double own_error = symmetric ? 0.0 : 50.0 * std::pow(0.5 / steps, Method::order);
      BOOST_TEST(distance(back, start) < own_error + 2e-14, Method::name << " " << distance(back, start));
    });
  });
}

BOOST_AUTO_TEST_CASE(symplectic_methods_keep_the_energy_within_bounds) {
  for_each_system([]<class Sys>(const Sys& system, const typename Sys::state& start) {
    for_each_method<Sys>([&]<class Method>() {
      const auto [drift, width] = energies_of<Method>(system, start, 0.05, 1 << 15);
      if (Method::symplectic) {
        BOOST_TEST(drift < width + 1e-13, Method::name << " " << drift << " " << width);
      } else if (std::same_as<Method, rk4>) {
        BOOST_TEST(drift > width, Method::name << " " << drift << " " << width);
      }
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
    BOOST_TEST(distance(system.rhs(0.0, rest), rest) == 0.0);
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
