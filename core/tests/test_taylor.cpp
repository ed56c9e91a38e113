#include <boost/test/unit_test.hpp>
#include <vector>

#include "pendula/drive/adaptive.hpp"
#include "pendula/drive/lanes.hpp"
#include "pendula/method/taylor.hpp"
#include "pendula/scalar/wide_sincos.hpp"
#include "pendula/system/double_pendulum.hpp"
#include "pendula/system/linear_pendulum.hpp"
#include "pendula/system/simple_pendulum.hpp"

using namespace pendula;

namespace {

const double equal_rods[] = {1.0, 1.0, 1.0, 1.0, 9.81};
const auto always = [](double, std::int64_t) { return true; };

template <class Run>
struct at_times {
  std::vector<double> times;
  std::vector<typename Run::state> states{};

  bool step(const Run& run, const typename Run::S& stop) {
    for (; states.size() < times.size(); states.push_back(state_at(run, times[states.size()]))) {
      const auto tau = run.since_step(times[states.size()]);
      if (rough(tau) * run.direction() > rough(stop) * run.direction()) break;
    }
    return true;
  }
  void event(const Run&, int, typename Run::S) {}

  static typename Run::state state_at(const Run& run, double t) {
    return run.stepper().state_of(run.stepper().after(run.since_step(t)));
  }
};

template <class Entry, class S>
auto states_at(const double* parameters, const std::vector<double>& start, double t0, const std::vector<double>& times,
               double log2_of_tolerance) {
  using Sys = typename Entry::template over<S>;
  std::vector<S> p(Entry::forms[0].parameters.size(), S(0.0));
  for (std::size_t i = 0; i < p.size(); ++i) p[i] = S(parameters[i]);
  taylor_stepper<Sys> stepper(Entry::template make<S>(0, p.data()), log2_of_tolerance);
  typename Sys::state y;
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = S(start[i]);
  stepper.start(0.0, y);
  using run = adaptive_run<taylor_stepper<Sys>>;
  at_times<run> told{times};
  const auto result = run(stepper, t0, times.back()).to_end(1 << 20, told, always);
  BOOST_TEST(name_of(result.ended) == "reached_end");
  return told.states;
}

}  // namespace

// FLINT with 60 digits, rounded to 30 (tests/reference/double.json has more).
BOOST_AUTO_TEST_CASE(rods_reach_the_check_values) {
  const double truth[][4] = {{-1.01478186187538306, -1.12244606910181525, -7.26181086506237487, 5.72845783468323474},
                             {0.205462239524980870, -7.52104212191582645, 1.68158668590311311, 11.7276651341110641},
                             {-0.997012773703082562, 4.16303573609155265, 1.74876611705965533, -10.1872062958343787}};
  const double allowed[] = {1e-14, 1e-12, 5e-8};  // chaos: ten thousandfold from 5 s to 10 s
  const auto found = states_at<double_pendulum, double>(equal_rods, {2.0, 2.5, 0.0, 0.0}, 0.0, {1.0, 5.0, 10.0}, -52.0);
  const auto wider =
      states_at<double_pendulum, wide<double>>(equal_rods, {2.0, 2.5, 0.0, 0.0}, 0.0, {1.0, 5.0, 10.0}, -104.0);
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 4; ++c) {
      BOOST_TEST(std::fabs(found[i][c] - truth[i][c]) < allowed[i]);
      BOOST_TEST(std::fabs(rounded(wider[i][c]) - truth[i][c]) < 4e-15);
    }
}

BOOST_AUTO_TEST_CASE(a_looser_tolerance_gives_a_larger_error_and_takes_fewer_terms) {
  const auto best = states_at<double_pendulum, wide<double>>(equal_rods, {0.5, 1.0, 0.0, 0.0}, 0.0, {2.0}, -104.0);
  double before = 0.0;
  for (const double digits : {13.0, 10.0, 7.0, 4.0}) {
    const auto y = states_at<double_pendulum, double>(equal_rods, {0.5, 1.0, 0.0, 0.0}, 0.0, {2.0}, -3.32193 * digits);
    const double error = std::fabs(y[0][0] - rounded(best[0][0]));
    BOOST_TEST(error < std::pow(10.0, 1.5 - digits));
    BOOST_TEST(error > before);
    before = error;
  }
  BOOST_TEST(taylor_order(-52.0) == 20);
  BOOST_TEST(taylor_order(-104.0) == 38);
  BOOST_TEST(taylor_order(-10.0) == 6);
}

BOOST_AUTO_TEST_CASE(lengths_of_steps_have_the_digits_they_need) {
  double of_log = 0.0, of_power = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const double x = -20.0 + 0.01 * i;
    of_log = std::max(of_log, std::fabs(coarse_log2(-std::exp2(x)) - x));
    of_power = std::max(of_power, std::fabs(coarse_exp2(x) / std::exp2(x) - 1.0));
  }
  BOOST_TEST(of_log < 0.0435);  // half of 0.0861, by which a chord is below the logarithm
  BOOST_TEST(of_log > 0.0425);
  BOOST_TEST(of_power < 1.1e-4);
  BOOST_TEST(coarse_log2(0.0) < -1000.0);
  BOOST_TEST(coarse_log2(pack<double, 2>(3.0))[1] == coarse_log2(3.0));
}

BOOST_AUTO_TEST_CASE(a_motion_goes_back_where_it_came_from) {
  const auto there = states_at<double_pendulum, double>(equal_rods, {1.0, -0.5, 0.3, 2.0}, 1.0, {4.0}, -52.0)[0];
  const auto back = states_at<double_pendulum, double>(equal_rods, {there.begin(), there.end()}, 4.0, {1.0}, -52.0)[0];
  const double start[] = {1.0, -0.5, 0.3, 2.0};
  for (int c = 0; c < 4; ++c) BOOST_TEST(std::fabs(back[c] - start[c]) < 1e-12);
}

// cos and sin of a harmonic oscillator with ω = 2, and a swing so small that only its parts tell.
BOOST_AUTO_TEST_CASE(small_swings_keep_their_digits) {
  const double unit[] = {1.0, 4.0, 1.0};
  for (const double size : {1.0, 1e-8, 1e-200}) {
    const auto linear = states_at<linear_pendulum, double>(unit, {size, 0.0}, 0.0, {3.0}, -52.0)[0];
    BOOST_TEST(std::fabs(linear[0] / size - 0.96017028665036602) < 1e-15);  // cos 6
    BOOST_TEST(std::fabs(linear[1] / size - 0.55883099639785172) < 1e-15);  // −2 sin 6
    if (size == 1.0) continue;
    const auto simple = states_at<simple_pendulum, double>(unit, {size, 0.0}, 0.0, {3.0}, -52.0)[0];
    BOOST_TEST(std::fabs(simple[0] / size - 0.96017028665036602) < 1e-15);
  }
}

// From rest at a right angle symmetry leaves every fourth order only; the step must not take the rest for convergence.
BOOST_AUTO_TEST_CASE(orders_that_vanish_do_not_lengthen_the_step) {
  const double half_pi = 1.5707963267948966, unit[] = {1.0, 9.81, 1.0};
  const auto drift = []<class Sys>(const Sys& system, const typename Sys::state& start, const auto& end) {
    const auto energy = [&](const auto& y) { return system.kinetic_energy(y) + system.potential_energy(y); };
    return std::fabs(energy(end) - energy(start)) / energy(start);
  };
  const auto simple = simple_pendulum::make<double>(0, unit);
  for (const double tolerance : {-52.0, -40.0}) {
    const double allowed = std::ldexp(8.0, static_cast<int>(tolerance));
    const auto y = states_at<simple_pendulum, double>(unit, {half_pi, 0.0}, 0.0, {10.0}, tolerance)[0];
    BOOST_TEST(drift(simple, {half_pi, 0.0}, y) < allowed);
  }
  for (const std::size_t form : {0, 1})
    for (const double second : {half_pi, -half_pi, 3.141592653589793, 0.0}) {
      using Sys = double_pendulum::over<double>;
      const Sys system = double_pendulum::make<double>(form, equal_rods);
      taylor_stepper<Sys> stepper(system, -52.0);
      stepper.start(0.0, {half_pi, second, 0.0, 0.0});
      using run = adaptive_run<taylor_stepper<Sys>>;
      at_times<run> told{{0.2, 0.4, 3.0}};
      run(stepper, 0.0, 3.0).to_end(1 << 20, told, always);
      for (const auto& y : told.states) BOOST_TEST(drift(system, {half_pi, second, 0.0, 0.0}, y) < 4e-15);
    }
}

BOOST_AUTO_TEST_CASE(rest_stays_rest) {
  const auto down = states_at<double_pendulum, double>(equal_rods, {0.0, 0.0, 0.0, 0.0}, 0.0, {1000.0}, -52.0)[0];
  for (double c : down) BOOST_TEST(c == 0.0);
}

BOOST_AUTO_TEST_CASE(energy_stays_over_ten_thousand_units_of_time) {
  using Sys = double_pendulum::over<double>;
  const Sys system = double_pendulum::make<double>(0, equal_rods);
  const auto y = states_at<double_pendulum, double>(equal_rods, {2.0, 2.5, 0.0, 0.0}, 0.0, {3190.0}, -52.0)[0];
  const Sys::state start{2.0, 2.5, 0.0, 0.0};
  const auto energy = [&](const Sys::state& at) { return system.kinetic_energy(at) + system.potential_energy(at); };
  BOOST_TEST(std::fabs(energy(y) / energy(start) - 1.0) < 1e-12);
}

BOOST_AUTO_TEST_CASE(a_run_that_is_taken_up_repeats_its_bits) {
  using Sys = double_pendulum::over<double>;
  using run = adaptive_run<taylor_stepper<Sys>>;
  taylor_stepper<Sys> stepper(double_pendulum::make<double>(0, equal_rods), -52.0);
  stepper.start(0.0, {2.0, 2.5, 0.0, 0.0});
  struct keeper {
    run::point_in_time time{};
    taylor_stepper<Sys>::memory memory{};
    Sys::state end{};
    int steps = 0;
    bool step(const run& r, double stop) {
      if (++steps == 40) time = r.time(), memory = r.stepper().remembered();
      end = r.stepper().state_of(r.stepper().after(stop));
      return true;
    }
    void event(const run&, int, double) {}
  } whole, part;
  run(stepper, 0.0, 2.0).to_end(1 << 20, whole, always);
  stepper.resume(whole.memory);
  run(stepper, whole.time, 2.0, 1.0).to_end(1 << 20, part, always);
  BOOST_TEST(whole.steps > 60);
  BOOST_TEST(part.steps == whole.steps - 39);
  BOOST_TEST((part.end == whole.end));
}

BOOST_AUTO_TEST_CASE(angles_beyond_the_sine_end_a_run) {
  using Sys = simple_pendulum::over<double>;
  const double unit[] = {1.0, 9.81, 1.0};
  taylor_stepper<Sys> stepper(simple_pendulum::make<double>(0, unit), -52.0);
  stepper.start(0.0, {0x1p26 - 1.0, 1000.0});
  using run = adaptive_run<taylor_stepper<Sys>>;
  at_times<run> told{{0.0005, 1.0}};
  const auto result = run(stepper, 0.0, 1.0).to_end(1 << 20, told, always);
  BOOST_TEST(name_of(result.ended) == "not_finite");
  BOOST_TEST(told.states.size() == 1u);
}

BOOST_AUTO_TEST_CASE(every_lane_has_the_bits_of_a_run_of_its_own) {
  using S = pack<double, 4>;
  using One = taylor_stepper<double_pendulum::over<double>>;
  using Lanes = taylor_stepper<double_pendulum::over<S>>;
  const std::vector<S> p(std::begin(equal_rods), std::end(equal_rods));
  One one(double_pendulum::make<double>(0, equal_rods), -40.0);
  Lanes lanes(double_pendulum::make<S>(0, p.data()), -40.0);
  constexpr std::size_t count = 11;
  const auto start_of = [](std::size_t n) { return vec<double, 4>{0.3 * static_cast<double>(n), 1.0, 0.1, -2.0}; };
  struct feed {
    decltype(start_of)& start;
    std::size_t taken = 0;
    std::int64_t steps = 0;
    std::vector<std::vector<vec<double, 4>>> states{count};

    std::size_t next(One& stepper) {
      if (taken == count) return no_trajectory;
      stepper.start(0.0, start(taken));
      return taken++;
    }
    void output(std::size_t n, std::size_t place, const vec<double, 4>& y) {
      BOOST_TEST(place == states[n].size());
      states[n].push_back(y);
    }
    void event(std::size_t, int, double, const vec<double, 4>&) {}
    void finish(const lane_end& end) {
      BOOST_TEST(name_of(end.ended) == "reached_end");
      BOOST_TEST(end.reached == 3.0);
      steps += end.steps;
    }
    bool go_on() { return true; }
  };
  const std::vector<double> times{0.001, 0.002, 1.0, 2.5, 3.0};  // several in a step, none in another
  const lanes_task task{0.0, 3.0, 1 << 20, times, {}};
  feed trajectories{start_of};
  lanes_run<Lanes, One, feed>(lanes, one, task, trajectories).all();
  for (std::size_t n = 0; n < count; ++n) {
    one.start(0.0, start_of(n));
    using run = adaptive_run<One>;
    at_times<run> told{times};
    trajectories.steps -= run(one, 0.0, 3.0).to_end(1 << 20, told, always).steps;
    BOOST_TEST((told.states == trajectories.states[n]), n);
  }
  BOOST_TEST(trajectories.steps == 0);
}
