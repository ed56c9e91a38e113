// Whether a request makes sense, before anything is run.
#pragma once

#include <optional>

#include "pendula/kernels/fault.hpp"
#include "pendula/kernels/request.hpp"

namespace pendula {

// Each gives the first fault there is.
std::optional<fault> check(const system_description&);
std::optional<fault> check(const request&);
// A request whose times are read as those of the argument `times_argument`: "t" is the standard.
std::optional<fault> check_options(const request&);

}  // namespace pendula
