// Requests that make sense, for the tests of the plain interfaces to change one thing of.
#pragma once

#include <cmath>
#include <cstring>

#include "pendula/kernels/catalog_rows.hpp"
#include "pendula/kernels/result.hpp"

namespace requests {

using namespace pendula;

inline const watcher always = [](double) { return true; };
inline const watcher never = [](double) { return false; };

inline system_description described(std::string_view name, std::size_t form = 0) {
  system_description system{std::string(name), form, {}};
  for (const parameter& row : system_named(name)->forms[form].parameters)
    system.parameters.push_back(std::isnan(row.standard) ? 1.0 : row.standard);
  return system;
}

// From a motion that goes over the top, with two outputs.
inline request with_method(std::string_view method, std::string_view system) {
  request asked;
  asked.system = described(system);
  asked.method = method;
  asked.state.assign(system_named(system)->components.size(), 0.25);
  asked.state[0] = 2.0;
  asked.times = {0.3, 1.0};
  if (!method_named(method)->adaptive) asked.options.step = 0.01;
  return asked;
}
inline request adaptive() { return with_method("taylor", "double"); }
inline request fixed() { return with_method("rk4", "simple"); }

// Calls visit(method, system) for every pair that goes together.
template <class Visit>
void for_each_pair(Visit&& visit) {
  for (const method_row& method : method_rows())
    for (const std::string_view system : method.systems) visit(method, system);
}

inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

}  // namespace requests
