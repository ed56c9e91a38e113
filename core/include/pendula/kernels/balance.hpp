// The balance of energy of a motion with friction or a drive.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "pendula/kernels/result.hpp"

namespace pendula {

// What does work on a system, the first `works`, and what turns its energy into heat; none: its energy is constant.
struct power_rows {
  std::vector<std::string_view> names;
  std::size_t works;
};
power_rows powers_of(std::string_view system);

// Energies since t0 at the request's times [J], as far as the run comes: of each power, (n, names), and the works less
// the heats (n,), summed with twice the digits, as it is a small difference of large numbers in long runs.
struct energy_balance {
  std::vector<double> parts, net, net_tails;
  bool interrupted = false;
};

// Inside the steps of an adaptive method the powers are integrated by Gauss's formula, to the precision of its motion;
// a method of fixed step integrates them as it does the motion. The request is sound, and its times are outputs.
energy_balance balance_of(const request&, const watcher&);

}  // namespace pendula
