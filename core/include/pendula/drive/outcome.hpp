// How a run ended is a value, never an exception from inside the loop.
#pragma once

#include <cstdint>
#include <string_view>

namespace pendula {

enum class outcome : std::uint8_t { reached_end, event, step_limit, not_finite, interrupted };

constexpr std::string_view name_of(outcome o) {
  switch (o) {
    case outcome::reached_end:
      return "reached_end";
    case outcome::event:
      return "event";
    case outcome::step_limit:
      return "step_limit";
    case outcome::not_finite:
      return "not_finite";
    case outcome::interrupted:
      return "interrupted";
  }
  return "";
}

}  // namespace pendula
