#include "pendula/kernels/flip_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pendula/kernels/catalog_rows.hpp"
#include "pendula/kernels/ensemble.hpp"
#include "pendula/scalar/whole_turns.hpp"

namespace pendula {

namespace {

constexpr double pi = 3.141592653589793, rest_of_pi = 1.2246467991473532e-16;
constexpr double undecided = 1e-12;  // of the energy: nearer to the least that a flip needs, the run decides
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t dimension = 4;

std::vector<double> energies_at_rest(const system_description& system, std::span<const double> given) {
  std::vector<double> states(given.begin(), given.end());
  const std::size_t count = states.size() / dimension;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      double& angle = states[dimension * i + j];
      angle = within_range_of_sine(angle);
    }
  std::vector<double> kinetic(count), potential(count);
  energies_of(system, states, kinetic.data(), potential.data());
  return potential;
}

// Where the energy of a start from rest is less than any flip asked for needs.
std::vector<std::uint8_t> forbidden_of(const flips_asked& asked, std::span<const double> starts) {
  std::vector<double> tops;
  if (asked.which != 2) tops.insert(tops.end(), {pi, 0.0, 0.0, 0.0});
  if (asked.which != 1) tops.insert(tops.end(), {0.0, pi, 0.0, 0.0});
  const double least = std::ranges::min(energies_at_rest(asked.system, tops));
  std::vector<std::uint8_t> forbidden;
  for (const double energy : energies_at_rest(asked.system, starts))
    forbidden.push_back(energy < (1.0 - undecided) * least);
  return forbidden;
}

struct first_flips {
  std::vector<double> time, end;  // and states at t_max where there is none
  std::vector<std::uint8_t> rod;
};

// The request that the runs of all cells have in common.
request request_of(const flips_asked& asked, double tolerance) {
  request run{asked.system, "taylor", std::vector<double>(dimension), 0.0, {asked.t_max}, false, {}, {}};
  run.options.tolerance = tolerance;
  for (const int rod : {1, 2})
    if (asked.which == 0 || asked.which == rod)
      run.events.push_back({event_kind::angle, rod - 1, pi, rest_of_pi, true, 0, 1});
  return run;
}

// Of the starts that are allowed; a fault, or false where `watch` ended it, stands in `to`.
first_flips run_cells(const request& run, std::span<const double> starts, const flips_found& cells, pool& workers,
                      const watcher& watch, flips_found& to) {
  const std::size_t count = cells.forbidden.size();
  first_flips found{std::vector<double>(count, nan), {starts.begin(), starts.end()}, std::vector<std::uint8_t>(count)};
  std::vector<std::size_t> places;
  std::vector<double> allowed;
  for (std::size_t i = 0; i < count; ++i)
    if (!cells.forbidden[i]) {
      places.push_back(i);
      allowed.insert(allowed.end(), starts.begin() + static_cast<std::ptrdiff_t>(dimension * i),
                     starts.begin() + static_cast<std::ptrdiff_t>(dimension * (i + 1)));
    }
  if (places.empty()) return found;
  const ensemble_rows rows{allowed, run.system.parameters, places.size(), dimension, 0};
  const ensemble_result result = run_ensemble(run, rows, {}, workers, watch);
  to.refused = result.refused;
  to.interrupted = result.interrupted;
  if (result.refused || result.interrupted) return found;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool broke_down = result.ended[i] == outcome::not_finite;
    for (std::size_t j = 0; j < dimension; ++j)
      found.end[dimension * places[i] + j] = broke_down ? nan : result.states[dimension * i + j];
  }
  for (std::size_t kind = 0; kind < run.events.size(); ++kind)
    for (std::size_t i = 0; i < result.events[kind].times.size(); ++i) {
      const std::size_t place = places[static_cast<std::size_t>(result.events[kind].trajectories[i])];
      found.time[place] = result.events[kind].times[i];
      found.rod[place] = static_cast<std::uint8_t>(run.events[kind].index + 1);
    }
  return found;
}

bool agree(const first_flips& a, const first_flips& b, std::size_t i) {
  if (a.rod[i] != b.rod[i]) return false;
  if (a.rod[i] != 0) return std::fabs(a.time[i] - b.time[i]) <= flip_agreement * a.time[i];
  const double *const ours = a.end.data() + dimension * i, *const theirs = b.end.data() + dimension * i;
  return std::fabs(ours[0] - theirs[0]) <= flip_agreement && std::fabs(ours[1] - theirs[1]) <= flip_agreement;
}

}  // namespace

std::vector<double> cell_centres(double lo, double hi, std::int64_t count, std::int64_t start, std::int64_t stop) {
  std::vector<double> centres;
  const double n = static_cast<double>(count);
  for (std::int64_t i = start; i < stop; ++i)
    centres.push_back(0.5 * (lo + hi) + (hi - lo) * ((2.0 * static_cast<double>(i) + 1.0 - n) / (2.0 * n)));
  return centres;
}

std::vector<double> cell_starts(std::span<const double> theta1, std::span<const double> theta2) {
  std::vector<double> states;
  states.reserve(dimension * theta1.size() * theta2.size());
  for (const double first : theta1)
    for (const double second : theta2) {
      const bool image = first < 0.0 || (first == 0.0 && second < 0.0);
      states.insert(states.end(), {image ? -first : first, image ? -second : second, 0.0, 0.0});
    }
  return states;
}

flips_found find_flips(const flips_asked& asked, std::span<const double> starts, pool& workers, const watcher& watch) {
  flips_found cells;
  cells.forbidden = forbidden_of(asked, starts);
  const double share = asked.resolve ? 0.4 : 1.0;  // of the work: the second run takes smaller steps
  auto flips = run_cells(request_of(asked, asked.tolerance), starts, cells, workers, part_of(watch, 0.0, share), cells);
  if (asked.resolve && !cells.refused && !cells.interrupted) {
    const auto again = run_cells(request_of(asked, second_run_tolerance * asked.tolerance), starts, cells, workers,
                                 part_of(watch, share, 1.0), cells);
    for (std::size_t i = 0; i < cells.forbidden.size(); ++i)
      cells.resolved.push_back(cells.forbidden[i] || agree(flips, again, i));
  }
  cells.time = std::move(flips.time);
  cells.rod = std::move(flips.rod);
  return cells;
}

}  // namespace pendula
