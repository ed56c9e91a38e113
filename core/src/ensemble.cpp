// Which of the builds of the lanes this processor can run, and ensembles of any method.
#include <vector>

#include "pendula/drive/ensemble_kernels.hpp"
#include "pendula/drive/outcome.hpp"

namespace pendula_kernels {

extern const lanes_kernel adaptive_lanes_plain, fixed_lanes_plain;
#ifdef PENDULA_X86_KERNELS
extern const lanes_kernel adaptive_lanes_avx2, adaptive_lanes_avx512, fixed_lanes_avx2;
#endif

namespace {

// 0: plain, 1: AVX2, 2: AVX-512.
std::size_t machine_of_processor() {
#ifdef PENDULA_X86_KERNELS
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return 0;
  const bool wider =
      __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  return wider ? 2 : 1;
#else
  return 0;
#endif
}

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

void run_one_by_one(const ensemble_request& asked, std::size_t dimension, ensemble_receiver& to) {
  for (std::size_t n; to.go_on() && (n = to.next()) != no_more;) {
    one_of_many told(to, n);
    const adaptive_outcome result = all_adaptive().back()->solve(
        {asked.system, asked.form, asked.parameters + n * asked.parameters_apart, asked.method,
         asked.states + n * dimension, asked.t0, asked.end, asked.log2_of_tolerance, asked.step_limit},
        asked.times, asked.events, told);
    to.finish(n, result.ended, result.steps, result.reached);
  }
}

// Trajectories that end where they begin.
void run_none(const ensemble_request& asked, std::size_t dimension, ensemble_receiver& to) {
  for (std::size_t n; (n = to.next()) != no_more;) {
    for (std::size_t i = 0; i < asked.times.size(); ++i) to.output(n, i, asked.states + n * dimension);
    to.finish(n, static_cast<std::uint8_t>(pendula::outcome::reached_end), 0, asked.t0);
  }
}

}  // namespace

std::span<const lanes_kernel* const> all_adaptive_lanes() {
  static const lanes_kernel* const kernels[] = {
      &adaptive_lanes_plain,
#ifdef PENDULA_X86_KERNELS
      &adaptive_lanes_avx2,
      &adaptive_lanes_avx512,
#endif
  };
  return {kernels, machine_of_processor() + 1};
}

std::span<const lanes_kernel* const> all_fixed_lanes() {
  static const lanes_kernel* const kernels[] = {
      &fixed_lanes_plain,
#ifdef PENDULA_X86_KERNELS
      &fixed_lanes_avx2,
#endif
  };
  return {kernels, machine_of_processor() > 0 ? std::size(kernels) : 1};
}

void run_ensemble(const ensemble_request& asked, std::size_t dimension, ensemble_receiver& to) {
  if (asked.end == asked.t0) return run_none(asked, dimension, to);
  if (asked.step != 0.0) return all_fixed_lanes().back()->run(asked, to);
  if (asked.events.empty() || asked.method == "taylor") return all_adaptive_lanes().back()->run(asked, to);
  run_one_by_one(asked, dimension, to);
}

}  // namespace pendula_kernels
