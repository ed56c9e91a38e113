// Time reaches the equations in every method: a driven pendulum, beside the same motion with its phase as a component.
#include "conformance_adaptive.hpp"
#include "driven_bob.hpp"

using namespace pendula;
using list = std::tuple<driven_bob>;
using driven = driven_bob::over<double>;

namespace {

const driven system_of_all = conformance::some_system<driven_bob, double>(0);
const driven::state start_of_all = conformance::some_state<driven>();

// The motion of (θ, ω, Ωt), which no time has to reach, by the classical Runge–Kutta method with more digits.
driven::state truth_after(double from, double span) {
  using number = long double;
  using state = std::array<number, 3>;
  const driven& of = system_of_all;
  const auto rhs = [&](const state& y) {
    return state{y[1], -(of.frequency_squared * std::sin(y[0])) + of.drive * std::cos(y[2]), of.frequency};
  };
  const auto moved = [](const state& y, number h, const state& k) {
    return state{y[0] + h * k[0], y[1] + h * k[1], y[2] + h * k[2]};
  };
  constexpr int steps = 1 << 13;
  const number h = number(span) / steps;
  state y{start_of_all[0], start_of_all[1], number(of.frequency) * from};
  for (int n = 0; n < steps; ++n) {
    const state k1 = rhs(y), k2 = rhs(moved(y, h / 2, k1)), k3 = rhs(moved(y, h / 2, k2)), k4 = rhs(moved(y, h, k3));
    y = moved(moved(moved(moved(y, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);
  }
  return {static_cast<double>(y[0]), static_cast<double>(y[1])};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(driven_bob_outside_the_catalogue)

BOOST_AUTO_TEST_CASE(every_method_goes_back_where_it_came_from) {
  conformance::every_method_goes_back_where_it_came_from<list>();
}
BOOST_AUTO_TEST_CASE(canonical_variables_are_those_of_the_motion) {
  conformance::canonical_variables_are_those_of_the_motion<list>();
}
BOOST_AUTO_TEST_CASE(adaptive_methods_follow_small_steps) { conformance::adaptive_methods_follow_small_steps<list>(); }
BOOST_AUTO_TEST_CASE(events_inside_steps_are_those_that_outputs_show) {
  conformance::events_inside_steps_are_those_that_outputs_show<list>();
}
BOOST_AUTO_TEST_CASE(lanes_carry_the_bits_of_runs_alone) { conformance::lanes_carry_the_bits_of_runs_alone<list>(); }

BOOST_AUTO_TEST_CASE(every_method_of_fixed_step_has_its_order) {
  const auto truth = truth_after(conformance::t0, 1.0);
  conformance::for_each_method<fixed_methods, driven>(
      [&]<class Method>() { conformance::check_order<Method>(system_of_all, start_of_all, truth); });
}

// Outputs off the grid are made by a step of another length from the last time on it.
BOOST_AUTO_TEST_CASE(a_shortened_step_begins_at_its_own_time) {
  const double h = 1.0 / 1024;
  const fixed_output off_grid[] = {{512, 0.5 * h}};
  const auto truth = truth_after(conformance::t0, 512.5 * h);
  fixed_run<gauss8, driven>(system_of_all, start_of_all, conformance::t0, h, 1 << 20)
      .through(
          off_grid, [&](std::size_t, const auto& y) { BOOST_TEST(conformance::distance(y, truth) < 2e-14); },
          [](auto) { return true; });
}

BOOST_AUTO_TEST_CASE(a_step_of_dop853_has_its_order) {
  using engine = dop853_step<driven>;
  const auto error = [&](int steps) {
    const double h = 1.0 / steps;
    auto y = engine::paired(start_of_all);
    for (int n = 0; n < steps; ++n) {
      const double t = conformance::t0 + n * h;
      typename engine::slopes k;
      k[0] = engine::paired(system_of_all.rhs(t, engine::unpaired(y)));
      const auto increment = engine::increment(system_of_all, t, y, k, h);
      y = engine::each([&]<std::size_t i> { return y[i] + increment[i]; });
    }
    return conformance::distance(engine::unpaired(y), truth_after(conformance::t0, 1.0));
  };
  const double order = std::log2(error(4) / error(8));
  BOOST_TEST(std::fabs(order - 8.0) < 0.5, order);
}

// Of one step, inside of it and at its end. The series of order 6 leaves an error of order 7, the dense output of
// DOP853 is of order 7, and its step of order 8.
template <class Method>
double order_of_a_step(double part) {
  const auto error = [&](double h) {
    typename Method::template stepper<driven> stepper(system_of_all, -10.0);
    stepper.start(conformance::t0, start_of_all);
    if constexpr (std::same_as<Method, dop853>) {
      auto from = stepper.remembered();
      from.step = h;
      stepper.resume(from);
    }
    stepper.expand({conformance::t0, 0.0}, 1.0);
    const auto y = stepper.state_of(stepper.after(part * h));
    return conformance::distance(y, truth_after(conformance::t0, part * h));
  };
  return std::log2(error(0.16) / error(0.08));
}
BOOST_AUTO_TEST_CASE(inside_a_step_the_motion_has_its_order) {
  const double of_series = order_of_a_step<taylor>(1.0), inside = order_of_a_step<dop853>(0.37),
               at_end = order_of_a_step<dop853>(1.0);
  BOOST_TEST(std::fabs(of_series - 7.0) < 0.3, of_series);
  BOOST_TEST(std::fabs(inside - 8.0) < 0.5, inside);
  BOOST_TEST(std::fabs(at_end - 9.0) < 0.6, at_end);
}

BOOST_AUTO_TEST_CASE(adaptive_methods_follow_the_phase) {
  for (const double span : {2.0, -2.0}) {
    const auto times = conformance::times_over(span, 7);
    conformance::for_each_method<adaptive_methods, driven>([&]<class Method>() {
      const auto found = conformance::told<Method>(system_of_all, start_of_all, times).outputs;
      for (std::size_t i = 0; i < times.size(); ++i) {
        const double apart = conformance::distance(found[i], truth_after(conformance::t0, times[i] - conformance::t0));
        BOOST_TEST(apart < 1e-13, times[i] << " " << apart);
      }
    });
  }
}

// From t0 = 0 the drive has another phase, so that no method may end where it does from t0 = 3; a whole period of the
// drive later, each ends where it did.
BOOST_AUTO_TEST_CASE(it_matters_when_a_run_starts) {
  const double period = 2.0 * 3.141592653589793 / system_of_all.frequency;
  const double apart = conformance::distance(truth_after(3.0, 1.0), truth_after(0.0, 1.0));
  BOOST_TEST(apart > 0.1);
  conformance::for_each_method<fixed_methods, driven>([&]<class Method>() {
    const auto end = [](double from) {
      return conformance::after<Method>(system_of_all, start_of_all, from, 1.0, 512);
    };
    BOOST_TEST(conformance::distance(end(3.0), end(0.0)) > 0.9 * apart);
    BOOST_TEST(conformance::distance(end(3.0), end(3.0 + period)) < 1e-13);
  });
}

BOOST_AUTO_TEST_SUITE_END()
