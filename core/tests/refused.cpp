// What must not compile, one case at a time: REFUSED names it, and ctest looks for the facet in what the compiler says.
#include "damped_bob.hpp"
#include "partial_systems.hpp"
#include "pendula/drive/fixed.hpp"
#include "pendula/method/dop853.hpp"
#include "pendula/method/gauss4.hpp"
#include "pendula/method/rk4.hpp"
#include "pendula/method/taylor.hpp"
#include "pendula/method/verlet.hpp"

using namespace pendula;
using damped = damped_bob::over<double>;

#if REFUSED == 0  // all of this is sound
using stepper = dop853_stepper<damped>;
using series = taylor_stepper<damped>;
using run = fixed_run<gauss4, damped>;
using odd = fixed_run<rk4, partial::with_phase>;
static_assert(sizeof(stepper) + sizeof(series) + sizeof(run) + sizeof(odd) + degrees_of_freedom<damped> > 0);
#elif REFUSED == 1
using odd = dop853_stepper<partial::with_phase>;
#elif REFUSED == 2
const auto odd = gauss4::begin(partial::with_phase{}, {1.0, 0.0, 0.0});
#elif REFUSED == 3
static_assert(degrees_of_freedom<partial::with_phase> > 0);
#elif REFUSED == 4
using no_energy = dop853_stepper<partial::without_energy>;
#elif REFUSED == 5
using no_series = taylor_stepper<partial::without_series>;
#elif REFUSED == 6
const auto forces_of_velocity = verlet::begin(damped{}, {1.0, 0.0});
#elif REFUSED == 7
using forces_of_velocity = fixed_run<verlet, damped>;
#endif
