// The motion worked out with twice a double's digits, beside a run with doubles: built for several machines into one
// program, which takes the best that its processor has. All give the same bits.
#pragma once

#include <memory>

#include "pendula/kernels/run_kernels.hpp"

namespace pendula {

// It stands in a step of its own, which begins at or before the times it is asked about.
class shadow {
 public:
  virtual ~shadow() = default;
  virtual void proceed() = 0;  // to the next step
  virtual two_doubles step_end() const = 0;
  // The angles at a time within the step.
  virtual void angles(two_doubles time, two_doubles* to) const = 0;
};

struct shadow_maker {
  std::unique_ptr<shadow> (*make)(const request&);
};

// For this processor.
const shadow_maker& best_shadow_maker();

}  // namespace pendula
