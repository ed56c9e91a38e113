// Motions together with small changes of them, to first order: what derivatives by the start, exponents and indicators
// of chaos are made of.
#pragma once

#include <span>
#include <vector>

#include "pendula/kernels/lanes_kernels.hpp"

namespace pendula {

// What is made of variations: themselves; the first one's MEGNO, too; or, made orthogonal to one another now and then
// (Benettin et al. 1980, Meccanica 15, 9), how the volumes that they span grow.
enum class variation_use { free, megno, orthogonal };

inline constexpr double taken_off = 0x1p300;  // of variations that have grown so long
inline constexpr std::size_t most_variations = 4;

// The variations of all runs at t0, (count, d): of (θ…, ω…). One for the MEGNO; d of them to be made orthogonal.
struct varied_by {
  variation_use use;
  std::size_t count;
  std::vector<double> start;

  // What is told at an output: the state; of each variation its d components and one number more, how often `taken_off`
  // was or, where they are made orthogonal, the logarithm of how far it has grown; and the MEGNO's integrals ∫L dt,
  // with L = ln|δ(t)|/|δ(0)|, and ∫Y dt.
  std::size_t output_size(std::size_t dimension) const {
    return dimension + (dimension + 1) * count + (use == variation_use::megno ? 2 : 0);
  }
};

struct variation_kernel {
  // Runs all that the receiver gives, through lanes; false, and runs none, where the series of this system's variations
  // is not there or the request asks for events.
  bool (*run)(const request&, const varied_by&, const ensemble_rows&, ensemble_receiver&);
};
// For this processor: the widest, or, for a few rows, a narrower one.
const variation_kernel& variation_kernel_for(std::size_t rows);

// Of any system, one trajectory after the other.
void vary_alone(const request&, const varied_by&, ensemble_receiver&, std::size_t trajectory);

// The runs of all rows with their variations: `states` holds what is told, (n, m, output_size).
ensemble_result run_varied(const request&, const varied_by&, const ensemble_rows&, pool&, const watcher&);

}  // namespace pendula
