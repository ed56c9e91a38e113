#include "pendula/kernels/closed_forms.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "pendula/drive/polling.hpp"
#include "pendula/exact/driven_linear.hpp"
#include "pendula/exact/incomplete_F.hpp"
#include "pendula/exact/simple_times.hpp"
#include "pendula/kernels/elliptic_arrays.hpp"
#include "pendula/kernels/exact.hpp"
#include "pendula/system/driven_linear_pendulum.hpp"
#include "pendula/system/linear_pendulum.hpp"
#include "pendula/system/simple_pendulum.hpp"

namespace pendula {

namespace {

// work(i) for i from 0 to count by steps, with a look now and then at whether to go on.
template <class Work>
bool in_steps(std::size_t count, std::size_t step, const watcher& watch, Work&& work) {
  using clock = std::chrono::steady_clock;
  auto looked = clock::now();
  for (std::size_t i = 0; i < count; i += step) {
    work(i);
    if (clock::now() - looked < between_looks) continue;
    looked = clock::now();
    if (!watch(static_cast<double>(i) / static_cast<double>(count))) return false;
  }
  return true;
}

template <bool linear>
exact_outcome solve(const double* p, std::span<const double> states, std::span<const double> times, double t0,
                    double* out, const watcher& watch) {
  const exact_request asked{p[0], p[1], states.data(), states.size() / 2, times.data(), times.size(), t0};
  const auto go_on = [&] { return watch(0.0); };
  const exact_kernel& kernel = *all_exact().back();
  return linear ? exact_linear(kernel, asked, out, go_on) : exact_simple(kernel, asked, out, go_on);
}

// What the digits of the closed form with friction and drive reach for: no product of such numbers leaves the range.
bool is_of_usual_size(double x) { return x == 0.0 || (std::fabs(x) < 0x1p200 && std::fabs(x) > 0x1p-200); }

exact_outcome solve_driven_linear(const double* p, std::span<const double> states, std::span<const double> times,
                                  double t0, double* out, const watcher& watch) {
  const std::size_t parameters = driven_linear_pendulum::parameters.size();
  if (!std::all_of(p, p + parameters, is_of_usual_size) || !std::ranges::all_of(states, is_of_usual_size)) {
    std::fill_n(out, states.size() * times.size(), std::numeric_limits<double>::quiet_NaN());
    return exact_outcome::refused;
  }
  const driven_linear system({p[0], p[1], p[2], p[3], p[4], p[5], p[6]}, t0);
  const bool complete = driven_linear_points(system, states.data(), states.size() / 2, times.data(), times.size(), out,
                                             [&] { return watch(0.0); });
  if (!complete) return exact_outcome::stopped;
  const bool known = std::none_of(out, out + states.size() * times.size(), [](double x) { return std::isnan(x); });
  return known ? exact_outcome::complete : exact_outcome::refused;
}

// To the same bits as that of a simple pendulum whose swings are infinitely small.
double period_of_linear(const double* p, const double*) {
  return 2.0 * rounded(wide<double>(1.0) / simple_constants<double>(p[0], p[1]).frequency_over_pi);
}

double action_of_linear(const double* p, const double* y) {
  const auto system = linear_pendulum::make<double>(0, p);
  const vec<double, 2> state{y[0], y[1]};
  return (system.kinetic_energy(state) + system.potential_energy(state)) / std::sqrt(p[1] / p[0]);
}

#ifdef PENDULA_SMALL  // a fifteenth of all, with a hundred digits' elliptic integrals
constexpr double (*time_of_linear)(const double*, const double*, double) = nullptr;
constexpr double (*time_of_simple)(const double*, const double*, double) = nullptr;
#else
double time_of_linear(const double* p, const double* y, double theta) {
  return linear_time_at(p[0], p[1], y[0], y[1], theta);
}

double time_of_simple(const double* p, const double* y, double theta) {
  return simple_time_at(p[0], p[1], y[0], y[1], theta);
}
#endif

double period_of_simple(const double* p, const double* y) { return simple_period(p[0], p[1], y[0], y[1]); }

double action_of_simple(const double* p, const double* y) { return simple_action(p[0], p[1], p[2], y[0], y[1]); }

modulus<double> modulus_of(const moduli& given, std::size_t i) {
  return given.complement ? modulus<double>::from_kc(given.values[i]) : modulus<double>::from_k(given.values[i]);
}

// f(modulus, i) for each.
template <class Function>
bool over(const moduli& given, double* out, const watcher& watch, Function&& f) {
  return in_steps(given.values.size(), 1, watch, [&](std::size_t i) { out[i] = f(modulus_of(given, i), i); });
}

// Four numbers from place i on; where fewer are left, the last one again.
pack<double, 4> four_from(std::span<const double> from, std::size_t i) {
  pack<double, 4> x;
  for (std::size_t l = 0; l < 4; ++l) x.set(static_cast<int>(l), from[std::min(i + l, from.size() - 1)]);
  return x;
}

}  // namespace

std::span<const closed_form> closed_forms() {
  static constexpr closed_form all[] = {
      {linear_pendulum::name, solve<true>, derivatives_of_linear, period_of_linear, action_of_linear, time_of_linear},
      {simple_pendulum::name, solve<false>, derivatives_of_simple, period_of_simple, action_of_simple, time_of_simple},
      {driven_linear_pendulum::name, solve_driven_linear, derivatives_of_driven_linear, nullptr, nullptr, nullptr}};
  return all;
}

const closed_form* closed_form_of(std::string_view system) {
  const auto all = closed_forms();
  const auto found = std::ranges::find(all, system, &closed_form::system);
  return found == all.end() ? nullptr : &*found;
}

bool periods_of(const closed_form& of, const double* parameters, std::span<const double> states, double* out,
                const watcher& watch) {
  return in_steps(states.size() / 2, 1, watch,
                  [&](std::size_t i) { out[i] = of.period(parameters, states.data() + 2 * i); });
}

bool actions_of(const closed_form& of, const double* parameters, std::span<const double> states, double* out,
                const watcher& watch) {
  return in_steps(states.size() / 2, 1, watch,
                  [&](std::size_t i) { out[i] = of.action(parameters, states.data() + 2 * i); });
}

bool times_at(const closed_form& of, const double* parameters, std::span<const double> states,
              std::span<const double> theta, double* out, const watcher& watch) {
  return in_steps(states.size() / 2, 1, watch,
                  [&](std::size_t i) { out[i] = of.time_at(parameters, states.data() + 2 * i, theta[i]); });
}

bool complete_K_of(const moduli& given, double* out, const watcher& watch) {
  return over(given, out, watch, [](const auto& m, std::size_t) { return complete_K(m); });
}

bool complete_E_of(const moduli& given, double* out, const watcher& watch) {
  return over(given, out, watch, [](const auto& m, std::size_t) { return complete_E(m); });
}

bool incomplete_F_of(std::span<const double> phi, const moduli& given, double* out, const watcher& watch) {
  return over(given, out, watch, [&](const auto& m, std::size_t i) { return incomplete_F(phi[i], m); });
}

bool K_series_of(const moduli& given, long terms, double* out, const watcher& watch) {
  return over(given, out, watch,
              [terms](const auto& m, std::size_t) { return complete_elliptic_K_series(rounded(m.k), terms); });
}

bool jacobi_of(std::span<const double> u, const moduli& given, const jacobi_arrays& out, const watcher& watch) {
  using S = pack<double, 4>;
  const std::size_t count = u.size();
  return in_steps(count, 4, watch, [&](std::size_t i) {
    const S k = four_from(given.values, i), argument = four_from(u, i);
    const auto m = given.complement ? modulus<S>::from_kc(k) : modulus<S>::from_k(k);
    const auto [am, sn, cn, dn] = jacobi_functions<S>(m)(argument);
    for (std::size_t l = 0; l < std::min<std::size_t>(4, count - i); ++l) {
      const int lane = static_cast<int>(l);
      out.am[i + l] = am[lane];
      out.sn[i + l] = sn[lane];
      out.cn[i + l] = cn[lane];
      out.dn[i + l] = dn[lane];
    }
  });
}

}  // namespace pendula
