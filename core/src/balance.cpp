#include "pendula/kernels/balance.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pendula/catalog.hpp"
#include "pendula/drive/fixed.hpp"
#include "pendula/kernels/catalog_rows.hpp"
#include "pendula/kernels/run_kernels.hpp"
#include "pendula/scalar/wide.hpp"

namespace pendula {

namespace {

constexpr std::size_t most_powers = 6;
using powers = std::array<double, most_powers>;
using sums = std::array<wide<double>, most_powers>;

// Gauss's formula with twelve nodes, exact for polynomials of degree 23 (Abramowitz & Stegun 1964, table 25.4): half of
// the nodes on [−1, 1], and their weights.
constexpr double gauss[6][2] = {{0.125233408511468915472441369463853, 0.249147045813402785000562436042951},
                                {0.367831498998180193752691536643718, 0.233492536538354808760849898924878},
                                {0.587317954286617447296702418940534, 0.203167426723065921749064455809798},
                                {0.769902674194304687036893833212818, 0.160078328543346226334652529543359},
                                {0.904117256370474856678465866119096, 0.106939325995318430960254718193996},
                                {0.981560634246719250690549090149281, 0.047175336386511827194615961485017}};

// A system of the catalogue, with its powers at a time and state.
struct powered {
  virtual ~powered() = default;
  virtual powers at(head_and_tail<double> t, const double* y) const = 0;
};
template <class Sys>
struct powered_system final : powered {
  explicit powered_system(const Sys& system) : system(system) {}
  powers at(head_and_tail<double> t, const double* y) const override {
    typename Sys::state state;
    std::copy_n(y, state.size(), state.begin());
    powers all{};
    std::ranges::copy(system.powers(t, state), all.begin());
    return all;
  }
  Sys system;
};

struct totals {
  explicit totals(const power_rows& rows) : rows(rows) {}

  void write(const sums& energies) {
    wide<double> net(0.0);
    for (std::size_t i = 0; i < rows.names.size(); ++i) {
      to.parts.push_back(rounded(energies[i]));
      net = i < rows.works ? net + energies[i] : net - energies[i];
    }
    to.net.push_back(net.hi);
    to.net_tails.push_back(net.lo);
  }

  power_rows rows;
  energy_balance to;
};

// Integrates inside the steps of an adaptive method.
struct integrator final : receiver {
  integrator(const request& asked, const powered& of, totals& to, const watcher& watch)
      : asked(asked), of(of), to(to), watch(watch) {
    if (asked.times[0] == asked.t0) write_next({});
  }

  bool output(std::size_t, double, const double*) override { return true; }
  void event(int, double, const double*) override {}
  bool step(const step_motion& motion) override {
    const double stop = motion.stop(), direction = asked.direction();
    for (; next < asked.times.size(); write_next(since(motion, tau_of(motion))))
      if (direction * tau_of(motion) > direction * stop) break;
    done = since(motion, stop);
    return true;
  }
  bool go_on(double t) override { return going_on = watch((t - asked.t0) / (asked.end() - asked.t0)); }

  double tau_of(const step_motion& motion) const {
    return (asked.times[next] - motion.start().head) - motion.start().tail;
  }
  void write_next(const sums& energies) {
    to.write(energies);
    ++next;
  }
  sums since(const step_motion& motion, double tau) const {
    sums all = done;
    const auto [head, tail] = motion.start();
    const double half = 0.5 * tau;
    powers weighted{};
    for (const auto& [node, weight] : gauss)
      for (const double place : {half - half * node, half + half * node}) {
        std::array<double, 4> y;
        motion.state(place, y.data());
        const powers now = of.at(later({head, tail}, place), y.data());
        for (std::size_t i = 0; i < now.size(); ++i) weighted[i] += weight * now[i];
      }
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = all[i] + wide<double>(half * weighted[i]);
    return all;
  }

  const request& asked;
  const powered& of;
  totals& to;
  const watcher& watch;
  std::size_t next = 0;
  sums done{};
  bool going_on = true;
};

// A system with its energies as further components, for methods that take any equations.
template <class Sys>
struct with_energies {
  using scalar = double;
  static constexpr std::size_t own = Sys::dimension, dimension = own + Sys::power_names.size();
  using state = vec<double, dimension>;

  state rhs(double t, const state& all) const {
    typename Sys::state y;
    std::copy_n(all.begin(), own, y.begin());
    state slopes;
    std::ranges::copy(system.powers({t, 0.0}, y), std::ranges::copy(system.rhs(t, y), slopes.begin()).out);
    return slopes;
  }

  Sys system;
};

template <class Method, class Sys>
void integrate_by_steps(const Sys& system, const request& asked, totals& to, const watcher& watch) {
  using Extended = with_energies<Sys>;
  typename Extended::state start{};
  std::copy_n(asked.state.begin(), Sys::dimension, start.begin());
  const fixed_plan plan = requested_times(asked.t0, asked.signed_step(), asked.times);
  const Extended extended{system};
  fixed_run<Method, Extended> drive(extended, start, asked.t0, asked.signed_step(), asked.step_limit());
  const auto sink = [&](std::size_t, const auto& y) {
    sums energies{};
    for (std::size_t i = Sys::dimension; i < y.size(); ++i) energies[i - Sys::dimension] = wide<double>(y[i]);
    to.write(energies);
  };
  const double steps_in_all = (asked.end() - asked.t0) / asked.signed_step();
  const auto go_on = [&](std::int64_t steps) { return watch(static_cast<double>(steps) / steps_in_all); };
  to.to.interrupted = drive.through(plan.outputs, sink, go_on)[0].ended == outcome::interrupted;
}

}  // namespace

power_rows powers_of(std::string_view name) {
  power_rows rows{};
  with<systems>(name, [&]<class Entry>() {
    using Sys = typename Entry::template over<double>;
    if constexpr (Dissipative<Sys>) rows = {{Sys::power_names.begin(), Sys::power_names.end()}, Sys::works};
  });
  return rows;
}

energy_balance balance_of(const request& asked, const watcher& watch) {
  totals to(powers_of(asked.system.name));
  with<systems>(asked.system.name, [&]<class Entry>() {
    using Sys = typename Entry::template over<double>;
    if constexpr (Dissipative<Sys>) {
      const Sys system = Entry::template make<double>(asked.system.form, asked.system.parameters.data());
      if (method_named(asked.method)->adaptive) {
        const powered_system<Sys> of(system);
        integrator integrating(asked, of, to, watch);
        if (asked.end() != asked.t0) kernel_for(asked).solve(asked, integrating);
        to.to.interrupted = !integrating.going_on;
        return;
      }
      with<fixed_methods>(asked.method, [&]<class Method>() {
        if constexpr (takes<Method, Entry>) integrate_by_steps<Method>(system, asked, to, watch);
      });
    }
  });
  return std::move(to.to);
}

}  // namespace pendula
