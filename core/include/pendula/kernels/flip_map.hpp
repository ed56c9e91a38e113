// The cells of a flip map: how long it takes from rest until a rod first passes the top.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pendula/kernels/pool.hpp"
#include "pendula/kernels/request.hpp"
#include "pendula/kernels/result.hpp"

namespace pendula {

// Angles at the centres of the cells from `start` to before `stop` of `count` ones between lo and hi, exactly
// antisymmetric where these are.
std::vector<double> cell_centres(double lo, double hi, std::int64_t count, std::int64_t start, std::int64_t stop);

// States (n, 4) at rest at each pair of the angles, the second one's changing first. Of a state and its mirror image,
// both angles negated, the same one stands for both: they have the same numbers.
std::vector<double> cell_starts(std::span<const double> theta1, std::span<const double> theta2);

inline constexpr double second_run_tolerance = 1e-3;  // in parts of the first one's
inline constexpr double flip_agreement = 1e-4;        // of two times, in parts of them; of two angles at the end [rad]

struct flips_asked {
  system_description system;
  double t_max, tolerance;
  int which;     // the rod, 1 or 2; 0: the first that flips
  bool resolve;  // a second run, with a smaller tolerance
};

struct flips_found {
  std::optional<fault> refused;
  std::vector<double> time;                       // NaN: none until t_max
  std::vector<std::uint8_t> rod;                  // 0: none
  std::vector<std::uint8_t> forbidden, resolved;  // the latter empty where it was not asked
  bool interrupted = false;
};

// First flips from states (n, 4) at rest.
flips_found find_flips(const flips_asked&, std::span<const double> starts, pool&, const watcher&);

}  // namespace pendula
