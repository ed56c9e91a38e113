// Friction that changes from piece to piece of a motion, and numbers that carry derivatives across.
#include <random>

#include "conformance.hpp"
#include "pendula/drive/adaptive.hpp"
#include "pendula/scalar/dual.hpp"

using namespace pendula;

namespace {

template <class Run>
struct pieces_of {
  using S = typename Run::S;

  std::vector<double> times{};
  std::vector<std::vector<double>> senses{};
  typename Run::state last{};
  std::int64_t steps = 0;
  outcome ended{};

  bool step(const Run& run, const S& stop) {
    last = run.stepper().state_of(run.stepper().after(stop));
    return true;
  }
  void event(const Run&, int, const S&) {}
  void piece(const Run& run)
    requires requires { run.stepper().joints().senses; }
  {
    times.push_back(rough(run.time().head[0]));
    for (auto& now = senses.emplace_back(); const S& sense : run.stepper().joints().senses) now.push_back(rough(sense));
  }
};

template <class Method, class Sys>
auto run_of(const Sys& system, const typename Sys::state& start, double end) {
  using Stepper = typename Method::template stepper<Sys>;
  using Run = adaptive_run<Stepper>;
  Stepper stepper(system, -52.0);
  stepper.start(typename Sys::scalar(0.0), start);
  pieces_of<Run> found;
  const auto result = Run(stepper, 0.0, end).to_end(1 << 20, found, [](double, auto) { return true; });
  found.steps = result.steps;
  found.ended = result.ended;
  return found;
}

using damped = damped_double_pendulum::over<double>;

struct release {
  damped system;
  damped::state start;
};

release any_release(std::mt19937& numbers) {
  const auto uniform = [&] { return static_cast<double>(numbers()) * 0x1p-32; };
  const double viscous = uniform() < 0.3 ? 0.0 : 0.1 * uniform();
  const double p[] = {1.0, 1.0, 1.0, 1.0, 9.80665, viscous, viscous, uniform(), uniform()};
  const auto speed = [&] { return uniform() < 0.5 ? 0.0 : 4.0 * (uniform() - 0.5); };
  return {damped_double_pendulum::make<double>(0, p),
          {6.0 * (uniform() - 0.5), 6.0 * (uniform() - 0.5), speed(), speed()}};
}

}  // namespace

BOOST_AUTO_TEST_CASE(two_methods_find_the_same_pieces_of_joints_that_stick) {
  std::mt19937 numbers(7);
  std::size_t pieces = 0;
  for (int i = 0; i < 40; ++i) {
    const auto [system, start] = any_release(numbers);
    const auto series = run_of<taylor>(system, start, 20.0);
    const auto steps = run_of<dop853>(system, start, 20.0);
    BOOST_TEST_CONTEXT("release " << i) {
      BOOST_TEST((series.ended == outcome::reached_end && steps.ended == outcome::reached_end));
      BOOST_TEST(series.senses == steps.senses);
      BOOST_TEST(conformance::distance(series.last, steps.last) < 1e-8);
      pieces += series.times.size();
    }
  }
  BOOST_TEST(pieces > 1000u);
}

// All torques in a stuck joint are within what holds it, all slipping joints move along their sense.
BOOST_AUTO_TEST_CASE(no_piece_breaks_the_rule_of_dry_friction) {
  std::mt19937 numbers(3);
  for (int i = 0; i < 20; ++i) {
    auto [system, start] = any_release(numbers);
    taylor_stepper<damped> stepper(system, -52.0);
    stepper.start(0.0, start);
    using run = adaptive_run<taylor_stepper<damped>>;
    struct checker {
      void event(const run&, int, double) {}
      bool step(const run& at, double stop) {
        for (int k = 1; k < 8; ++k) {
          const auto y = at.stepper().state_of(at.stepper().after(stop * k / 8));
          const auto& of = at.stepper().of();
          const auto torques = of.joints_at({0.0, 0.0}, y).torques;
          for (int j = 0; j < 2; ++j) {
            const double velocity = detail::joint_velocity(y, j), sense = of.senses[j];
            const bool right =
                sense == 0.0 ? std::fabs(torques[j]) <= of.coulomb[j] * (1.0 + 1e-12) && std::fabs(velocity) < 1e-12
                             : velocity * sense > -1e-12;
            BOOST_TEST(right, "joint " << j << " " << sense << " " << velocity << " " << torques[j]);
          }
        }
        return true;
      }
    };
    run(stepper, 0.0, 20.0).to_end(1 << 20, checker{}, [](double, auto) { return true; });
  }
}

BOOST_AUTO_TEST_CASE(what_rests_for_good_takes_one_step) {
  const double p[] = {1.0, 9.81, 1.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  const auto held = run_of<taylor>(driven_pendulum::make<double>(0, p), {0.2, 0.0}, 1e6);
  BOOST_TEST(held.steps == 1);
  BOOST_TEST(held.last[0] == 0.2);
  BOOST_TEST(held.senses.size() == 1u);
}

BOOST_AUTO_TEST_CASE(values_with_derivatives_have_the_bits_of_plain_ones) {
  for_each<systems>([]<class Entry>() {
    using number = dual<4>;
    std::vector<double> p;
    for (const parameter& row : Entry::forms[0].parameters)
      p.push_back(conformance::some_parameter(row, p.size()) + 0.01);
    std::vector<number> followed(p.begin(), p.end());
    followed[1].change.set(2, 1.0);
    const auto start = conformance::some_state<typename Entry::template over<double>>();
    typename Entry::template over<number>::state from;
    std::ranges::copy(start, from.begin());
    from[0].change.set(0, 1.0);
    const auto plain = run_of<taylor>(Entry::template make<double>(0, p.data()), start, 5.0);
    const auto with = run_of<taylor>(Entry::template make<number>(0, followed.data()), from, 5.0);
    BOOST_TEST_CONTEXT(Entry::name) {
      BOOST_TEST(plain.steps == with.steps);
      for (std::size_t i = 0; i < start.size(); ++i) BOOST_TEST(plain.last[i] == with.last[i].value);
      BOOST_TEST(with.last[0].change[0] != 0.0);
    }
  });
}
