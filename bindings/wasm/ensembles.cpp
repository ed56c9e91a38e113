// Many runs through lanes, and the cells of a flip map.
#include "exchange.hpp"
#include "pendula/kernels/catalog_rows.hpp"
#include "pendula/kernels/ensemble.hpp"
#include "pendula/kernels/flip_map.hpp"
#include "pendula/kernels/variations.hpp"

using namespace pendula_wasm;

namespace {

// The rows of an ensemble: its states (n, d) and parameters (n, p), none: the request's own for all.
pendula::ensemble_rows rows_of(reader& from, const pendula::request& run) {
  const auto states = from.list(), parameters = from.list();
  const std::size_t d = run.state.size(), count = d == 0 ? 0 : states.size() / d;
  const bool own = !parameters.empty();
  return {states, own ? parameters : std::span<const double>(run.system.parameters), count, d,
          own ? run.system.parameters.size() : 0};
}

int told(const pendula::ensemble_result& found) {
  if (found.refused) return refused(found.refused);
  answer_with(found.ended);
  answer_with(found.steps);
  answer_with(found.reached);
  answer_with(found.states);
  answer_with(found.trust_horizon);
  for (const auto& each : found.events) {
    answer_with(each.trajectories);
    answer_with(each.times);
    answer_with(each.states);
  }
  return 0;
}

}  // namespace

PENDULA_EXPORT(ensemble) {
  auto from = asked();
  const auto run = from.request();
  const auto rows = rows_of(from, run);
  const auto alone = pendula::caller_alone();
  return told(pendula::run_ensemble(run, rows, {}, *alone, to_the_end));
}

PENDULA_EXPORT(varied) {
  auto from = asked();
  const auto run = from.request();
  const auto rows = rows_of(from, run);
  const auto use = static_cast<pendula::variation_use>(from.place(3));
  const auto start = from.list();
  if (const auto wrong = pendula::check_of_doubles(run)) return refused(wrong);
  const std::size_t count = start.size() / rows.dimension;
  if (count < 1 || count > std::min(rows.dimension, pendula::most_variations) || start.size() % rows.dimension != 0)
    pendula::wrong_call("no such variations");
  const pendula::varied_by by{use, count, {start.begin(), start.end()}};
  const auto alone = pendula::caller_alone();
  return told(pendula::run_varied(run, by, rows, *alone, to_the_end));
}

PENDULA_EXPORT(flip_cells) {
  auto from = asked();
  pendula::flips_asked cells{from.system(), 0.0, 0.0, 0, false};
  cells.t_max = from.number();
  cells.tolerance = from.number();
  cells.which = static_cast<int>(from.place(3));
  cells.resolve = from.flag();
  std::vector<double> centres[2];
  for (auto& each : centres) {
    const double lo = from.number(), hi = from.number();
    const auto count = from.whole(), start = from.whole(), stop = from.whole();
    each = pendula::cell_centres(lo, hi, count, start, stop);
  }
  if (const auto wrong = pendula::check(cells.system)) return refused(wrong);
  if (!pendula::system_named(cells.system.name)->can.mapped) pendula::wrong_call("no maps are made of this system");
  const auto alone = pendula::caller_alone();
  const auto starts = pendula::cell_starts(centres[0], centres[1]);
  const auto found = pendula::find_flips(cells, starts, *alone, to_the_end);
  if (found.refused) return refused(found.refused);
  answer_with(centres[0]);
  answer_with(centres[1]);
  answer_with(found.time);
  answer_with(found.rod);
  answer_with(found.forbidden);
  answer_with(found.resolved);
  return 0;
}
