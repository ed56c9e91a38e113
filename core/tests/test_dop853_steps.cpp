#include <boost/test/unit_test.hpp>
#include <cstring>

#include "random.hpp"
#include "run_dop853.hpp"

using namespace pendula;

BOOST_AUTO_TEST_CASE(the_polynomials_of_a_step_are_its_dense_output) {
  const auto system = double_pendulum::make<double>(0, of_rods);
  dop853_stepper<rods> stepper(system, -40.0);
  stepper.start(0.0, {2.0, 2.5, 0.0, 0.0});
  for (int n = 0; n < 20; ++n) {
    stepper.expand({0.0, 0.0}, 1.0);
    const auto next = stepper.after(stepper.length());
    for (const double x : {0.0, 0.2, 0.7, 0.999999, 1.0}) {
      const auto y = stepper.state_of(stepper.after(x * stepper.length()));
      for (int i = 0; i < 2; ++i) {
        BOOST_TEST(std::fabs(stepper.angle_polynomial(i)(x) - y[i]) < 1e-14);
        BOOST_TEST(std::fabs(stepper.velocity_polynomial(i)(x) - y[i + 2]) < 5e-14);
      }
    }
    BOOST_TEST((stepper.angle_polynomial(1).coefficient[0] == stepper.remembered().at.head[1]));
    BOOST_TEST((stepper.after(stepper.length()).head == next.head));
    // next to its end no step in the dense output shows
    BOOST_TEST(distance(stepper.after(std::nextafter(stepper.length(), 0.0)).head, next.head) < 1e-14);
    stepper.proceed(next);
  }
}

BOOST_AUTO_TEST_CASE(events_are_found_inside_the_steps_of_dop853) {
  const auto system = linear_pendulum::make<double>(0, unit);
  dop853_stepper<oscillator> stepper(system, -46.0);
  stepper.start(0.0, {1.0, 0.0});
  notebook found;
  const event passes_zero[] = {{event_kind::angle}};
  adaptive_run(stepper, 0.0, 30.0, passes_zero).to_end(1000000, found, always);
  BOOST_REQUIRE(found.times.size() == 10u);  // at π/2 and n times π
  for (std::size_t n = 0; n < 10; ++n)
    BOOST_TEST(std::fabs(found.times[n] - (static_cast<double>(n) + 0.5) * 3.141592653589793) < 1e-12);
}

BOOST_AUTO_TEST_CASE(lanes_of_dop853_carry_the_bits_of_scalar_runs) {
  using lanes4 = pack<double, 4>;
  using abreast = double_pendulum::over<lanes4>;
  const lanes4 p[] = {1.0, 1.0, 1.0, 1.0, 9.81};
  const auto system = double_pendulum::make<lanes4>(0, p);
  const auto alone = double_pendulum::make<double>(0, of_rods);
  auto random = generator();
  std::uniform_real_distribution<double> angle(-3.0, 3.0);
  abreast::state start;
  for (lanes4& x : start)
    for (int l = 0; l < 4; ++l) set_lane(x, l, angle(random) * (l == 3 ? 1e-4 : 1.0));
  dop853_stepper<abreast> together(system, -30.0);
  together.start(0.0, start);
  std::vector<dop853_stepper<rods>> each(4, dop853_stepper<rods>(alone, -30.0));
  for (int l = 0; l < 4; ++l)
    each[l].start(0.0, {lane(start[0], l), lane(start[1], l), lane(start[2], l), lane(start[3], l)});
  for (int n = 0; n < 300; ++n) {
    together.expand({0.0, 0.0}, 1.0);
    const auto next = together.after(together.length());
    lanes4 tau = lanes4(0.4) * together.length();
    set_lane(tau, 2, lane(together.length(), 2));
    const auto within = together.after(tau);
    int different = 0;
    for (int l = 0; l < 4; ++l) {
      each[l].expand({0.0, 0.0}, 1.0);
      different += each[l].length() != lane(together.length(), l);
      const auto own = each[l].after(each[l].length()), own_within = each[l].after(lane(tau, l));
      for (std::size_t i = 0; i < 4; ++i) {
        different += own.head[i] != lane(next.head[i], l) || own.tail[i] != lane(next.tail[i], l);
        different += own_within.head[i] != lane(within.head[i], l) || own_within.tail[i] != lane(within.tail[i], l);
      }
      different += each[l].evaluations() != together.evaluations(l);
      each[l].proceed(own);
    }
    BOOST_REQUIRE(different == 0);
    together.proceed(next);
  }
  BOOST_TEST(each[0].evaluations() != each[1].evaluations());  // there were rejections
}

BOOST_AUTO_TEST_CASE(a_resumed_run_of_dop853_repeats_the_bits) {
  using stepper_of_rods = dop853_stepper<rods>;
  static_assert(std::is_trivially_copyable_v<stepper_of_rods::memory>);
  static_assert(sizeof(stepper_of_rods::memory) % sizeof(double) == 0);
  const auto system = double_pendulum::make<double>(0, of_rods);
  stepper_of_rods first(system, -45.0);
  first.start(0.0, {2.0, 2.5, 0.0, 0.0});
  const auto advance = [](stepper_of_rods& stepper, int steps) {
    for (int n = 0; n < steps; ++n) {
      stepper.expand({0.0, 0.0}, 1.0);
      stepper.proceed(stepper.after(stepper.length()));
    }
  };
  const auto same = [](const auto& a, const auto& b) { return std::memcmp(&a, &b, sizeof a) == 0; };
  for (const int before : {0, 1, 57}) {
    advance(first, before);
    const auto remembered = first.remembered();
    stepper_of_rods second(system, -45.0);
    second.resume(remembered);
    advance(first, 100);
    BOOST_TEST(!same(first.remembered(), second.remembered()));
    advance(second, 100);
    BOOST_TEST(same(first.remembered(), second.remembered()));
  }
}

BOOST_AUTO_TEST_CASE(steps_of_dop853_are_rejected_and_made_again) {
  const auto system = double_pendulum::make<double>(0, of_rods);
  const rods::state y{3.1, -3.0, 20.0, -25.0};
  const auto exact = run(system, y, {1.0}, -52.0), rough = run(system, y, {1.0}, -10.0);
  const auto rejected = (rough.result.evaluations - 2 - 12 * rough.result.steps) / 11;
  BOOST_TEST(rejected > 1);
  BOOST_TEST(rejected < rough.result.steps);
  BOOST_TEST(distance(rough.states[0], exact.states[0]) < 1.0);  // of 25
  // a first step that is much too long
  dop853_stepper<rods> stepper(system, -10.0);
  stepper.start(0.0, y);
  auto from = stepper.remembered();
  from.step = 5.0;
  stepper.resume(from);
  stepper.expand({0.0, 0.0}, 1.0);
  BOOST_TEST(stepper.evaluations() > 1 + 12 + 2 * 11);
  BOOST_TEST(stepper.length() < 0.1);
}

BOOST_AUTO_TEST_CASE(units_do_not_matter_to_dop853) {
  const double times_four[] = {1.0, 1.0, 1.0, 1.0, 16.0 * 9.81};  // time runs four times as fast
  const auto slow = double_pendulum::make<double>(0, of_rods), fast = double_pendulum::make<double>(0, times_four);
  const auto a = run(slow, rods::state{2.0, 2.5, 0.25, 0.5}, {4.0}, -40.0);
  const auto b = run(fast, rods::state{2.0, 2.5, 1.0, 2.0}, {1.0}, -40.0);
  BOOST_TEST(a.result.evaluations == b.result.evaluations);
  BOOST_TEST(a.states[0][1] == b.states[0][1]);
  BOOST_TEST(4.0 * a.states[0][3] == b.states[0][3]);
}

BOOST_AUTO_TEST_CASE(at_rest_dop853_takes_steps_of_a_finite_length) {
  const auto found = run(linear_pendulum::make<double>(0, unit), oscillator::state{0.0, 0.0}, {1e4}, -52.0);
  BOOST_TEST(name_of(found.result.ended) == "reached_end");
  BOOST_TEST((found.states[0] == oscillator::state{0.0, 0.0}));
  BOOST_TEST(found.result.steps > 1000);
  BOOST_TEST(found.result.steps < 2000);
}

BOOST_AUTO_TEST_CASE(a_step_of_dop853_that_cannot_be_made_ends_the_run) {
  const auto system = double_pendulum::make<double>(0, of_rods);
  const double infinity = std::numeric_limits<double>::infinity();
  const rods::state starts[] = {{std::nan(""), 0.0, 0.0, 0.0},
                                {0.5, 0.0, infinity, 0.0},
                                {0.5, 0.0, 1e200, 0.0},
                                {largest_angle - 1.0, 0.0, 100.0, 0.0}};
  for (const auto& y : starts) {
    const auto found = run(system, y, {100.0}, -40.0);
    BOOST_TEST(name_of(found.result.ended) == "not_finite");
    BOOST_TEST(found.result.evaluations < 10000);
  }
  const auto never = run(system, {2.0, 2.5, 0.0, 0.0}, {1.0}, -400.0);  // what no step satisfies
  BOOST_TEST(name_of(never.result.ended) == "not_finite");
}
