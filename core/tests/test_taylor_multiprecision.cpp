// The Taylor method over Boost's numbers.
#include <boost/test/unit_test.hpp>

#include "pendula/drive/adaptive.hpp"
#include "pendula/method/taylor.hpp"
#include "pendula/scalar/multiprecision.hpp"
#include "pendula/system/double_pendulum.hpp"
#include "pendula/system/linear_pendulum.hpp"
#include "pendula/system/simple_pendulum.hpp"

using namespace pendula;

// From rest at (2, 2.5), t = 1: FLINT with 60 digits, of which 30 are kept (tests/reference/double.json's generator).
BOOST_AUTO_TEST_CASE(fifty_digits_reach_the_check_value) {
  using S = multiprecision<50>;
  using Sys = double_pendulum::over<S>;
  const S rods[] = {S(1.0), S(1.0), S(1.0), S(1.0), S(9.81)};
  taylor_stepper<Sys> stepper(double_pendulum::make<S>(0, rods), -166.0);
  stepper.start(S(0.0), {S(2.0), S(2.5), S(0.0), S(0.0)});
  using run = adaptive_run<taylor_stepper<Sys>>;
  struct last_state {
    Sys::state y{};
    bool step(const run& r, const S& stop) {
      y = r.stepper().state_of(r.stepper().after(stop));
      return true;
    }
    void event(const run&, int, const S&) {}
  } found;
  run(stepper, 0.0, 1.0).to_end(1000, found, [](double, std::int64_t) { return true; });
  const char* const truth[] = {"-1.01478186187538305510122131070", "-1.12244606910181524985477659647",
                               "-7.26181086506237487033414068257", "5.72845783468323474017121296411"};
  for (int c = 0; c < 4; ++c) BOOST_TEST(abs(found.y[c] - S(truth[c])).convert_to<double>() < 1e-28);
}
