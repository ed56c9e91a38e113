// One run, many runs, and runs with more digits than a double has.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <algorithm>

#include "arrays.hpp"
#include "interrupts.hpp"
#include "pendula/kernels/balance.hpp"
#include "pendula/kernels/check.hpp"
#include "pendula/kernels/derivatives.hpp"
#include "pendula/kernels/ensemble.hpp"
#include "pendula/kernels/horizon.hpp"
#include "pendula/kernels/long_runs.hpp"
#include "pendula/kernels/solve.hpp"
#include "pendula/kernels/variations.hpp"
#include "request.hpp"

using namespace pendula_python;
using namespace nb::literals;
using pendula::crossings, pendula::dense_output, pendula::energy_balance, pendula::ensemble_result,
    pendula::crossing_derivatives, pendula::motion_pieces, pendula::run_derivatives, pendula::request,
    pendula::run_result;

namespace {

// work() without the GIL; what Python raised meanwhile goes on.
template <class Work>
auto released(Work&& work) {
  nb::gil_scoped_release without;
  return work();
}

run_result complete(run_result result) {
  if (result.ended == pendula::outcome::interrupted) throw nb::python_error();
  return result;
}

run_result solve(const request& asked, nb::object progress) {
  const auto watch = watching(std::move(progress));
  return complete(released([&] { return pendula::solve(asked, watch); }));
}

run_result long_run(const request& asked, std::size_t level, nb::object progress) {
  const auto levels = pendula::long_runs();
  if (level >= levels.size() || pendula::check(asked)) throw nb::value_error("no such level, or not a sound request");
  const auto watch = watching(std::move(progress));
  return complete(released([&] { return levels[level].run(asked, watch); }));
}

std::vector<int> long_run_digits() {
  std::vector<int> digits;
  for (const auto& each : pendula::long_runs()) digits.push_back(each.decimal_digits);
  return digits;
}

double trust_horizon(const request& asked, nb::object progress) {
  if (!asked.options.certify || pendula::check(asked)) throw nb::value_error("not a sound request that is certified");
  const auto watch = watching(std::move(progress));
  const auto found =
      released([&] { return pendula::trust_horizon(asked, asked.end(), pendula::outcome::reached_end, watch); });
  if (!found) throw nb::python_error();
  return *found;
}

array_out dense_at(const dense_output& dense, const array_in& times, std::size_t dimension) {
  new_array states({times.shape(0), dimension});
  const auto watch = watching(nb::none());
  if (!released([&] { return dense.at(span_of(times), states.data, watch); })) throw nb::python_error();
  return states.array;
}

ensemble_result ensemble(const request& asked, const matrix_in& states, const matrix_in& parameters,
                         const std::vector<std::size_t>& columns, std::size_t threads, nb::object progress) {
  const pendula::ensemble_rows rows{span_of(states), span_of(parameters), states.shape(0), states.shape(1),
                                    parameters.shape(0) == 1 ? 0 : parameters.shape(1)};
  const auto watch = watching(std::move(progress));
  auto result = released([&] {
    const auto workers = pendula::threads(threads);
    return pendula::run_ensemble(asked, rows, columns, *workers, watch);
  });
  if (result.interrupted) throw nb::python_error();
  return result;
}

ensemble_result varied(const request& asked, std::string_view use, const matrix_in& variations, const matrix_in& states,
                       const matrix_in& parameters, std::size_t threads, nb::object progress) {
  const std::string_view uses[] = {"free", "megno", "orthogonal"};
  const auto found = std::ranges::find(uses, use);
  const std::size_t count = variations.shape(0), d = states.shape(1);
  const bool as_many = count >= 1 && count <= std::min(d, pendula::most_variations) && variations.shape(1) == d;
  if (found == std::end(uses) || !as_many || pendula::check(asked)) throw nb::value_error("no such variations");
  const auto given = span_of(variations);
  const pendula::varied_by by{static_cast<pendula::variation_use>(found - uses), count, {given.begin(), given.end()}};
  const pendula::ensemble_rows rows{span_of(states), span_of(parameters), states.shape(0), d,
                                    parameters.shape(0) == 1 ? 0 : parameters.shape(1)};
  const auto watch = watching(std::move(progress));
  auto result = released([&] {
    const auto workers = pendula::threads(threads);
    return pendula::run_varied(asked, by, rows, *workers, watch);
  });
  if (result.interrupted) throw nb::python_error();
  return result;
}

std::vector<std::string_view> outcomes(const ensemble_result& result) {
  std::vector<std::string_view> names;
  names.reserve(result.ended.size());
  for (const auto each : result.ended) names.push_back(pendula::name_of(each));
  return names;
}

nb::list outcome_names() {
  nb::list names;
  for (const auto each : {pendula::outcome::reached_end, pendula::outcome::event, pendula::outcome::step_limit,
                          pendula::outcome::not_finite})
    names.append(text(pendula::name_of(each)));
  return names;
}

energy_balance balance(const request& asked, nb::object progress) {
  if (asked.own_steps || pendula::check(asked)) throw nb::value_error("not a sound request with output times");
  const auto watch = watching(std::move(progress));
  auto result = released([&] { return pendula::balance_of(asked, watch); });
  if (result.interrupted) throw nb::python_error();
  return result;
}

run_derivatives derivatives(const request& asked, const array_in& outputs, const std::vector<std::size_t>& columns,
                            nb::object progress) {
  const std::size_t most = asked.state.size() + asked.system.parameters.size();
  if (pendula::check(asked) || std::ranges::any_of(columns, [=](std::size_t each) { return each >= most; }))
    throw nb::value_error("not a sound request, or derived by something it does not have");
  const auto watch = watching(std::move(progress));
  auto result = released([&] { return pendula::derivatives_of(asked, span_of(outputs), columns, watch); });
  if (result.interrupted) throw nb::python_error();
  return result;
}

void bind_derivatives(nb::module_& m) {
  nb::class_<crossing_derivatives>(m, "CrossingDerivatives", "How times and states of an event change.")
      .def(
          "times",
          [](const crossing_derivatives& c, std::size_t columns) {
            return view(c, c.times, {c.times.size() / columns, columns});
          },
          "columns"_a, "(k, columns).")
      .def(
          "states",
          [](const crossing_derivatives& c, std::size_t d, std::size_t columns) {
            return view(c, c.states, {c.states.size() / (d * columns), d, columns});
          },
          "dimension"_a, "columns"_a, "At the event, whose time changes too, (k, d, columns).");
  nb::class_<run_derivatives>(m, "RunDerivatives", "How a run changes with its start and with the parameters.")
      .def_prop_ro(
          "run", [](const run_derivatives& r) { return &r.run; }, nb::rv_policy::reference_internal,
          "The run itself, but for its pieces and its dense output.")
      .def(
          "states",
          [](const run_derivatives& r, std::size_t d, std::size_t columns) {
            return view(r, r.states, {r.states.size() / (d * columns), d, columns});
          },
          "dimension"_a, "columns"_a, "At the outputs, (n, d, columns).")
      .def_prop_ro("events", [](const run_derivatives& r) { return &r.events; }, nb::rv_policy::reference_internal);
  m.def("derivatives", &derivatives, "request"_a, "outputs"_a, "columns"_a, "progress"_a.none(),
        "Of the run, at output times of its own, by components of the start and, from their count on, parameters.");
}

void bind_balance(nb::module_& m) {
  nb::class_<energy_balance>(m, "EnergyBalance", "Work done on a system and heat that it gave off since t0 [J].")
      .def(
          "parts", [](const energy_balance& b, std::size_t powers) { return view(b, b.parts, {b.net.size(), powers}); },
          "powers"_a, "Of each power, (n, powers).")
      .def_prop_ro(
          "net", [](const energy_balance& b) { return view(b, b.net, {b.net.size()}); }, "Works less heats, (n,).")
      .def_prop_ro(
          "net_tails", [](const energy_balance& b) { return view(b, b.net_tails, {b.net.size()}); },
          "What they go on with, (n,).");
  m.def("balance", &balance, "request"_a, "progress"_a.none(), "Of the run, at the request's times.");
  m.def(
      "powers",
      [](std::string_view system) {
        const auto rows = pendula::powers_of(system);
        nb::list works, heats;
        for (std::size_t i = 0; i < rows.names.size(); ++i)
          (i < rows.works ? works : heats).append(text(rows.names[i]));
        return nb::make_tuple(works, heats);
      },
      "system"_a, nb::sig("def powers(system: str) -> tuple[list[str], list[str]]"),
      "Names of what does work on a system, and of what turns its energy into heat.");
}

void bind_results(nb::module_& m) {
  nb::class_<motion_pieces>(m, "Pieces", "When friction in a joint changed.")
      .def_prop_ro(
          "times", [](const motion_pieces& p) { return view(p, p.times, {p.times.size()}); }, "(k,) [s].")
      .def(
          "senses",
          [](const motion_pieces& p, std::size_t joints) { return view(p, p.senses, {p.times.size(), joints}); },
          "joints"_a, "Which way each joint slips from then on, 1 or -1, or 0: it sticks, (k, joints).");
  nb::class_<crossings>(m, "Crossings", "Times and states at which an event took place.")
      .def_prop_ro(
          "trajectories", [](const crossings& c) { return view(c, c.trajectories); }, "(k,), of an ensemble.")
      .def_prop_ro(
          "times", [](const crossings& c) { return view(c, c.times, {c.times.size()}); }, "(k,) [s].")
      .def(
          "states", [](const crossings& c, std::size_t d) { return view(c, c.states, {c.times.size(), d}); },
          "dimension"_a, "(k, d) [rad, rad/s].");
  nb::class_<dense_output>(m, "DenseOutput", "The motion inside the steps of a run that was made.")
      .def_prop_ro("reached", &dense_output::reached, "The time up to which the run was made [s].")
      .def("at", &dense_at, "times"_a, "dimension"_a, "States (n, d) at times (n,) in the direction of the run.");
  nb::class_<run_result>(m, "RunResult", "What came of one run.")
      .def_ro("refused", &run_result::refused, "The fault for which nothing was run; None: it was.")
      .def_prop_ro(
          "outcome", [](const run_result& r) { return pendula::name_of(r.ended); }, "How it ended.")
      .def_ro("n_steps", &run_result::steps)
      .def_ro("n_evaluations", &run_result::evaluations)
      .def_ro("reached", &run_result::reached, "The time up to which the run was made [s].")
      .def_prop_ro(
          "t", [](const run_result& r) { return view(r, r.times, {r.times.size()}); }, "(n,) [s].")
      .def(
          "states", [](const run_result& r, std::size_t d) { return view(r, r.states, {r.times.size(), d}); },
          "dimension"_a, "(n, d) [rad, rad/s].")
      .def(
          "tails", [](const run_result& r, std::size_t d) { return view(r, r.tails, {r.times.size(), d}); },
          "dimension"_a, "What the states go on with, of a run with many digits, (n, d).")
      .def_prop_ro(
          "events", [](const run_result& r) { return &r.events; }, nb::rv_policy::reference_internal)
      .def_prop_ro(
          "pieces", [](const run_result& r) { return &r.pieces; }, nb::rv_policy::reference_internal)
      .def_ro("trust_horizon", &run_result::trust_horizon, "[s]; None: not asked.")
      .def_ro("dense", &run_result::dense, "None: the method has none.");
}

}  // namespace

void bind_runs(nb::module_& m) {
  bind_results(m);
  bind_balance(m);
  bind_derivatives(m);
  nb::class_<ensemble_result>(m, "EnsembleResult", "What came of many runs.")
      .def_ro("refused", &ensemble_result::refused, "The fault for which nothing was run; None: they were.")
      .def_prop_ro("outcomes", &outcomes, "(n,): how each ended.")
      .def_prop_ro(
          "n_steps", [](const ensemble_result& r) { return view(r, r.steps); }, "(n,).")
      .def_prop_ro(
          "n_evaluations", [](const ensemble_result& r) { return view(r, r.evaluations); }, "(n,).")
      .def_prop_ro(
          "reached", [](const ensemble_result& r) { return view(r, r.reached, {r.reached.size()}); },
          "The time up to which each was made, (n,) [s].")
      .def(
          "states",
          [](const ensemble_result& r, std::size_t m, std::size_t d) {
            return view(r, r.states, {r.ended.size(), m, d});
          },
          "times"_a, "dimension"_a, "(n, m, d) [rad, rad/s]; NaN where a run did not come so far.")
      .def(
          "derivatives",
          [](const ensemble_result& r, std::size_t m, std::size_t d, std::size_t columns) {
            return view(r, r.derivatives, {r.ended.size(), m, d, columns});
          },
          "times"_a, "dimension"_a, "columns"_a, "Of the states, (n, m, d, columns).")
      .def_prop_ro(
          "events", [](const ensemble_result& r) { return &r.events; }, nb::rv_policy::reference_internal)
      .def_prop_ro(
          "trust_horizon", [](const ensemble_result& r) { return view(r, r.trust_horizon, {r.trust_horizon.size()}); },
          "(n,) [s]; empty: not asked.");
  m.def("solve", &solve, "request"_a, "progress"_a.none(), "The run that is asked for, checked.");
  m.def(
      "ensemble", &ensemble, "request"_a, "states"_a, "parameters"_a, "columns"_a, "threads"_a, "progress"_a.none(),
      "The runs from states (n, d) with parameters (n, p), or (1, p) for all, in place of the request's own, and their "
      "derivatives by components of the start and, from their count on, parameters.");
  m.def("varied", &varied, "request"_a, "use"_a, "variations"_a, "states"_a, "parameters"_a, "threads"_a,
        "progress"_a.none(),
        "The runs from states (n, d) with variations (k, d), "
        "free, for the MEGNO of the one, or made orthogonal; `states` tells of them, too.");
  m.def("trust_horizon", &trust_horizon, "request"_a, "progress"_a.none(),
        "The trust horizon of a run that reached its end; infinite: not within the run.");
  m.def("outcomes", &outcome_names, nb::sig("def outcomes() -> list[str]"), "How runs end, by number.");
  m.attr("largest_long_angle") = pendula::largest_long_angle;
  m.def("long_run_digits", &long_run_digits, "Decimal digits of the levels of `long_run`.");
  m.def("long_run", &long_run, "request"_a, "level"_a, "progress"_a.none(),
        "The run with the digits of a level: states and their tails at the request's times.");
}
