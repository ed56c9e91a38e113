// The trust horizon of a run of any method of the catalogue.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>

namespace pendula {

struct horizon_request {
  std::string_view system;  // of the catalogue, with its form and parameters
  std::size_t form;
  std::span<const double> parameters, state;
  std::string_view method;
  double t0, end;
  double step;               // of a method of fixed step; negative: backward
  double log2_of_tolerance;  // of an adaptive one
  double certify;            // largest difference of angles, in radians
};

// The time, infinite where it is not within the run; none where go_on, asked with the time every few milliseconds,
// wants no more.
std::optional<double> trust_horizon(const horizon_request&, const std::function<bool(double)>& go_on);

}  // namespace pendula
