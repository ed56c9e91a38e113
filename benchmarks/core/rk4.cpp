// Nanoseconds a step and trajectory of RK4 for the two rods: a bare loop with the C library, and this core with 1, 2, 4
// and 8 lanes. The variants take turns, so that a machine that slows down slows all of them; the least time counts.
#include "pendula/method/rk4.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "bare_loop.hpp"
#include "pendula/drive/fixed.hpp"
#include "pendula/system/double_pendulum.hpp"

namespace {

constexpr long steps = 100000;
constexpr int rounds = 15;
volatile double kept;  // so that nothing is optimised away

template <class S>
void core() {
  using Sys = pendula::double_pendulum::over<S>;
  const S p[] = {S(1.0), S(1.0), S(1.0), S(1.0), S(9.81)};
  const Sys system = pendula::double_pendulum::make<S>(0, p);
  const pendula::fixed_output last[] = {{steps, 0.0}};
  pendula::fixed_run<pendula::rk4, Sys>(system, {S(2.0), S(2.5), S(0.0), S(0.0)}, 0.0, 1e-4, steps)
      .through(last, [](std::size_t, const auto& y) { kept = pendula::lane(y[0], 0); }, [](auto) { return true; });
}

struct variant {
  const char* name;
  int trajectories;
  std::function<void()> run;
  double best = 1e300;
};

}  // namespace

int main() {
  std::vector<variant> variants{{"bare loop, libm", 1, [] { kept = bare_loop({2.0, 2.5, 0.0, 0.0}, 1e-4, steps)[0]; }},
                                {"1 lane", 1, core<double>},
                                {"2 lanes", 2, core<pendula::pack<double, 2>>},
                                {"4 lanes", 4, core<pendula::pack<double, 4>>},
                                {"8 lanes", 8, core<pendula::pack<double, 8>>}};
  for (int round = 0; round < rounds; ++round)
    for (variant& v : variants) {
      const auto start = std::chrono::steady_clock::now();
      v.run();
      const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - start;
      v.best = std::min(v.best, took.count() / steps / v.trajectories);
    }
  for (const variant& v : variants) std::printf("%s\t%.2f\n", v.name, v.best);
}
