// Many trajectories of the two rods from rest through the lanes of one Taylor stepper, for the benchmark in Python.
#include <algorithm>
#include <vector>

#include "pendula/drive/lanes.hpp"
#include "pendula/method/taylor.hpp"
#include "pendula/system/double_pendulum.hpp"

namespace {

using namespace pendula;
// Two registers side by side where there are 32 of them: one fills the other's waiting.
constexpr int width = lanes_of_machine == 8 ? 16 : lanes_of_machine;
using S = pack<double, width>;

template <class One>
struct feed {
  const double* angles;
  long count;
  double* states;
  long taken = 0, steps = 0;

  std::size_t next(One& stepper) {
    if (taken == count) return no_trajectory;
    stepper.start(0.0, {angles[taken], angles[count + taken], 0.0, 0.0});
    return static_cast<std::size_t>(taken++);
  }
  void output(std::size_t n, std::size_t, const vec<double, 4>& y) { std::ranges::copy(y, states + 4 * n); }
  void event(std::size_t, int, double, const vec<double, 4>&) {}
  void finish(const lane_end& told) { steps += told.steps; }
  bool go_on() { return true; }
};

}  // namespace

extern "C" int taylor_lanes_width() { return width; }

// From angles (2, count) to the states (count, 4) at the time `end`; the steps that all of them took.
extern "C" long taylor_lanes(const double* angles, long count, double end, double* states) {
  using One = taylor_stepper<double_pendulum::over<double>>;
  using Lanes = taylor_stepper<double_pendulum::over<S>>;
  const double p[] = {1.0, 1.0, 1.0, 1.0, 9.81};
  const std::vector<S> in_lanes(std::begin(p), std::end(p));
  One one(double_pendulum::make<double>(0, p), -52.0);
  Lanes lanes(double_pendulum::make<S>(0, in_lanes.data()), -52.0);
  feed<One> trajectories{angles, count, states};
  const lanes_task task{0.0, end, std::int64_t{1} << 40, {&end, 1}, {}};
  lanes_run<Lanes, One, feed<One>>(lanes, one, task, trajectories).all();
  return trajectories.steps;
}
