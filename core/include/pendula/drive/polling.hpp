// How often a run asks whether to go on: every few milliseconds, in steps of what each drive takes about as long for.
#pragma once

#include <chrono>
#include <cstdint>

namespace pendula {

// What can look at a clock, as it takes longer than that between two looks or waits anyway.
inline constexpr auto between_looks = std::chrono::milliseconds(50);

inline constexpr std::int64_t fixed_steps_between_polls = std::int64_t{1} << 14;  // 0.1 µs a step
inline constexpr std::int64_t adaptive_steps_between_polls = 2048;                // 1 µs to 2 µs a step
inline constexpr std::int64_t many_digit_steps_between_polls = 1;                 // milliseconds a step
inline constexpr std::int64_t lane_steps_between_polls = 1024;                    // 2 µs to 4 µs for all lanes
inline constexpr std::int64_t shadow_steps_between_polls = 256;                   // 10 µs a step
inline constexpr std::int64_t certified_steps_between_polls = 4096;               // of fixed step, beside a shadow

}  // namespace pendula
