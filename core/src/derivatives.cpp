#include "pendula/kernels/derivatives.hpp"

#include <algorithm>

namespace pendula {

namespace {

constexpr std::size_t lanes_of_changes = derived_at_once;

// Puts the columns of one run beside those of the others; the first one tells the run itself.
struct gatherer final : derivative_receiver {
  gatherer(const request& asked, std::span<const double> outputs, run_derivatives& to, std::size_t columns,
           const watcher& watch)
      : asked(asked), outputs(outputs), to(to), columns(columns), watch(watch), events_told(asked.events.size()) {}

  void output(const derived_step& step, double tau) override {
    std::vector<double> values(asked.state.size()), changes(asked.state.size() * lanes_of_changes);
    step.at(tau, values.data(), changes.data());
    output(values, changes);
  }
  void output(const std::vector<double>& values, const std::vector<double>& changes) {
    if (first == 0) {
      to.run.times.push_back(outputs[outputs_told]);
      to.run.states.insert(to.run.states.end(), values.begin(), values.end());
    }
    put(to.states, outputs_told++, asked.state.size(), changes.data());
  }
  void event(int place, double t, const double* state, const double* of_time, const double* of_state) override {
    if (first == 0) {
      crossings& found = to.run.events[static_cast<std::size_t>(place)];
      found.times.push_back(t);
      found.states.insert(found.states.end(), state, state + asked.state.size());
    }
    crossing_derivatives& mine = to.events[static_cast<std::size_t>(place)];
    const std::size_t row = events_told[static_cast<std::size_t>(place)]++;
    put(mine.times, row, 1, of_time);
    put(mine.states, row, asked.state.size(), of_state);
  }
  bool go_on(double t) override {
    return going_on = watch((static_cast<double>(first) + (t - asked.t0) / (asked.end() - asked.t0)) /
                            static_cast<double>(columns));
  }

  void put(std::vector<double>& all, std::size_t row, std::size_t components, const double* changes) const {
    const std::size_t begin = row * components * columns;
    all.resize(std::max(all.size(), begin + components * columns));
    for (std::size_t i = 0; i < components; ++i)
      std::copy_n(changes + i * lanes_of_changes, std::min(lanes_of_changes, columns - first),
                  all.begin() + static_cast<std::ptrdiff_t>(begin + i * columns + first));
  }

  const request& asked;
  std::span<const double> outputs;
  run_derivatives& to;
  std::size_t columns;
  const watcher& watch;
  std::vector<std::size_t> events_told;
  std::size_t first = 0, outputs_told = 0;
  bool going_on = true;
};

}  // namespace

run_derivatives derivatives_of(const request& asked, std::span<const double> outputs,
                               std::span<const derived_by> columns, const watcher& watch) {
  run_derivatives result;
  result.events.resize(asked.events.size());
  result.run.events.resize(asked.events.size());
  result.run.reached = asked.t0;
  gatherer to(asked, outputs, result, columns.size(), watch);
  for (; to.first < columns.size() && to.going_on; to.first += lanes_of_changes) {
    const auto some = columns.subspan(to.first, std::min(lanes_of_changes, columns.size() - to.first));
    to.outputs_told = 0;
    std::ranges::fill(to.events_told, 0);
    std::vector<double> changes((asked.state.size() + asked.system.parameters.size()) * lanes_of_changes);
    for (std::size_t column = 0; column < some.size(); ++column)
      changes[some[column] * lanes_of_changes + column] = 1.0;
    std::size_t at_start = 0;
    for (; at_start < outputs.size() && outputs[at_start] == asked.t0; ++at_start) to.output(asked.state, changes);
    if (asked.end() == asked.t0) continue;
    const run_end end = best_derivative_kernel().run(asked, outputs.subspan(at_start), changes, to);
    result.run.ended = end.ended;
    result.run.steps = end.steps;
    result.run.evaluations = end.evaluations;
    result.run.reached = end.reached;
  }
  result.interrupted = !to.going_on;
  return result;
}

}  // namespace pendula
