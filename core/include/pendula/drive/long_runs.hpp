// Runs of the Taylor method with numbers of many words, built for some counts of words (core/src/long_runs.cpp).
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string_view>

#include "pendula/drive/outcome.hpp"

namespace pendula {

struct long_run_request {
  std::string_view system;  // of the catalogue, with its form and parameters
  std::size_t form;
  std::span<const double> parameters, state;
  double t0;
  std::span<const double> times;  // which follow one another, away from t0
};

struct long_run_kernel {
  int decimal_digits;  // that it computes with
  // Writes for each time each component of the state as a head and a tail, and asks go_on(time) after every step.
  outcome (*run)(const long_run_request&, double* states, const std::function<bool(double)>& go_on);
};

// From few digits to many, in two parts.
std::span<const long_run_kernel> shorter_long_runs();
std::span<const long_run_kernel> longer_long_runs();

}  // namespace pendula
