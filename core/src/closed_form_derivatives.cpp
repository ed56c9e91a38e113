// Derivatives of the closed forms, over arrays.
#include "pendula/exact/closed_form_derivatives.hpp"

#include <algorithm>
#include <vector>

#include "pendula/kernels/closed_forms.hpp"

namespace pendula {

namespace {

using number = many_digit_dual;

// make(parameters, state): the motion over numbers of which at most `exact_derived_at_once` are derived by.
template <class Make>
bool derivatives(std::size_t parameters, const double* p, const double* state, std::span<const double> times,
                 std::span<const derived_by> columns, double* out, const watcher& watch, Make&& make) {
  for (std::size_t first = 0; first < columns.size(); first += exact_derived_at_once) {
    const auto some = columns.subspan(first, std::min<std::size_t>(exact_derived_at_once, columns.size() - first));
    std::vector<number> given;
    for (std::size_t i = 0; i < 2 + parameters; ++i) given.emplace_back(many_digits(i < 2 ? state[i] : p[i - 2]));
    for (std::size_t column = 0; column < some.size(); ++column)
      given[some[column]].change.set(static_cast<int>(column), 1);
    const auto motion = make(given.data() + 2, given.data());
    for (std::size_t n = 0; n < times.size(); ++n) {
      const auto of_state = motion.at(times[n]);
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t column = 0; column < some.size(); ++column)
          out[(2 * n + i) * columns.size() + first + column] =
              of_state[i][static_cast<int>(column)].template convert_to<double>();
      if (!watch(static_cast<double>(first) / static_cast<double>(columns.size()))) return false;
    }
  }
  return true;
}

}  // namespace

bool derivatives_of_simple(const double* p, const double* state, std::span<const double> times, double t0,
                           std::span<const derived_by> columns, double* out, const watcher& watch) {
  return derivatives(3, p, state, times, columns, out, watch, [t0](const number* of, const number* y) {
    return simple_with_derivatives(of[0], of[1], y[0], y[1], t0);
  });
}

bool derivatives_of_linear(const double* p, const double* state, std::span<const double> times, double t0,
                           std::span<const derived_by> columns, double* out, const watcher& watch) {
  return derivatives(3, p, state, times, columns, out, watch, [t0](const number* of, const number* y) {
    const number none(many_digits(0));
    return linear_with_derivatives({of[1] / of[0], none, none, none, none}, y[0], y[1], t0);
  });
}

bool derivatives_of_driven_linear(const double* p, const double* state, std::span<const double> times, double t0,
                                  std::span<const derived_by> columns, double* out, const watcher& watch) {
  return derivatives(7, p, state, times, columns, out, watch, [t0](const number* of, const number* y) {
    const number inertia = of[2] * of[0] * of[0];
    return linear_with_derivatives({of[1] / of[0], of[3] / inertia, of[4] / inertia, of[5], of[6]}, y[0], y[1], t0);
  });
}

}  // namespace pendula
