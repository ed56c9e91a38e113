// Double pendulums with variations of their motion, through lanes.
#include <algorithm>
#include <vector>

#include "pendula/catalog.hpp"
#include "pendula/drive/lanes.hpp"
#include "pendula/drive/variations.hpp"
#include "pendula/kernels/variations.hpp"

namespace {

using namespace pendula;

constexpr int width = lanes_of_machine;  // two registers side by side would not stay in the nearest cache
using S = pack<double, width>;

template <int n, variation_use use>
class feed {
 public:
  using One = varied_stepper<double, n, use>;

  feed(const request& asked, std::size_t count, const ensemble_rows& rows, ensemble_receiver& to)
      : asked_(asked), rows_(rows), to_(to), told_(4 + 5 * count), first_output_(output_at_start(asked)) {}

  static std::size_t output_at_start(const request& asked) {
    return !asked.times.empty() && asked.times[0] == asked.t0 ? 1 : 0;
  }
  std::size_t next(One& one) {
    const std::size_t trajectory = to_.next();
    if (trajectory == no_trajectory) return trajectory;
    if (rows_.parameters_apart != 0)
      one.change(double_pendulum::make<double>(asked_.system.form, rows_.parameters_of(trajectory)));
    vec<double, 4> start;
    std::copy_n(rows_.state_of(trajectory), 4, start.begin());
    one.start(asked_.t0, start);
    if (first_output_ == 1) tell(trajectory, 0, one.at_start(start));
    return trajectory;
  }
  void output(std::size_t trajectory, std::size_t place, const typename One::state& y) {
    tell(trajectory, place + first_output_, y);
  }
  void event(std::size_t, int, double, const typename One::state&) {}  // are not asked for
  void finish(const lane_end& end) { to_.finish(end.trajectory, {end.ended, end.steps, end.evaluations, end.reached}); }
  bool go_on() { return to_.go_on(); }

 private:
  // Without the variations that only fill the lanes.
  void tell(std::size_t trajectory, std::size_t place, typename One::state y) {
    std::copy(y.begin() + 4 + 5 * n, y.end(), y.begin() + static_cast<std::ptrdiff_t>(told_));
    to_.output(trajectory, place, y.data());
  }

  const request& asked_;
  const ensemble_rows& rows_;
  ensemble_receiver& to_;
  std::size_t told_, first_output_;
};

template <int n, variation_use use>
void run_all(const request& asked, const varied_by& by, const ensemble_rows& rows, ensemble_receiver& to) {
  using One = varied_stepper<double, n, use>;
  using Lanes = varied_stepper<S, n, use>;
  typename One::variations start;
  typename Lanes::variations start_in_lanes;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      start[i][j] = by.start[4 * std::min(i, by.count - 1) + j];
      start_in_lanes[i][j] = S(start[i][j]);
    }
  const double tolerance = log2_of_tolerance(asked.options);
  const double* const first = rows.parameters.data();
  const std::vector<S> in_lanes(first, first + double_pendulum::forms[asked.system.form].parameters.size());
  One one(double_pendulum::make<double>(asked.system.form, first), tolerance, asked.t0, start);
  Lanes lanes(double_pendulum::make<S>(asked.system.form, in_lanes.data()), tolerance, asked.t0, start_in_lanes);
  const lanes_task task{asked.t0,
                        asked.end(),
                        asked.step_limit(),
                        std::span(asked.times).subspan(feed<n, use>::output_at_start(asked)),
                        {}};
  feed<n, use> trajectories(asked, by.count, rows, to);
  lanes_run<Lanes, One, feed<n, use>>(lanes, one, task, trajectories).all();
}

void run_free(const request& asked, const varied_by& by, const ensemble_rows& rows, ensemble_receiver& to) {
  if constexpr (width > 2) {  // where there are few lanes to gain from, four variations do for fewer
    if (by.count == 1) return run_all<1, variation_use::free>(asked, by, rows, to);
    if (by.count == 2) return run_all<2, variation_use::free>(asked, by, rows, to);
  }
  run_all<4, variation_use::free>(asked, by, rows, to);
}

bool run(const request& asked, const varied_by& by, const ensemble_rows& rows, ensemble_receiver& to) {
  if (asked.system.name != double_pendulum::name || !asked.events.empty()) return false;
  if (by.use == variation_use::megno) {
    run_all<1, variation_use::megno>(asked, by, rows, to);
  } else if (by.use == variation_use::orthogonal) {
    run_all<4, variation_use::orthogonal>(asked, by, rows, to);
  } else {
    run_free(asked, by, rows, to);
  }
  return true;
}

}  // namespace

namespace pendula::PENDULA_MACHINE {
extern const variation_kernel variation_lanes{run};
}  // namespace pendula::PENDULA_MACHINE
