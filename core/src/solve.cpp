#include "pendula/kernels/solve.hpp"

#include <algorithm>
#include <cmath>

#include "pendula/kernels/catalog_rows.hpp"
#include "pendula/kernels/check.hpp"
#include "pendula/kernels/horizon.hpp"

namespace pendula {

double log2_of_tolerance(const run_options& options) {
  return std::nearbyint(std::log2(options.tolerance.value_or(best_tolerance)) * 1024.0) / 1024.0;
}

watcher part_of(const watcher& whole, double from, double to) {
  return [&whole, from, to](double done) { return whole(from + (to - from) * done); };
}

void step_starts::add(const step_motion& motion) {
  constexpr std::size_t most = std::size_t{1} << 14;  // 3 MB
  if ((counted_++ & (stride_ - 1)) != 0) return;
  if (size() == most) {
    for (std::size_t i = 0; 2 * i < most; ++i)
      std::copy_n(numbers_.data() + 2 * i * width_, width_, numbers_.data() + i * width_);
    numbers_.resize(most / 2 * width_);
    stride_ *= 2;
    if (((counted_ - 1) & (stride_ - 1)) != 0) return;
  }
  step_memory start;
  motion.remember(start);
  width_ = start.count;
  numbers_.insert(numbers_.end(), start.numbers.begin(), start.numbers.begin() + static_cast<std::ptrdiff_t>(width_));
}

step_memory step_starts::operator[](std::size_t i) const {
  step_memory start{{}, width_};
  std::copy_n(numbers_.data() + i * width_, width_, start.numbers.begin());
  return start;
}

namespace {

struct collector final : receiver {
  collector(const request& asked, run_result& to, const watcher& watch)
      : asked(asked), to(to), watch(watch), span(asked.end() - asked.t0) {}

  bool output(std::size_t, double t, const double* y) override {
    to.times.push_back(t);
    to.states.insert(to.states.end(), y, y + asked.state.size());
    return true;
  }
  void event(int place, double t, const double* y) override {
    crossings& mine = to.events[static_cast<std::size_t>(place)];
    mine.times.push_back(t);
    mine.states.insert(mine.states.end(), y, y + asked.state.size());
    last_event.assign(y, y + asked.state.size());
  }
  void piece(double t, std::span<const double> senses) override {
    to.pieces.times.push_back(t);
    to.pieces.senses.insert(to.pieces.senses.end(), senses.begin(), senses.end());
  }
  bool step(const step_motion& motion) override {
    starts.add(motion);
    return true;
  }
  bool go_on(double t) override { return watch(std::max((t - asked.t0) / span, found())); }

  // The part that is found of the events that end the run: where the end is infinitely late, all that is known.
  double found() const {
    double part = 0.0;
    for (std::size_t i = 0; i < asked.events.size(); ++i)
      if (const auto wanted = static_cast<double>(asked.events[i].terminal); wanted > 0.0)
        part = std::max(part, static_cast<double>(to.events[i].times.size()) / wanted);
    return part;
  }

  const request& asked;
  run_result& to;
  const watcher& watch;
  double span;
  step_starts starts;
  std::vector<double> last_event;
};

// Room for the outputs that are known to come: none is moved again.
void reserve(const request& asked, run_result& result) {
  const double step = asked.options.step.value_or(0.0);
  const double count = !asked.own_steps ? static_cast<double>(asked.times.size())
                       : step > 0.0     ? std::fabs(asked.end() - asked.t0) / step + 2.0
                                        : 0.0;
  result.times.reserve(static_cast<std::size_t>(count));
  result.states.reserve(static_cast<std::size_t>(count) * asked.state.size());
}

}  // namespace

run_result solve(const request& asked, const watcher& watch) {
  run_result result;
  result.refused = check_of_doubles(asked);
  if (result.refused) return result;
  const bool certified = asked.options.certify.has_value();
  result.events.resize(asked.events.size());
  reserve(asked, result);
  const watcher of_run = certified ? part_of(watch, 0.0, plain_share) : watch;
  collector to(asked, result, of_run);
  const run_kernel& kernel = kernel_for(asked);
  const run_end end = kernel.solve(asked, to);
  result.ended = end.ended;
  result.steps = end.steps;
  result.evaluations = end.evaluations;
  result.reached = end.reached;
  if (end.ended != outcome::event) to.last_event.clear();
  if (kernel.revisit)
    result.dense = std::make_shared<dense_output>(asked, std::move(to.starts), end.reached, std::move(to.last_event));
  if (certified && end.ended != outcome::interrupted) {
    result.trust_horizon = trust_horizon(asked, end.reached, end.ended, part_of(watch, plain_share, 1.0));
    if (!result.trust_horizon) result.ended = outcome::interrupted;
  }
  return result;
}

dense_output::dense_output(request run, step_starts starts, double reached, std::vector<double> last)
    : run_(std::move(run)), starts_(std::move(starts)), reached_(reached), last_(std::move(last)) {}

namespace {

struct writer final : receiver {
  writer(double* to, std::size_t dimension, const watcher& watch) : to(to), dimension(dimension), watch(watch) {}

  bool output(std::size_t, double, const double* y) override {
    to = std::copy_n(y, dimension, to);
    return true;
  }
  void event(int, double, const double*) override {}
  bool step(const step_motion&) override { return true; }
  bool go_on(double) override { return watch(0.0); }

  double* to;
  std::size_t dimension;
  const watcher& watch;
};

}  // namespace

bool dense_output::at(std::span<const double> times, double* states, const watcher& watch) const {
  const std::size_t d = run_.state.size();
  std::size_t count = times.size();
  for (; !last_.empty() && count > 0 && times[count - 1] == reached_; --count)
    std::ranges::copy(last_, states + d * (count - 1));
  const double direction = run_.direction();
  request part = run_;
  part.own_steps = false;
  for (std::size_t i = 0, from = 0; i < count;) {
    if (times[i] == run_.t0) {
      std::ranges::copy(run_.state, states + d * i++);
      continue;
    }
    while (from + 1 < starts_.size() && direction * starts_.time(from + 1) < direction * times[i]) ++from;
    std::size_t next = i + 1;
    const bool is_last = from + 1 == starts_.size();
    while (next < count && (is_last || direction * times[next] <= direction * starts_.time(from + 1))) ++next;
    part.times.assign(times.begin() + static_cast<std::ptrdiff_t>(i),
                      times.begin() + static_cast<std::ptrdiff_t>(next));
    writer to(states + d * i, d, watch);
    if (kernel_for(part).revisit(part, starts_[from], to).ended == outcome::interrupted) return false;
    i = next;
  }
  return true;
}

}  // namespace pendula
