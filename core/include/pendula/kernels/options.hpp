// The options of a run, each in one row: Python's signatures, the command, recipes and the documentation read it.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace pendula {

enum class taken_by : std::uint8_t { every_method, fixed_step, adaptive, taylor };
inline constexpr std::string_view taken_by_names[] = {"every method", "fixed-step methods", "adaptive methods",
                                                      "the Taylor method"};

struct option_row {
  std::string_view name;
  std::string_view unit;  // SI; empty: a pure number
  bool whole;             // a whole number
  double least, most;     // of its range; least 0: above 0
  double example;
  taken_by by;
  std::string_view meaning;    // one phrase, lower case
  std::string_view otherwise;  // what is done where it is not given, as the command's help says it
};
std::span<const option_row> option_rows();

}  // namespace pendula
