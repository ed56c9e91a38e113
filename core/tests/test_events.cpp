#include <boost/test/unit_test.hpp>
#include <vector>

#include "pendula/drive/adaptive.hpp"
#include "pendula/method/taylor.hpp"
#include "pendula/system/double_pendulum.hpp"
#include "pendula/system/linear_pendulum.hpp"
#include "pendula/system/simple_pendulum.hpp"

using namespace pendula;

namespace {

constexpr double pi = 3.141592653589793, rest_of_pi = 1.2246467991473532e-16;

struct told_event {
  int place;
  double time;
  vec<double, 2> state;
};

template <class Run>
struct listener {
  std::vector<told_event> events;
  bool step(const Run&, double) { return true; }
  void event(const Run& run, int place, double tau) {
    events.push_back({place, run.time_after(tau), run.stepper().state_of(run.stepper().after(tau))});
  }
};

template <class Entry>
std::vector<told_event> events_of(vec<double, 2> start, double end, const std::vector<event>& asked,
                                  std::string_view ended = "reached_end", double tolerance = -52.0) {
  using Sys = typename Entry::template over<double>;
  const double unit[] = {1.0, 1.0, 1.0};
  taylor_stepper<Sys> stepper(Entry::template make<double>(0, unit), tolerance);
  stepper.start(0.0, start);
  using run = adaptive_run<taylor_stepper<Sys>>;
  listener<run> listens;
  const auto result = run(stepper, 0.0, end, asked).to_end(1 << 20, listens, [](double, std::int64_t) { return true; });
  BOOST_TEST(name_of(result.ended) == ended);
  return listens.events;
}

event passes(double value, int direction = 0) { return {event_kind::angle, 0, value, 0.0, false, direction, 0}; }

}  // namespace

BOOST_AUTO_TEST_CASE(crossings_of_a_polynomial_are_all_found) {
  // (x − 0.3)(x − 0.3 − 1e-6)(x − 0.9), and a touch at 0.5 that is none
  polynomial p;
  p.degree = 3;
  const double a = 0.3, b = 0.3 + 1e-6, c = 0.9;
  p.coefficient[0] = -a * b * c;
  p.coefficient[1] = a * b + a * c + b * c;
  p.coefficient[2] = -(a + b + c);
  p.coefficient[3] = 1.0;
  std::vector<double> found;
  std::vector<bool> ways;
  each_crossing(p, 1.0, 0x1p-52, [&](double x, bool rising) {
    found.push_back(x);
    ways.push_back(rising);
  });
  BOOST_TEST_REQUIRE(found.size() == 3u);
  BOOST_TEST(std::fabs(found[0] - a) < 1e-9);
  BOOST_TEST(std::fabs(found[1] - b) < 1e-9);
  BOOST_TEST(std::fabs(found[2] - c) < 1e-14);
  BOOST_TEST((ways == std::vector<bool>{true, false, true}));
  polynomial touch;
  touch.degree = 2;
  touch.coefficient[0] = 0.25 + 1e-9;
  touch.coefficient[1] = -1.0;
  touch.coefficient[2] = 1.0;
  each_crossing(touch, 1.0, 0x1p-52, [](double, bool) { BOOST_TEST(false); });
}

// θ = cos t: events at known times.
BOOST_AUTO_TEST_CASE(times_are_right_to_the_last_digits) {
  const auto events = events_of<linear_pendulum>({1.0, 0.0}, 10.0, {passes(0.0), {event_kind::velocity_zero, 0}});
  BOOST_TEST_REQUIRE(events.size() == 6u);  // the start at rest is none
  for (std::size_t i = 0; i < events.size(); ++i) {
    const double time = (i + 1) * 0.5 * pi;
    BOOST_TEST(std::fabs(events[i].time / time - 1.0) < 4e-16);
    BOOST_TEST(events[i].place == static_cast<int>(i % 2));
    BOOST_TEST(std::fabs(events[i].state[i % 2]) < 1e-15);
  }
}

// The motion comes up to 1 and goes back: it passes 1 − 1e-12 twice within 3e-6, and 1 + 1e-12 never.
BOOST_AUTO_TEST_CASE(a_grazing_passage_is_two_crossings) {
  const double half_width = 1.4142136e-6;                                                  // cos x = 1 − x²/2
  const auto events = events_of<linear_pendulum>({0.0, 1.0}, 3.0, {passes(1.0 - 1e-12)});  // sin t
  BOOST_TEST_REQUIRE(events.size() == 2u);
  BOOST_TEST(std::fabs(events[0].time - (0.5 * pi - half_width)) < 1e-9);
  BOOST_TEST(std::fabs(events[1].time - (0.5 * pi + half_width)) < 1e-9);
  BOOST_TEST(events_of<linear_pendulum>({0.0, 1.0}, 3.0, {passes(1.0 + 1e-12)}).empty());
}

BOOST_AUTO_TEST_CASE(directions_are_those_of_time) {
  const auto up = events_of<linear_pendulum>({1.0, 0.0}, 10.0, {passes(0.5, 1)});
  const auto down = events_of<linear_pendulum>({1.0, 0.0}, 10.0, {passes(0.5, -1)});
  BOOST_TEST(up.size() == 1u);
  BOOST_TEST(down.size() == 2u);
  BOOST_TEST(std::fabs(down[0].time - pi / 3) < 1e-15);
  BOOST_TEST(std::fabs(up[0].time - 5 * pi / 3) < 1e-14);
  const auto before = events_of<linear_pendulum>({1.0, 0.0}, -2.0, {passes(0.5, 1)});  // backward in time
  BOOST_TEST_REQUIRE(before.size() == 1u);
  BOOST_TEST(std::fabs(before[0].time + pi / 3) < 1e-15);
}

// ω = 3 at the bottom of a simple pendulum with ωn = 1 goes over the top: k = 3/2, one turn in 2 K(1/k)/k.
BOOST_AUTO_TEST_CASE(a_rotation_flips_once_a_turn) {
  const event flip{event_kind::angle, 0, pi, rest_of_pi, true};
  const double turn = 2.0 / 1.5 * 1.8096674954865885;  // K(2/3), mpmath
  for (const double omega : {3.0, -3.0}) {
    const auto events = events_of<simple_pendulum>({0.0, omega}, 20.0, {flip});
    BOOST_TEST_REQUIRE(events.size() == 8u);
    for (std::size_t i = 0; i < events.size(); ++i) {
      BOOST_TEST(std::fabs(events[i].time / ((i + 0.5) * turn) - 1.0) < 2e-15);
      BOOST_TEST(std::fabs(std::fabs(events[i].state[0]) - (2.0 * i + 1.0) * pi) < 1e-13);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_height_of_the_tip_has_its_events) {
  // linear pendulum: θ = cos t, height −cos θ; −cos(0.5) at θ = ±0.5
  const auto events = events_of<linear_pendulum>({1.0, 0.0}, 4.0, {{event_kind::tip_height, 0, -0.8775825618903728}});
  BOOST_TEST_REQUIRE(events.size() == 2u);
  BOOST_TEST(std::fabs(events[0].time - pi / 3) < 1e-15);
  BOOST_TEST(std::fabs(events[1].time - 2 * pi / 3) < 1e-15);
}

BOOST_AUTO_TEST_CASE(the_last_event_asked_for_ends_the_run) {
  event third = passes(0.0);
  third.terminal = 3;
  const auto events = events_of<linear_pendulum>({1.0, 0.0}, 100.0, {{event_kind::velocity_zero, 0}, third}, "event");
  BOOST_TEST_REQUIRE(events.size() == 5u);
  BOOST_TEST(std::fabs(events.back().time - 2.5 * pi) < 1e-14);
}

// Steps and crossings meet in all ways: none is lost or told twice.
BOOST_AUTO_TEST_CASE(crossings_at_the_ends_of_steps_are_told_once) {
  for (int n = 0; n < 400; ++n) {
    const double tolerance = -10.0 - 0.1 * n;
    const auto events =
        events_of<simple_pendulum>({0.001 * n, 1.0}, 30.0, {passes(0.001 * n)}, "reached_end", tolerance);
    double last = 0.0;
    for (const auto& each : events) {
      BOOST_TEST(each.time > last + 1e-3);
      last = each.time;
    }
    BOOST_TEST((events.size() == 8u || events.size() == 9u || events.size() == 10u), n << " " << events.size());
  }
}

// A quantity that does not change has no crossings, whatever its value.
BOOST_AUTO_TEST_CASE(what_stands_still_crosses_nothing) {
  const event height{event_kind::tip_height, 0, -1.0};
  const auto events =
      events_of<simple_pendulum>({0.0, 0.0}, 10.0, {passes(0.0), {event_kind::velocity_zero, 0}, height});
  BOOST_TEST(events.empty());
}

// A tip that turns touches the greatest height once a turn: none or two crossings there, and never one elsewhere.
BOOST_AUTO_TEST_CASE(touches_are_told_where_they_are) {
  for (const double omega : {7.0, 10.0, 30.0, 100.0, 300.0})
    for (const double height : {-1.0, 1.0}) {
      const auto events = events_of<simple_pendulum>({0.3, omega}, 20.0, {{event_kind::tip_height, 0, height}});
      for (const auto& each : events) BOOST_TEST(std::fabs(-std::cos(each.state[0]) - height) < 1e-13);
    }
}

// With a loose tolerance the steps are long, and their polynomials not the motion's: their events are on the surface.
BOOST_AUTO_TEST_CASE(loose_steps_have_their_events_too) {
  for (const double tolerance : {-10.0, -20.0})
    for (const double omega : {3.0, 10.0}) {
      const auto events = events_of<simple_pendulum>(
          {0.2, omega}, 10.0, {{event_kind::tip_height, 0, 0.1}, passes(0.5)}, "reached_end", tolerance);
      BOOST_TEST(events.size() > 3u);
      for (const auto& each : events)
        if (each.place == 0) BOOST_TEST(std::fabs(-std::cos(each.state[0]) - 0.1) < 1e-13);
      const auto zeros =
          events_of<simple_pendulum>({0.2, 1.0}, 10.0, {{event_kind::velocity_zero, 0}}, "reached_end", tolerance);
      BOOST_TEST(zeros.size() == 3u);
      for (const auto& each : zeros) BOOST_TEST(std::fabs(each.state[1]) < 1e-14);
    }
}
