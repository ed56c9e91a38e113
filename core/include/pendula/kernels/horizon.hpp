// The trust horizon of a run of any method of the catalogue.
#pragma once

#include <optional>

#include "pendula/kernels/result.hpp"

namespace pendula {

// The first time at which an angle of a run that reached the time `reached`, and ended so, is off by more than
// `options.certify`; infinite where it is not within the run. A run that broke down is right about nothing beyond its
// end. None where `watch` ended it.
std::optional<double> trust_horizon(const request&, double reached, outcome ended, const watcher& watch);

}  // namespace pendula
