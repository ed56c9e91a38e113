// What is wrong with a request, as data: argument, rule, value and way out. Each binding makes its own sentence of it,
// in its own names and language.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace pendula {

using fault_value = std::variant<std::monostate, double, std::int64_t, std::string, std::vector<std::string>>;

struct fault {
  std::string argument;   // of the request, as Python names it: "step", "state", a parameter
  std::string_view rule;  // a key of rule_rows()
  fault_value value;      // what was given
  std::vector<std::pair<std::string_view, fault_value>> details;  // what else the sentences name
};

// The sentences of a rule, after the argument's name, and the way out. {value} and other names in braces stand for the
// value and the details; <name> for the argument of that name, <name=value> for how it is given that value.
struct rule_row {
  std::string_view key;
  std::string_view english, way_out_in_english;
  std::string_view spanish, way_out_in_spanish;
};
std::span<const rule_row> rule_rows();

}  // namespace pendula
