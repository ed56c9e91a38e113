// The catalogue as plain data, and the physics of its systems over arrays, for those who do not see the templates.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pendula/description.hpp"
#include "pendula/kernels/request.hpp"

namespace pendula {

struct system_row {
  std::string_view name;
  std::span<const component> components;
  std::span<const form> forms;
  capabilities can;
  std::size_t degrees_of_freedom;
};
std::span<const system_row> system_rows();
const system_row* system_named(std::string_view name);  // null: there is none

struct method_row {
  std::string_view name;
  int order;
  int evaluations_per_step;  // 0: it iterates
  bool adaptive, symplectic;
  facet needs;
  std::vector<std::string_view> systems;  // that it takes
  std::string_view source;
  std::vector<double> stability_polynomial;  // coefficients from the lowest power on; empty: it has none
};
std::span<const method_row> method_rows();
const method_row* method_named(std::string_view name);
bool takes_system(const method_row&, std::string_view system);

// The order of the series that the Taylor method takes.
int series_order(const run_options&);

// The numbers that the equations of a described system are written in, and its scales.
struct system_numbers {
  std::vector<constant<double>> constants;
  double energy_scale, largest_frequency;  // J; of small oscillations and of what drives them, rad/s
  bool sticks;                             // dry friction can hold a joint
};
system_numbers numbers_of(const system_description&);

// Of states (n, d) one after the other.
void rhs_of(const system_description&, double t, std::span<const double> states, double* slopes);
void energies_of(const system_description&, std::span<const double> states, double* kinetic, double* potential);
void positions_of(const system_description&, std::span<const double> states, double* positions);  // (n, d/2, 2)

}  // namespace pendula
