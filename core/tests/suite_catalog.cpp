// What every system and every method of the catalogue has to pass.
#include "conformance.hpp"

using pendula::systems;

BOOST_AUTO_TEST_SUITE(catalogue)

BOOST_AUTO_TEST_CASE(every_method_converges_with_its_order) {
  conformance::every_method_converges_with_its_order<systems>();
}
BOOST_AUTO_TEST_CASE(every_method_goes_back_where_it_came_from) {
  conformance::every_method_goes_back_where_it_came_from<systems>();
}
BOOST_AUTO_TEST_CASE(every_system_conserves_its_energy_where_it_says_so) {
  conformance::every_system_conserves_its_energy_where_it_says_so<systems>();
}
BOOST_AUTO_TEST_CASE(every_system_rests_at_the_lowest_point) {
  conformance::every_system_rests_at_the_lowest_point<systems>();
}
BOOST_AUTO_TEST_CASE(every_system_keeps_its_lengths) { conformance::every_system_keeps_its_lengths<systems>(); }
BOOST_AUTO_TEST_CASE(canonical_variables_lead_back_to_the_state) {
  conformance::canonical_variables_lead_back_to_the_state<systems>();
}
BOOST_AUTO_TEST_CASE(canonical_variables_are_those_of_the_motion) {
  conformance::canonical_variables_are_those_of_the_motion<pendula::ideal_systems>();
}

BOOST_AUTO_TEST_SUITE_END()
