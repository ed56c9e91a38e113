// What every system of the catalogue has to pass with the methods that choose their steps, and in lanes.
#include "conformance_adaptive.hpp"

using pendula::systems;

BOOST_AUTO_TEST_SUITE(catalogue)

BOOST_AUTO_TEST_CASE(adaptive_methods_follow_small_steps) {
  conformance::adaptive_methods_follow_small_steps<systems>();
}
BOOST_AUTO_TEST_CASE(events_inside_steps_are_those_that_outputs_show) {
  conformance::events_inside_steps_are_those_that_outputs_show<systems>();
}
BOOST_AUTO_TEST_CASE(lanes_carry_the_bits_of_runs_alone) { conformance::lanes_carry_the_bits_of_runs_alone<systems>(); }

BOOST_AUTO_TEST_SUITE_END()
