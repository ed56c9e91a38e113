// Runs of the Taylor method with numbers of many words, built for some counts of words.
#pragma once

#include <span>

#include "pendula/kernels/result.hpp"

namespace pendula {

// An angle from which on a run ends: beyond it little is left of a double's turn, and the sine's count of quarter turns
// would not be exact.
inline constexpr double largest_long_angle = 0x1p50;

struct long_run_kernel {
  int decimal_digits;  // that it computes with
  // States at the request's times, and their tails.
  run_result (*run)(const request&, const watcher&);
};

// From few digits to many.
std::span<const long_run_kernel> long_runs();

}  // namespace pendula
