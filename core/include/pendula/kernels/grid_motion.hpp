// A motion without an end on the grid t0 + n·spacing, asked for in pieces.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "pendula/kernels/result.hpp"
#include "pendula/kernels/run_kernels.hpp"

namespace pendula {

// Each state has the bits that `solve` gives as an output at that time, however the grid is asked for. What was
// computed is gone on from; what lies before is reached from one of the places that were kept on the way.
class grid_motion {
 public:
  // Of the request's own times none is looked at, nor its events, its step limit and `certify`.
  grid_motion(request run, double spacing);

  struct part {
    std::optional<fault> refused;  // then nothing was run
    std::size_t count = 0;         // of the places, from the first one on; fewer where the motion breaks down
    outcome ended = outcome::reached_end;
    std::int64_t steps = 0;  // that the motion took up to the furthest place so far
  };
  // States (count, d) at the places first, first + stride …, no places before the start.
  part at(std::int64_t first, std::size_t count, std::int64_t stride, double* states, const watcher&);

 private:
  double time(std::int64_t place) const { return run_.t0 + static_cast<double>(place) * spacing_; }
  std::optional<fault> check_up_to(std::int64_t place);
  void of_fixed(std::int64_t first, std::size_t count, std::int64_t stride, double* states, part&);
  void of_adaptive(std::int64_t first, std::size_t count, std::int64_t stride, double* states, const watcher&, part&);
  grid_walk& walk_before(std::int64_t steps);
  void keep(const grid_walk&);
  std::optional<fault> reach(std::int64_t place, const watcher&);

  request run_;
  double spacing_;
  std::unique_ptr<grid_walk> front_, again_;      // the furthest, and one that goes the same way once more
  std::vector<std::unique_ptr<grid_walk>> kept_;  // at rising counts of steps
  std::int64_t apart_;                            // so many steps between two of them
  run_result known_;                              // of an adaptive method
  std::int64_t known_places_ = 0;
};

}  // namespace pendula
