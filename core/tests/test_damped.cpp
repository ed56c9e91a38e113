// A system with friction passes what the catalogue's do, and loses the energy that friction takes.
#include "conformance_adaptive.hpp"
#include "damped_bob.hpp"

using namespace pendula;
using list = std::tuple<damped_bob>;
using damped = damped_bob::over<double>;

BOOST_AUTO_TEST_SUITE(damped_bob_outside_the_catalogue)

BOOST_AUTO_TEST_CASE(every_method_converges_with_its_order) {
  conformance::every_method_converges_with_its_order<list>();
}
BOOST_AUTO_TEST_CASE(every_method_goes_back_where_it_came_from) {
  conformance::every_method_goes_back_where_it_came_from<list>();
}
BOOST_AUTO_TEST_CASE(every_system_conserves_its_energy_where_it_says_so) {
  conformance::every_system_conserves_its_energy_where_it_says_so<list>();
}
BOOST_AUTO_TEST_CASE(every_system_rests_at_the_lowest_point) {
  conformance::every_system_rests_at_the_lowest_point<list>();
}
BOOST_AUTO_TEST_CASE(every_system_keeps_its_lengths) { conformance::every_system_keeps_its_lengths<list>(); }
BOOST_AUTO_TEST_CASE(canonical_variables_are_those_of_the_motion) {
  conformance::canonical_variables_are_those_of_the_motion<list>();
}
BOOST_AUTO_TEST_CASE(adaptive_methods_follow_small_steps) { conformance::adaptive_methods_follow_small_steps<list>(); }
BOOST_AUTO_TEST_CASE(events_inside_steps_are_those_that_outputs_show) {
  conformance::events_inside_steps_are_those_that_outputs_show<list>();
}
BOOST_AUTO_TEST_CASE(lanes_carry_the_bits_of_runs_alone) { conformance::lanes_carry_the_bits_of_runs_alone<list>(); }

// E(t) = E(0) − ∫ b ω² dt, the integral by Simpson's rule over the outputs.
BOOST_AUTO_TEST_CASE(the_energy_falls_by_what_friction_takes) {
  const damped system = conformance::some_system<damped_bob, double>(0);
  const damped::state start{2.0, 1.5};
  const double span = 6.0;
  constexpr int count = 8192;
  conformance::for_each_method<adaptive_methods, damped>([&]<class Method>() {
    const auto outputs = conformance::told<Method>(system, start, conformance::times_over(span, count)).outputs;
    const auto state = [&](int i) { return i == 0 ? start : outputs[static_cast<std::size_t>(i) - 1]; };
    const double at_first = conformance::energy_of(system, start);
    double energy = at_first, taken = 0.0, most = 0.0;
    int rising = 0;
    for (int i = 2; i <= count; i += 2) {
      taken += span / count / 3.0 *
               (system.power_lost(state(i - 2)) + 4.0 * system.power_lost(state(i - 1)) + system.power_lost(state(i)));
      const double now = conformance::energy_of(system, state(i));
      rising += !(now < energy);
      energy = now;
      most = std::max(most, std::fabs(at_first - taken - now));
    }
    BOOST_TEST(rising == 0);
    BOOST_TEST(most < 2e-12 * at_first, most / at_first);
    BOOST_TEST(energy < 0.1 * at_first);
  });
}

BOOST_AUTO_TEST_SUITE_END()
