// The loops of the closed form over arrays, built for several machines into one program, which takes the best that its
// processor has. All give the same bits.
#pragma once

#include <cstddef>
#include <span>

namespace pendula {

// `refused`: some state or time is too large; the first one has NaN for its result.
enum class exact_outcome { complete, refused, stopped };

struct exact_kernel {
  // Each state (θ0, ω0), the time t − t0 after it, into `out`, pair by pair.
  void (*states)(double length, double gravity, const double* states, std::size_t count, double t, double t0,
                 double* out, unsigned char* lacking);
  // One state at each time.
  void (*times)(double length, double gravity, const double* state, const double* t, std::size_t count, double t0,
                double* out, unsigned char* lacking);
  // One state of the linear pendulum at each time; see `linear_motion` for the first two.
  void (*linear)(const double frequency[2], const double rate[3], const double* state, const double* t,
                 std::size_t count, double t0, double* out);
};

// Those that this processor can run, the best one last. They set `lacking` where a point needs more digits,
// and leave it alone elsewhere.
std::span<const exact_kernel* const> all_exact();

}  // namespace pendula
