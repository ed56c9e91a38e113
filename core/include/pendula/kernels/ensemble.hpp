// Many runs at once, shared out among the workers of a pool.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "pendula/kernels/derivatives.hpp"
#include "pendula/kernels/pool.hpp"
#include "pendula/kernels/result.hpp"

namespace pendula {

// What the trajectories of an ensemble have of their own: states (n, d), and parameters (n, p), or (1, p) for all.
struct ensemble_rows {
  std::span<const double> states, parameters;
  std::size_t count, dimension;
  std::size_t parameters_apart;  // from one trajectory's to the next one's; 0: all have the same

  const double* state_of(std::size_t n) const { return states.data() + n * dimension; }
  const double* parameters_of(std::size_t n) const { return parameters.data() + n * parameters_apart; }
};

// The runs of all rows, with what the request says besides its own state and parameters, and outputs at its times;
// their derivatives by the columns. What goes wrong with one stands in its outcome and leaves the others alone; nothing
// depends on the number of workers.
ensemble_result run_ensemble(const request&, const ensemble_rows&, std::span<const derived_by> columns, pool&,
                             const watcher&);

}  // namespace pendula
