#include "pendula/kernels/grid_motion.hpp"

#include <algorithm>
#include <cmath>

#include "pendula/drive/fixed_grid.hpp"
#include "pendula/kernels/catalog_rows.hpp"
#include "pendula/kernels/check.hpp"
#include "pendula/kernels/solve.hpp"

namespace pendula {

namespace {

constexpr std::size_t most_kept = 64;
constexpr std::int64_t first_apart = 4096;   // steps: half a millisecond
constexpr std::int64_t first_places = 1024;  // that an adaptive run is made up to at once

}  // namespace

grid_motion::grid_motion(request run, double spacing) : run_(std::move(run)), spacing_(spacing), apart_(first_apart) {
  run_.own_steps = false;
  run_.events.clear();
  run_.options.max_steps.reset();
  run_.options.certify.reset();
}

std::optional<fault> grid_motion::check_up_to(std::int64_t place) {
  run_.times = {time(std::max<std::int64_t>(place, 1))};
  return check_of_doubles(run_);
}

grid_motion::part grid_motion::at(std::int64_t first, std::size_t count, std::int64_t stride, double* states,
                                  const watcher& watch) {
  part found;
  const std::int64_t last = first + static_cast<std::int64_t>(count > 0 ? count - 1 : 0) * stride;
  found.refused = check_up_to(last);
  if (found.refused || count == 0) return found;
  if (method_named(run_.method)->adaptive)
    of_adaptive(first, count, stride, states, watch, found);
  else
    of_fixed(first, count, stride, states, found);
  return found;
}

// A walk that took no more steps than that, and not many fewer.
grid_walk& grid_motion::walk_before(std::int64_t steps) {
  if (!front_) {
    front_ = kernel_for(run_).walk(run_);
    keep(*front_);
  }
  if (front_->steps() <= steps) {
    for (std::int64_t next; (next = front_->steps() / apart_ * apart_ + apart_) <= steps;) {
      if (!front_->go_to(next)) break;
      keep(*front_);
    }
    return *front_;
  }
  const auto after = std::ranges::upper_bound(kept_, steps, {}, [](const auto& each) { return each->steps(); });
  const grid_walk& nearest = **std::prev(after);
  if (!again_ || again_->steps() > steps || again_->steps() < nearest.steps()) again_ = nearest.copy();
  return *again_;
}

void grid_motion::keep(const grid_walk& walk) {
  if (kept_.size() == most_kept) {
    for (std::size_t i = 0; 2 * i < most_kept; ++i) kept_[i] = std::move(kept_[2 * i]);
    kept_.resize(most_kept / 2);
    apart_ *= 2;
    if (walk.steps() % apart_ != 0) return;
  }
  kept_.push_back(walk.copy());
}

void grid_motion::of_fixed(std::int64_t first, std::size_t count, std::int64_t stride, double* states, part& found) {
  const std::size_t d = run_.state.size();
  for (; found.count < count; ++found.count) {
    const fixed_output place =
        place_on_grid(time(first + static_cast<std::int64_t>(found.count) * stride), run_.t0, run_.signed_step());
    double* const y = states + found.count * d;
    grid_walk& walk = walk_before(place.steps);
    const bool there = walk.go_to(place.steps);
    if (there) walk.state(place.rest, y);
    if (!there || !std::all_of(y, y + d, [](double x) { return std::isfinite(x); })) {
      found.ended = outcome::not_finite;
      break;
    }
  }
  found.steps = front_->steps();
}

// Makes the run up to the place, and twice as far as before so that going on piece by piece costs no more than twice.
std::optional<fault> grid_motion::reach(std::int64_t place, const watcher& watch) {
  const bool broken = known_places_ > 0 && known_.ended != outcome::reached_end;
  if (place <= known_places_ || broken) return {};
  for (const std::int64_t places : {std::max(2 * known_places_, std::max(place, first_places)), place}) {
    if (auto refused = check_up_to(places)) {
      if (places == place) return refused;
      continue;
    }
    known_ = solve(run_, watch);
    known_places_ = places;
    break;
  }
  return {};
}

void grid_motion::of_adaptive(std::int64_t first, std::size_t count, std::int64_t stride, double* states,
                              const watcher& watch, part& found) {
  found.refused = reach(first + static_cast<std::int64_t>(count - 1) * stride, watch);
  if (found.refused) return;
  const double direction = spacing_ < 0.0 ? -1.0 : 1.0;
  std::vector<double> times;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = time(first + static_cast<std::int64_t>(i) * stride);
    if (t != run_.t0 && direction * t > direction * known_.reached) break;
    times.push_back(t);
  }
  found.count = times.size();
  found.steps = known_.steps;
  found.ended = times.size() == count ? outcome::reached_end : known_.ended;
  if (!times.empty() && !known_.dense->at(times, states, watch)) found.ended = outcome::interrupted;
}

}  // namespace pendula
