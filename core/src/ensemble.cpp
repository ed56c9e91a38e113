// Ensembles of any method, through the lanes of this processor.
#include "pendula/kernels/ensemble.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pendula/kernels/check.hpp"
#include "pendula/kernels/horizon.hpp"
#include "pendula/kernels/variations.hpp"
#include "pendula/system/double_pendulum.hpp"

namespace pendula {

namespace {

struct found_event {
  std::size_t trajectory;
  int place;
  double t;
  std::size_t state;  // where it begins among the worker's states
};

// Writes the results of one worker; every trajectory has its own place in the arrays.
struct worker final : ensemble_receiver {
  worker(shared_work& work, ensemble_result& to, std::size_t outputs, std::size_t dimension)
      : work(&work), to(&to), outputs(outputs), dimension(dimension) {}

  std::size_t next() override { return work->next(); }
  void output(std::size_t trajectory, std::size_t place, const double* y) override {
    std::copy_n(y, dimension,
                to->states.begin() + static_cast<std::ptrdiff_t>((trajectory * outputs + place) * dimension));
  }
  void event(std::size_t trajectory, int place, double t, const double* y) override {
    events.push_back({trajectory, place, t, event_states.size()});
    event_states.insert(event_states.end(), y, y + dimension);
  }
  void finish(std::size_t trajectory, const run_end& end) override {
    to->ended[trajectory] = end.ended;
    to->steps[trajectory] = end.steps;
    to->evaluations[trajectory] = end.evaluations;
    to->reached[trajectory] = end.reached;
    work->done();
  }
  bool go_on() override { return work->go_on(); }

  shared_work* work;
  ensemble_result* to;
  std::size_t outputs, dimension;
  std::vector<found_event> events;
  std::vector<double> event_states;
};

// One trajectory of an ensemble, as a run of its own reports it.
struct one_trajectory final : receiver {
  one_trajectory(ensemble_receiver& to, std::size_t trajectory) : to(to), trajectory(trajectory) {}

  bool output(std::size_t place, double, const double* y) override {
    to.output(trajectory, place, y);
    return true;
  }
  void event(int place, double t, const double* y) override { to.event(trajectory, place, t, y); }
  bool step(const step_motion&) override { return true; }
  bool go_on(double) override { return to.go_on(); }

  ensemble_receiver& to;
  std::size_t trajectory;
};

// The request of one trajectory alone.
void take_row(const ensemble_rows& rows, std::size_t n, request& one) {
  one.state.assign(rows.state_of(n), rows.state_of(n) + rows.dimension);
  one.system.parameters.assign(rows.parameters_of(n), rows.parameters_of(n) + one.system.parameters.size());
}

void run_one_by_one(const request& asked, const ensemble_rows& rows, ensemble_receiver& to) {
  request one = asked;
  for (std::size_t n; (n = to.next()) != no_more_work;) {
    take_row(rows, n, one);
    one_trajectory report(to, n);
    to.finish(n, kernel_for(one).solve(one, report));
  }
}

void run_share(const request& asked, const ensemble_rows& rows, ensemble_receiver& to) {
  const bool ends_where_it_begins = asked.end() == asked.t0;
  const auto kernels = lanes_kernels_for(asked);
  for (auto widest = kernels.rbegin(); !ends_where_it_begins && widest != kernels.rend(); ++widest)
    if ((*widest)->run(asked, rows, to)) return;
  run_one_by_one(asked, rows, to);
}

// The crossings of each event, by trajectory and time.
std::vector<crossings> by_event(const std::vector<worker>& workers, std::size_t kinds, std::size_t dimension) {
  struct place {
    const worker* from;
    const found_event* event;
  };
  std::vector<crossings> all(kinds);
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    std::vector<place> mine;
    for (const worker& each : workers)
      for (const found_event& event : each.events)
        if (event.place == static_cast<int>(kind)) mine.push_back({&each, &event});
    std::ranges::stable_sort(mine, {}, [](const place& p) { return p.event->trajectory; });
    for (const place& p : mine) {
      const double* const y = p.from->event_states.data() + p.event->state;
      all[kind].trajectories.push_back(static_cast<std::int64_t>(p.event->trajectory));
      all[kind].times.push_back(p.event->t);
      all[kind].states.insert(all[kind].states.end(), y, y + dimension);
    }
  }
  return all;
}

// There is room for outputs at the same times alone, and each row has its components and its parameters.
std::optional<fault> check_rows(const request& asked, const ensemble_rows& rows) {
  const std::size_t parameters = asked.system.parameters.size();
  const bool fit = rows.dimension == asked.state.size() && rows.states.size() == rows.count * rows.dimension &&
                   (rows.parameters_apart == 0 || rows.parameters_apart == parameters) &&
                   rows.parameters.size() == (rows.parameters_apart == 0 ? 1 : rows.count) * parameters;
  if (asked.own_steps) return fault{"t", "one_end", static_cast<std::int64_t>(rows.count), {}};
  if (!fit)
    return fault{"states",
                 "rows",
                 static_cast<std::int64_t>(rows.states.size()),
                 {{"count", static_cast<std::int64_t>(rows.count)}}};
  return {};
}

// The trust horizon of each run; false where `watch` ended it.
bool find_horizons(const request& asked, const ensemble_rows& rows, pool& workers, const watcher& watch,
                   ensemble_result& result) {
  result.trust_horizon.assign(rows.count, std::numeric_limits<double>::quiet_NaN());
  return workers.share_out(rows.count, watch, [&](std::size_t, shared_work& work) {
    request one = asked;
    for (std::size_t n; (n = work.next()) != no_more_work; work.done()) {
      take_row(rows, n, one);
      const watcher going_on = [&](double) { return work.go_on(); };
      const auto found = trust_horizon(one, result.reached[n], result.ended[n], going_on);
      if (found) result.trust_horizon[n] = *found;
    }
  });
}

// The derivatives of the runs one by one; false where `watch` ended them.
bool find_derivatives(const request& asked, const ensemble_rows& rows, std::span<const derived_by> columns,
                      pool& workers, const watcher& watch, ensemble_result& result) {
  const std::size_t of_one = asked.times.size() * rows.dimension * columns.size();
  result.derivatives.assign(rows.count * of_one, std::numeric_limits<double>::quiet_NaN());
  request alone = asked;
  alone.events.clear();
  return workers.share_out(rows.count, watch, [&](std::size_t, shared_work& work) {
    request one = alone;
    for (std::size_t n; (n = work.next()) != no_more_work; work.done()) {
      take_row(rows, n, one);
      const watcher going_on = [&](double) { return work.go_on(); };
      const auto found = derivatives_of(one, one.times, columns, going_on);
      std::ranges::copy(found.states, result.derivatives.begin() + static_cast<std::ptrdiff_t>(n * of_one));
    }
  });
}

// Room for n runs with so many numbers at each output.
ensemble_result room_for(std::size_t n, std::size_t outputs, std::size_t size) {
  ensemble_result result;
  result.ended.resize(n);
  result.steps.resize(n);
  result.evaluations.resize(n);
  result.reached.resize(n);
  result.states.assign(n * outputs * size, std::numeric_limits<double>::quiet_NaN());
  return result;
}

// Derivatives by components of the start are variations, which go through lanes.
ensemble_result run_with_variations(const request& asked, const ensemble_rows& rows,
                                    std::span<const derived_by> columns, pool& workers, const watcher& watch) {
  const std::size_t d = rows.dimension, k = columns.size();
  varied_by by{variation_use::free, k, std::vector<double>(k * d)};
  for (std::size_t column = 0; column < k; ++column) by.start[column * d + columns[column]] = 1.0;
  ensemble_result result = run_varied(asked, by, rows, workers, watch);
  const std::size_t size = by.output_size(d), places = result.states.size() / size;
  const std::vector<double> told = std::move(result.states);
  result.states.resize(places * d);
  result.derivatives.resize(places * d * k);
  for (std::size_t place = 0; place < places; ++place) {
    const double* const from = told.data() + place * size;
    std::copy_n(from, d, result.states.begin() + static_cast<std::ptrdiff_t>(place * d));
    for (std::size_t column = 0; column < k; ++column) {
      const double* const variation = from + d + (d + 1) * column;
      for (std::size_t i = 0; i < d; ++i) {
        double& derivative = result.derivatives[(place * d + i) * k + column];
        derivative = variation[i];
        for (double times = 0.0; times < variation[d]; ++times) derivative *= taken_off;
      }
    }
  }
  return result;
}

bool are_variations(const request& asked, const ensemble_rows& rows, std::span<const derived_by> columns) {
  const bool in_lanes = asked.system.name == double_pendulum::name && asked.events.empty();
  return !columns.empty() && in_lanes && !asked.options.certify && asked.end() != asked.t0 &&
         std::ranges::all_of(columns, [&](derived_by column) { return column < rows.dimension; });
}

ensemble_result run_apart(const request& asked, const ensemble_rows& rows, std::span<const derived_by> columns,
                          pool& workers, const watcher& watch) {
  const std::size_t n = rows.count, outputs = asked.times.size();
  ensemble_result result = room_for(n, outputs, rows.dimension);
  const bool certified = asked.options.certify.has_value();
  const double plain = certified ? plain_share : columns.empty() ? 1.0 : derived_share;
  std::vector<std::vector<worker>> used(workers.workers());
  const bool complete = workers.share_out(n, part_of(watch, 0.0, plain), [&](std::size_t i, shared_work& work) {
    run_share(asked, rows, used[i].emplace_back(work, result, outputs, rows.dimension));
  });
  std::vector<worker> all;
  for (auto& each : used) std::ranges::move(each, std::back_inserter(all));
  result.events = by_event(all, asked.events.size(), rows.dimension);
  const double horizons = columns.empty() ? 1.0 : certified ? 0.9 : plain;
  const watcher of_horizons = part_of(watch, plain, horizons), of_derivatives = part_of(watch, horizons, 1.0);
  result.interrupted = !complete || (certified && !find_horizons(asked, rows, workers, of_horizons, result)) ||
                       (!columns.empty() && !find_derivatives(asked, rows, columns, workers, of_derivatives, result));
  return result;
}

}  // namespace

ensemble_result run_varied(const request& asked, const varied_by& by, const ensemble_rows& rows, pool& workers,
                           const watcher& watch) {
  const std::size_t size = by.output_size(rows.dimension), outputs = asked.times.size();
  ensemble_result result = room_for(rows.count, outputs, size);
  result.interrupted = !workers.share_out(rows.count, watch, [&](std::size_t, shared_work& work) {
    worker to(work, result, outputs, size);
    if (variation_kernel_for(rows.count).run(asked, by, rows, to)) return;
    request one = asked;
    one.events.clear();
    for (std::size_t n; (n = to.next()) != no_more_work;) {
      take_row(rows, n, one);
      vary_alone(one, by, to, n);
    }
  });
  return result;
}

ensemble_result run_ensemble(const request& asked, const ensemble_rows& rows, std::span<const derived_by> columns,
                             pool& workers, const watcher& watch) {
  auto refused = check_of_doubles(asked);
  if (!refused) refused = check_rows(asked, rows);
  if (refused) {
    ensemble_result result;
    result.refused = refused;
    return result;
  }
  if (are_variations(asked, rows, columns)) return run_with_variations(asked, rows, columns, workers, watch);
  return run_apart(asked, rows, columns, workers, watch);
}

}  // namespace pendula
