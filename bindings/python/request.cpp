// What to run, and what is wrong with it.
#include "request.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "pendula/kernels/check.hpp"
#include "pendula/kernels/options.hpp"

using namespace pendula_python;
using namespace nb::literals;
using pendula::event, pendula::fault, pendula::request, pendula::system_description;

namespace {

nb::dict details_of(const fault& found) {
  nb::dict details;
  for (const auto& [name, value] : found.details) details[text(name)] = nb::cast(value);
  return details;
}

nb::list rule_rows() {
  nb::list rows;
  for (const pendula::rule_row& row : pendula::rule_rows())
    rows.append(nb::make_tuple(text(row.key), text(row.english), text(row.way_out_in_english), text(row.spanish),
                               text(row.way_out_in_spanish)));
  return rows;
}

nb::list option_rows() {
  nb::list rows;
  for (const pendula::option_row& row : pendula::option_rows()) {
    nb::dict told;
    told["name"] = text(row.name);
    told["unit"] = text(row.unit);
    told["whole"] = row.whole;
    told["least"] = row.least;
    told["most"] = row.most;
    told["example"] = row.example;
    told["taken_by"] = text(pendula::taken_by_names[static_cast<std::size_t>(row.by)]);
    told["meaning"] = text(row.meaning);
    told["otherwise"] = text(row.otherwise);
    rows.append(told);
  }
  return rows;
}

void make_request(request* place, system_description system, std::string method, const array_in& state, double t0,
                  const array_in& times, bool own_steps, std::vector<event> events, std::optional<double> step,
                  std::optional<double> tolerance, std::optional<double> certify, std::optional<std::int64_t> max_steps,
                  std::optional<std::int64_t> digits) {
  const auto copied = [](const array_in& a) { return std::vector<double>(a.data(), a.data() + a.shape(0)); };
  new (place) request{std::move(system),
                      std::move(method),
                      copied(state),
                      t0,
                      copied(times),
                      own_steps,
                      {step, tolerance, certify, max_steps, digits},
                      std::move(events)};
}

void bind_faults(nb::module_& m) {
  nb::class_<fault>(m, "Fault", "What is wrong with a request: argument, rule, value and details.")
      .def_ro("argument", &fault::argument, "Name of the argument.")
      .def_ro("rule", &fault::rule, "Key of the rule, of `rule_rows`.")
      .def_ro("value", &fault::value, "What was given.")
      .def_prop_ro("details", &details_of, nb::sig("def details(self) -> dict[str, typing.Any]"),
                   "What else the sentences name.");
  m.def("rule_rows", &rule_rows, nb::sig("def rule_rows() -> list[tuple[str, str, str, str, str]]"),
        "Key, sentence and way out in English, sentence and way out in Spanish of each rule.");
  m.def("option_rows", &option_rows, nb::sig("def option_rows() -> list[dict[str, typing.Any]]"),
        "The options of a run.");
}

}  // namespace

void bind_request(nb::module_& m) {
  nb::class_<system_description>(m, "Description",
                                 "A system's name, the index of its form, and that form's parameters.")
      .def(nb::init<std::string, std::size_t, std::vector<double>>(), "system"_a, "form"_a, "parameters"_a);
  nb::class_<event>(m, "Event", "What to look for inside the steps of a run.")
      .def(
          "__init__",
          [](event* place, std::size_t kind, int index, double value, double value_tail, bool every_turn, int direction,
             std::int64_t terminal) {
            if (kind >= std::size(pendula::event_kind_names)) throw nb::value_error("no such kind of event");
            new (place) event{
                static_cast<pendula::event_kind>(kind), index, value, value_tail, every_turn, direction, terminal};
          },
          "kind"_a, "index"_a, "value"_a, "value_tail"_a, "every_turn"_a, "direction"_a, "terminal"_a);
  m.def(
      "event_kinds",
      [] {
        nb::list names;
        for (const auto name : pendula::event_kind_names) names.append(text(name));
        return names;
      },
      nb::sig("def event_kinds() -> list[str]"), "The kinds of events, by number.");
  nb::class_<request>(m, "Request", "What to run.")
      .def("__init__", &make_request, "system"_a, "method"_a, "state"_a, "t0"_a, "times"_a, "own_steps"_a = false,
           "events"_a = std::vector<event>{}, "step"_a = nb::none(), "tolerance"_a = nb::none(),
           "certify"_a = nb::none(), "max_steps"_a = nb::none(), "digits"_a = nb::none());
  bind_faults(m);
  m.def("check", nb::overload_cast<const request&>(&pendula::check), "request"_a, "The first fault of a request.");
  m.def("check_method", &pendula::check_method, "request"_a, "The first fault of a request's method and system.");
  m.def("check_options", &pendula::check_options, "request"_a,
        "The first fault of a request whose system, method, state and times are sound.");
  m.def("check_system", nb::overload_cast<const system_description&>(&pendula::check), "description"_a,
        "The first fault of a description.");
}
