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

struct flip_cells {
  std::optional<fault> refused;
  std::vector<double> time;                               // NaN: none until t_max
  std::vector<std::uint8_t> rod, forbidden, resolved;     // rod 0: none; resolved: empty where not asked
  bool interrupted = false;
};

struct flips_asked {
  system_description system;
  double t_max, tolerance;
  int which;     // the rod, 1 or 2; 0: the first that flips
  bool resolve;  // a second run, with a thousandth of the tolerance
};

// First flips from each pair of the angles, the second one's changing first. Of a start and its mirror image, both angles
// negated, the same one is run.
flip_cells find_flips(const flips_asked&, std::span<const double> theta1, std::span<const double> theta2, pool&,
                      const watcher&);

}  // namespace pendula
