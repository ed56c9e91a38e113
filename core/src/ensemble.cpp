// Ensembles of any method, through the lanes of this processor.
#include <vector>

#include "pendula/drive/ensemble_kernels.hpp"
#include "pendula/drive/fixed.hpp"
#include "pendula/drive/machine.hpp"

namespace pendula_kernels {

#ifdef PENDULA_X86_KERNELS
extern const lanes_kernel adaptive_lanes_avx2, adaptive_lanes_avx512, fixed_lanes_avx2, fixed_lanes_avx512;
static const lanes_kernel* const adaptive_lanes[] = {&adaptive_lanes_avx2, &adaptive_lanes_avx512};
static const lanes_kernel* const fixed_lanes[] = {&fixed_lanes_avx2, &fixed_lanes_avx512};
static constexpr machine first_with_lanes = machine::avx2;
#else
extern const lanes_kernel adaptive_lanes_plain, fixed_lanes_plain;
static const lanes_kernel* const adaptive_lanes[] = {&adaptive_lanes_plain};
static const lanes_kernel* const fixed_lanes[] = {&fixed_lanes_plain};
static constexpr machine first_with_lanes = machine::plain;
#endif

namespace {

// One trajectory of an ensemble, as the run of a single one tells of it.
struct one_of_many : receiver {
  one_of_many(ensemble_receiver& to, std::size_t trajectory) : to(to), trajectory(trajectory) {}

  void output(double, const double* y) override { to.output(trajectory, place++, y); }
  void event(int kind, double t, const double* y) override { to.event(trajectory, kind, t, y); }
  void step(const step_memory&) override {}
  bool go_on(double, std::int64_t) override { return to.go_on(); }

  ensemble_receiver& to;
  std::size_t trajectory, place = 0;
};

struct fixed_one_of_many : fixed_receiver {
  fixed_one_of_many(ensemble_receiver& to, std::size_t trajectory) : to(to), trajectory(trajectory) {}

  bool output(std::size_t place, const double* y) override {
    to.output(trajectory, place, y);
    return true;
  }
  bool go_on(std::int64_t) override { return to.go_on(); }

  ensemble_receiver& to;
  std::size_t trajectory;
};

double reached_by(const fixed_outcome& result, const ensemble_request& asked) {
  if (static_cast<pendula::outcome>(result.ended) == pendula::outcome::reached_end) return asked.end;
  return asked.t0 + static_cast<double>(result.steps) * asked.step;
}

void run_one_by_one(const ensemble_request& asked, std::span<const fixed_place> places, std::size_t dimension,
                    ensemble_receiver& to) {
  for (std::size_t n; (n = to.next()) != no_more;) {
    const double* const parameters = asked.parameters + n * asked.parameters_apart;
    const double* const state = asked.states + n * dimension;
    if (asked.step != 0.0) {
      fixed_one_of_many told(to, n);
      const fixed_outcome result = fixed_plain.run(
          {asked.system, asked.form, parameters, asked.method, state, asked.step, asked.step_limit}, places, told);
      to.finish(n, result.ended, result.steps, reached_by(result, asked));
    } else {
      one_of_many told(to, n);
      const adaptive_outcome result =
          all_adaptive().back()->solve({asked.system, asked.form, parameters, asked.method, state, asked.t0, asked.end,
                                        asked.log2_of_tolerance, asked.step_limit},
                                       asked.times, asked.events, told);
      to.finish(n, result.ended, result.steps, result.reached);
    }
  }
}

// Trajectories of an adaptive method that end where they begin.
void run_none(const ensemble_request& asked, std::size_t dimension, ensemble_receiver& to) {
  for (std::size_t n; (n = to.next()) != no_more;) {
    for (std::size_t i = 0; i < asked.times.size(); ++i) to.output(n, i, asked.states + n * dimension);
    to.finish(n, static_cast<std::uint8_t>(pendula::outcome::reached_end), 0, asked.t0);
  }
}

}  // namespace

void run_ensemble(const ensemble_request& asked, std::size_t dimension, ensemble_receiver& to) {
  if (asked.end == asked.t0 && asked.step == 0.0) return run_none(asked, dimension, to);
  std::vector<fixed_place> places;
  if (asked.step != 0.0) places = pendula::requested_times(asked.t0, asked.step, asked.times).outputs;
  const bool lanes_find_events = asked.events.empty() || asked.method == "taylor";
  if (!lanes_find_events) return run_one_by_one(asked, places, dimension, to);
  const auto kernels = built_for_here(asked.step != 0.0 ? fixed_lanes : adaptive_lanes, first_with_lanes);
  for (auto widest = kernels.rbegin(); widest != kernels.rend(); ++widest)
    if ((*widest)->run(asked, places, to)) return;
  run_one_by_one(asked, places, dimension, to);
}

}  // namespace pendula_kernels
