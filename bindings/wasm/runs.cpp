// One run, a motion on a grid, and where its energy goes.
#include <list>
#include <ranges>

#include "exchange.hpp"
#include "pendula/kernels/balance.hpp"
#include "pendula/kernels/grid_motion.hpp"
#include "pendula/kernels/solve.hpp"

using namespace pendula_wasm;

namespace {

constexpr std::size_t most_motions = 12;  // a pendulum, its ghosts, a pair, and what was there before a change

struct known_motion {
  std::vector<double> asked;  // what it was asked for with
  pendula::grid_motion motion;
};

// The last motions that were asked for, the latest first.
pendula::grid_motion& motion_of(std::span<const double> asked, const pendula::request& run, double spacing) {
  static std::list<known_motion> known;
  const auto found = std::ranges::find_if(known, [&](const known_motion& each) {
    return std::ranges::equal(each.asked, asked, [](double a, double b) {
      return a == b || (a != a && b != b);  // NaN: an option not given
    });
  });
  if (found != known.end()) {
    known.splice(known.begin(), known, found);
  } else {
    known.push_front({{asked.begin(), asked.end()}, {run, spacing}});
    if (known.size() > most_motions) known.pop_back();
  }
  return known.front().motion;
}

}  // namespace

PENDULA_EXPORT(block) {
  auto from = asked();
  const auto run = from.request();
  const double spacing = from.number();
  auto& motion = motion_of(from.read(), run, spacing);
  const auto first = from.whole(), count = from.whole(), stride = from.whole();
  if (first < 0 || count < 0 || stride < 1) pendula::wrong_call("places of a grid rise from 0 on");
  auto &told = answer(), &states = answer();
  states.resize(static_cast<std::size_t>(count) * run.state.size());
  const auto found = motion.at(first, static_cast<std::size_t>(count), stride, states.data(), to_the_end);
  states.resize(found.count * run.state.size());
  told = {static_cast<double>(found.ended), static_cast<double>(found.steps), static_cast<double>(found.count)};
  return refused(found.refused);
}

PENDULA_EXPORT(solve) {
  auto from = asked();
  const auto found = pendula::solve(from.request(), to_the_end);
  if (found.refused) return refused(found.refused);
  answer() = {static_cast<double>(found.ended),       static_cast<double>(found.steps),
              static_cast<double>(found.evaluations), found.reached,
              found.trust_horizon ? 1.0 : 0.0,        found.trust_horizon.value_or(0.0)};
  answer_with(found.times);
  answer_with(found.states);
  answer_with(found.pieces.times);
  answer_with(found.pieces.senses);
  for (const auto& each : found.events) {
    answer_with(each.times);
    answer_with(each.states);
  }
  return 0;
}

PENDULA_EXPORT(balance) {
  auto from = asked();
  const auto run = from.request();
  if (const auto wrong = pendula::check_of_doubles(run)) return refused(wrong);
  if (run.own_steps) pendula::wrong_call("a balance needs output times");
  const auto found = pendula::balance_of(run, to_the_end);
  answer_with(found.parts);
  answer_with(found.net);
  answer_with(found.net_tails);
  return 0;
}
