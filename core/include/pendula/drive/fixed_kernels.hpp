// Runs of one trajectory with the methods of fixed step, compiled once for all who make them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace pendula_kernels {

struct fixed_request {
  std::string_view system;  // of the catalogue, with its form and parameters
  std::size_t form;
  const double* parameters;
  std::string_view method;
  const double* state;
  double step;  // negative: backward
  std::int64_t step_limit;
};

// An output: the state after so many whole steps and, where `rest` is not 0, one of that length.
struct fixed_place {
  std::int64_t steps;
  double rest;
};

struct fixed_receiver {
  // The state at a place, by its number; false ends what `each_step` does.
  virtual bool output(std::size_t place, const double* y) = 0;
  virtual bool go_on(std::int64_t steps) = 0;

 protected:
  ~fixed_receiver() = default;
};

struct fixed_outcome {
  std::uint8_t ended;  // a `pendula::outcome`
  std::size_t outputs;
  std::int64_t steps, evaluations;
};

struct fixed {
  // States at the places, whose steps do not decrease.
  fixed_outcome (*run)(const fixed_request&, std::span<const fixed_place>, fixed_receiver&);
  // States after the steps 1, 2 … and, where the last place is off the grid, there: its number is one more.
  void (*each_step)(const fixed_request&, fixed_place last, fixed_receiver&);
};

// For one trajectory any machine is as good as another.
extern const fixed fixed_plain;

}  // namespace pendula_kernels
