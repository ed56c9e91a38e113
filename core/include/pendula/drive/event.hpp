// What to look for inside the steps of a run: plain data, the same for every machine.
#pragma once

#include <cstdint>
#include <string_view>

namespace pendula {

enum class event_kind : std::uint8_t { angle, velocity_zero, tip_height };
inline constexpr std::string_view event_kind_names[] = {"angle", "velocity_zero", "tip_height"};

struct event {
  event_kind kind;
  int index = 0;              // of the angle or velocity, from 0
  double value = 0.0;         // that is passed,
  double value_tail = 0.0;    // plus this tail, below its last bit
  bool every_turn = false;    // an angle passes the value and any number of turns, too
  int direction = 0;          // 1: growing with time, −1: falling, 0: both
  std::int64_t terminal = 0;  // so many end the run; 0: none does
};

}  // namespace pendula
