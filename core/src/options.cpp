#include "pendula/kernels/options.hpp"

#include <limits>

#include "pendula/kernels/request.hpp"

namespace pendula {

std::span<const option_row> option_rows() {
  constexpr double unbounded = std::numeric_limits<double>::infinity();
  static constexpr option_row rows[] = {
      {"step", "s", false, 0.0, unbounded, 0.001, taken_by::fixed_step, "step size of a fixed-step method",
       "required by fixed-step methods"},
      {"tolerance", "", false, best_tolerance, largest_tolerance, 1e-9, taken_by::adaptive,
       "tolerance of an adaptive method: of the error of a step, in radians or, where less, parts of the swing",
       "machine precision"},
      {"max_steps", "", true, 1.0, largest_count, 1e6, taken_by::every_method,
       "most steps allowed; a run that needs more ends there",
       "no limit, but 10^7 where the steps of an adaptive method are the outputs"},
      {"certify", "rad", false, 0.0, largest_certify, 1e-9, taken_by::every_method,
       "also find until when the angles are accurate to this, beside a run with twice the digits", "not asked"},
      {"digits", "", true, 1.0, static_cast<double>(most_digits), 12.0, taken_by::taylor,
       "guaranteed digits of every output, however chaotic the motion", "double precision"},
  };
  return rows;
}

}  // namespace pendula
