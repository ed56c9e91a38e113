// Symplectic methods keep the energy of a conservative system within bounds, and these bounds tell them from others.
#include "conformance.hpp"
#include "damped_bob.hpp"

using namespace conformance;

namespace {

// Over a run, in parts of the energy at its start: the change along the straight line that fits best, and all that goes
// up and down about it.
struct energies {
  double drift, width;
};

energies fitted(const std::vector<double>& energy) {
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
  return {std::fabs(slope * n) / energy[0], (high - low) / energy[0]};
}

constexpr double step = 0.0125;
constexpr std::int64_t steps = 1 << 15;

template <class Method, class Sys>
energies energies_of(const Sys& system, const typename Sys::state& start) {
  std::vector<fixed_output> outputs;
  for (std::int64_t n = 0; n <= steps; n += 4) outputs.push_back({n, 0.0});
  std::vector<double> energy;
  fixed_run<Method, Sys>(system, start, t0, step, steps)
      .through(
          outputs, [&](std::size_t, const auto& y) { energy.push_back(energy_of(system, y)); },
          [](auto) { return true; });
  return fitted(energy);
}

// The largest width that was measured over the catalogue, in powers of the phase that the fastest small swing turns in
// a step; it falls with the order, as the constants of the error do.
constexpr double measured_width(int order) {
  return order == 1 ? 1.0 : order == 2 ? 0.253 : order == 4 ? 0.08 : order == 6 ? 0.0041 : 8e-5;
}
constexpr double rounding_of_width = 2e-13, rounding_of_drift = 2e-15;  // over all the steps

template <class Sys>
bool is_narrow(const energies& found, const Sys& system, int order) {
  const double phase = step * std::sqrt(system.largest_frequency_squared());
  return found.width < measured_width(order) * std::pow(phase, order) + rounding_of_width;
}
// What a line fitted to bounded oscillations may slope by, as they do not end where they began.
bool stays(const energies& found) { return found.drift < 2e-3 * found.width + rounding_of_drift; }

}  // namespace

BOOST_AUTO_TEST_CASE(symplectic_methods_keep_the_energy_within_bounds) {
  for_each_system<ideal_systems>([]<class Entry, class Sys>(const Sys& system, const auto& start) {
    for_each_method<fixed_methods, Sys>([&]<class Method>() {
      if constexpr (Method::symplectic) {
        const energies found = energies_of<Method>(system, start);
        BOOST_TEST(is_narrow(found, system, Method::order), found.width);
        BOOST_TEST(stays(found), found.drift << " " << found.width);
      }
    });
  });
}

BOOST_AUTO_TEST_CASE(rk4_does_not_keep_the_energy_within_bounds) {
  for_each_system<ideal_systems>([]<class Entry, class Sys>(const Sys& system, const auto& start) {
    const energies found = energies_of<rk4>(system, start);
    BOOST_TEST(!stays(found));
    BOOST_TEST(found.drift > 10.0 * found.width, found.drift << " " << found.width);
  });
}

BOOST_AUTO_TEST_CASE(no_method_keeps_the_energy_of_a_damped_system_within_bounds) {
  for_each_system<std::tuple<damped_bob>>([]<class Entry, class Sys>(const Sys& system, const auto& start) {
    for_each_method<fixed_methods, Sys>([&]<class Method>() {
      const energies found = energies_of<Method>(system, start);
      BOOST_TEST(!is_narrow(found, system, Method::order));
      BOOST_TEST(found.width > 0.9);
    });
  });
}
