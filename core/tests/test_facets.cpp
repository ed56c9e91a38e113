// Each method takes the systems that have what it needs, and no others: said at compile time, by facet.
#include "conformance_adaptive.hpp"
#include "damped_bob.hpp"
#include "partial_systems.hpp"

using namespace pendula;
using damped = damped_bob::over<double>;

namespace {

using explicit_ones = std::tuple<euler, heun, rk4>;
using implicit_ones = std::tuple<midpoint, gauss4, gauss6, gauss8>;
using splitting_ones = std::tuple<symplectic_euler, verlet, yoshida4, yoshida6, yoshida8>;

// How many of the methods take a system: by the facet they say they need; of those of fixed step, also by the step
// itself, which names the facet a second time.
template <class Methods, class Sys>
constexpr int count_that_take() {
  int count = 0;
  for_each<Methods>([&]<class Method>() {
    constexpr bool taken = Takes<Method, Sys>;
    if constexpr (!Method::adaptive) static_assert(taken == StepsOver<Method, Sys>);
    count += taken;
  });
  return count;
}
template <class Sys, class... Lists>
constexpr bool takes_all_of = ((count_that_take<Lists, Sys>() == std::tuple_size_v<Lists>) && ...);
template <class Sys, class... Lists>
constexpr bool takes_none_of = ((count_that_take<Lists, Sys>() == 0) && ...);

// Whether a stepper can be named at all.
template <class Method, class Sys>
concept Steppable = requires { typename Method::template stepper<Sys>; };

template <class Sys, bool by_dop853, bool by_taylor>
constexpr bool adaptive_ones_take = Takes<dop853, Sys> == by_dop853 && Steppable<dop853, Sys> == by_dop853 &&
                                    Takes<taylor, Sys> == by_taylor && Steppable<taylor, Sys> == by_taylor;

}  // namespace

// An odd dimension: no halves, so nothing that has them.
using partial::with_phase;
static_assert(Flow<with_phase> && !SecondOrder<with_phase> && !Energetic<with_phase> && !Mechanical<with_phase>);
static_assert(takes_all_of<with_phase, explicit_ones> && takes_none_of<with_phase, implicit_ones, splitting_ones>);
static_assert(adaptive_ones_take<with_phase, false, false>);

static_assert(!Energetic<partial::without_energy> && Separable<partial::without_energy>);
static_assert(takes_all_of<partial::without_energy, explicit_ones, implicit_ones, splitting_ones>);
static_assert(adaptive_ones_take<partial::without_energy, false, false>);

static_assert(Separable<partial::without_series> && !Analytic<partial::without_series>);
static_assert(takes_all_of<partial::without_series, explicit_ones, implicit_ones, splitting_ones>);
static_assert(adaptive_ones_take<partial::without_series, true, false>);

static_assert(!Mechanical<partial::without_canonical_variables> && Energetic<partial::without_canonical_variables>);
static_assert(takes_all_of<partial::without_canonical_variables, explicit_ones>);
static_assert(takes_none_of<partial::without_canonical_variables, implicit_ones, splitting_ones>);
static_assert(adaptive_ones_take<partial::without_canonical_variables, true, false>);

static_assert(takes_none_of<partial::of_doubles_alone, implicit_ones> && !Mechanical<partial::of_doubles_alone>);

// Forces that depend on the velocity do not separate.
static_assert(Mechanical<damped> && !Separable<damped> && Analytic<damped>);
static_assert(takes_all_of<damped, explicit_ones, implicit_ones> && takes_none_of<damped, splitting_ones>);
static_assert(adaptive_ones_take<damped, true, true>);

static_assert(takes_all_of<simple_pendulum::over<double>, explicit_ones, implicit_ones, splitting_ones>);
static_assert(takes_none_of<double_pendulum::over<double>, splitting_ones>);

BOOST_AUTO_TEST_CASE(an_odd_dimension_goes_through_an_explicit_method) {
  const auto end = conformance::after<rk4>(with_phase{}, {1.0, 0.0, 0.0}, 0.0, 5.0, 5000);
  BOOST_TEST(std::fabs(end[0] + 0.525350171885605) < 1e-12, end[0]);  // mpmath 1.3, odefun
  BOOST_TEST(std::fabs(end[2] - 10.0) < 1e-12);
}

// Angles and velocities have their events without a place; the height of a tip is none of its business, and is told of
// no crossing.
BOOST_AUTO_TEST_CASE(a_system_without_positions_runs_with_its_events) {
  using Sys = partial::without_series;
  static_assert(!Positioned<Sys>);
  const event asked[] = {{event_kind::angle}, {event_kind::velocity_zero}, {event_kind::tip_height, 0, -0.9}};
  const auto found = conformance::told<dop853>(Sys{}, {1e-4, 0.0}, {conformance::t0 + 10.0}, asked);
  int counts[3] = {};
  for (const auto& each : found.events) ++counts[each.place];
  BOOST_TEST(counts[0] == 3);  // a small swing: at π/2, 3π/2, 5π/2
  BOOST_TEST(counts[1] == 3);  // at π, 2π, 3π
  BOOST_TEST(counts[2] == 0);
  const auto y = conformance::after<gauss6>(Sys{}, {1.0, 0.0}, 0.0, 1.0, 64),
             z = conformance::after<verlet>(Sys{}, {1.0, 0.0}, 0.0, 1.0, 4096);
  BOOST_TEST(conformance::distance(y, z) < 1e-7);
}
