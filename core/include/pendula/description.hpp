// What is said of systems and methods in the catalogue: plain data, the same for every machine, which Python, the
// command line, the documentation and the tests read.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace pendula {

// Which numbers make sense as a parameter; all are finite.
enum class range : std::uint8_t { positive, not_negative, any };
inline constexpr std::string_view range_names[] = {"positive", "not_negative", "any"};

// A parameter's name, unit, range and sentence live in one row.
struct parameter {
  std::string_view name;
  std::string_view unit;  // SI
  double standard;        // taken where the user names none; NaN: has to be named
  range allowed;
  std::string_view meaning;       // one phrase, lower case
  std::string_view same_as = {};  // where it is not named it takes this parameter's value
};

template <std::size_t n, std::size_t m>
constexpr std::array<parameter, n + m> with_more(const std::array<parameter, n>& own,
                                                 const std::array<parameter, m>& more) {
  std::array<parameter, n + m> all{};
  for (std::size_t i = 0; i < n + m; ++i) all[i] = i < n ? own[i] : more[i - n];
  return all;
}

// One way to describe a system.
struct form {
  std::string_view name;  // empty where the system has one form only
  std::string_view meaning;
  std::span<const parameter> parameters;
};

struct component {  // of the state
  std::string_view name;
  std::string_view unit;
  double standard;
  std::string_view meaning;
};

// A number the equations are written in.
template <class S>
struct constant {
  std::string_view name;
  S value;
  bool may_vanish = false;  // or be negative: any finite value makes sense
};

// What a system can.
struct capabilities {
  bool conservative;  // its energy is constant
  bool autonomous;    // its equations do not depend on time
  bool closed_form;   // `exact` has its solution
  bool period;        // its motions have one, as a function of amplitude or state
  bool mapped;        // flip and divergence maps are made of it
  bool periodic;      // angles a whole turn apart are the same position: the equations take their sines
};

// What a method needs of a system (concepts.hpp, facets.hpp).
enum class facet : std::uint8_t { flow, energetic, mechanical, separable, analytic };
inline constexpr std::string_view facet_names[] = {"flow", "energetic", "mechanical", "separable", "analytic"};

inline constexpr double to_be_named = __builtin_nan("");
inline constexpr double standard_gravity = 9.80665;  // 3rd CGPM (1901), m/s²
inline constexpr parameter gravity_row{"gravity", "m/s^2", standard_gravity, range::positive,
                                       "gravitational acceleration"};

}  // namespace pendula
