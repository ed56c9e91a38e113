// Whether a request makes sense, before anything is run.
#pragma once

#include <optional>

#include "pendula/kernels/fault.hpp"
#include "pendula/kernels/request.hpp"

namespace pendula {

// Each gives the first fault there is.
std::optional<fault> check(const system_description&);
std::optional<fault> check(const request&);
// Of a run of doubles, which `digits` asks for more than.
std::optional<fault> check_of_doubles(const request&);
// Parts of it: whether there is such a method, which takes the system; and the options, where all the rest is sound.
std::optional<fault> check_method(const request&);
std::optional<fault> check_options(const request&);

}  // namespace pendula
