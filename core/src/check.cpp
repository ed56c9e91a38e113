#include "pendula/kernels/check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "pendula/kernels/catalog_rows.hpp"
#include "pendula/kernels/options.hpp"

namespace pendula {

namespace {

using maybe = std::optional<fault>;
using names = std::vector<std::string>;

template <class Rows, class Pick>
names names_where(const Rows& rows, Pick&& pick) {
  names found;
  for (const auto& row : rows)
    if (pick(row)) found.emplace_back(row.name);
  return found;
}

maybe check_state(const request& asked) {
  const auto components = system_named(asked.system.name)->components;
  if (asked.state.size() != components.size())
    return fault{"state",
                 "count_of_components",
                 static_cast<std::int64_t>(asked.state.size()),
                 {{"count", static_cast<std::int64_t>(components.size())}}};
  for (std::size_t i = 0; i < asked.state.size(); ++i)
    if (!std::isfinite(asked.state[i]))
      return fault{"state", "all_finite", asked.state[i], {{"place", "state[" + std::to_string(i) + "]"}}};
  return {};
}

// The first times, as a sentence names them.
std::string shortened(const std::vector<double>& times) {
  std::string text = "[";
  for (std::size_t i = 0; i < std::min<std::size_t>(times.size(), 4); ++i) {
    char number[32];
    std::snprintf(number, sizeof number, i ? ", %g" : "%g", times[i]);
    text += number;
  }
  return text + (times.size() > 4 ? ", …]" : "]");
}

maybe check_times(const request& asked) {
  if (!std::isfinite(asked.t0)) return fault{"t0", "finite", asked.t0, {{"unit", "s"}}};
  const std::vector<double>& t = asked.times;
  if (t.empty()) return fault{"t", "monotonic", "[]", {{"t0", asked.t0}}};
  if (asked.own_steps && t.size() > 1) return fault{"t", "one_end", static_cast<std::int64_t>(t.size()), {}};
  if (asked.own_steps && t[0] == asked.t0) return fault{"t", "differs_from_start", t[0], {{"t0", asked.t0}}};
  const double direction = t.back() == asked.t0 ? 0.0 : asked.direction();
  bool monotonic = (t[0] - asked.t0) * direction >= 0.0;
  for (std::size_t i = 1; i < t.size(); ++i) monotonic = monotonic && (t[i] - t[i - 1]) * direction > 0.0;
  if (!monotonic) return fault{"t", "monotonic", shortened(t), {{"t0", asked.t0}}};
  return {};
}

// What came to rest by dry friction may have done so at any time before: such a motion has no one past.
maybe check_direction(const request& asked) {
  if (asked.direction() > 0.0 || !numbers_of(asked.system).sticks) return {};
  return fault{"t", "backward_of_dry_friction", asked.end(), {{"t0", asked.t0}}};
}

maybe check_step(const request& asked) {
  const double end = asked.end(), span = std::fabs(end - asked.t0);
  const auto named = [&](std::string_view key, std::vector<std::pair<std::string_view, fault_value>> details) {
    return fault{"step", key, *asked.options.step, std::move(details)};
  };
  if (!asked.options.step)
    return fault{"step", "step_needed", {}, {{"method", asked.method}, {"example", option_rows()[0].example}}};
  const double step = *asked.options.step;
  if (!std::isfinite(step)) return named("finite", {{"unit", "s"}});
  if (!(step > 0.0)) return named("positive", {{"unit", "s"}});
  if (span != 0.0 && step > span) return named("step_within_span", {{"span", span}});
  if (span / step > largest_count) return named("steps_countable", {{"span", span}});
  if (asked.t0 + step == asked.t0 || end - asked.signed_step() == end)
    return named("step_above_rounding", {{"time", std::max(std::fabs(asked.t0), std::fabs(end))}});
  if (asked.own_steps && span / step > most_outputs)
    return named("outputs_of_steps", {{"count", span / step}, {"time", end}});
  return {};
}

// Times so large that the motion moves between one double and the next make no sense to a method that chooses its
// steps.
maybe check_rounding_of_times(const request& asked) {
  const double end = asked.end();
  if (!std::isfinite(end)) return {};
  const double latest = std::max(std::fabs(asked.t0), std::fabs(end));
  const double apart = std::nextafter(latest, HUGE_VAL) - latest;
  if (apart * numbers_of(asked.system).largest_frequency <= largest_phase) return {};
  return fault{"t", asked.t0 != 0.0 ? "rounding_of_late_times" : "rounding_of_times", apart, {{"time", latest}}};
}

maybe check_number(const option_row& row, std::optional<double> value) {
  const std::string name(row.name);
  if (!value) return {};
  if (!std::isfinite(*value)) return fault{name, "finite", *value, {{"unit", std::string(row.unit)}}};
  if (row.least == 0.0 && !(*value > 0.0)) return fault{name, "positive", *value, {{"unit", std::string(row.unit)}}};
  return {};
}

const option_row& row_named(std::string_view name) {
  return *std::ranges::find(option_rows(), name, &option_row::name);
}

maybe check_tolerance(const request& asked) {
  const auto tolerance = asked.options.tolerance;
  if (auto found = check_number(row_named("tolerance"), tolerance); found && found->rule == "finite") return found;
  if (!tolerance || (best_tolerance <= *tolerance && *tolerance <= largest_tolerance)) return {};
  return fault{"tolerance",
               *tolerance < best_tolerance ? "tolerance_too_small" : "tolerance_range",
               *tolerance,
               {{"least", best_tolerance}, {"most", largest_tolerance}}};
}

maybe check_certify(const request& asked) {
  const option_row& row = row_named("certify");
  if (auto found = check_number(row, asked.options.certify)) return found;
  if (!asked.options.certify || *asked.options.certify <= row.most) return {};
  return fault{"certify", "angle_to_certify", *asked.options.certify, {{"most", row.most}}};
}

maybe check_whole(std::string_view name, std::optional<std::int64_t> value) {
  const option_row& row = row_named(name);
  if (!value || (row.least <= static_cast<double>(*value) && static_cast<double>(*value) <= row.most)) return {};
  return fault{std::string(name),
               "whole_range",
               *value,
               {{"least", static_cast<std::int64_t>(row.least)}, {"most", static_cast<std::int64_t>(row.most)}}};
}

// What else is asked for that many digits choose by themselves.
maybe check_digits_alone(const request& asked) {
  if (!asked.options.digits) return {};
  std::string other;
  if (method_named(asked.method)->needs != facet::analytic)
    other = "method=" + asked.method;
  else if (asked.options.step)
    other = "step";
  else if (asked.options.tolerance)
    other = "tolerance";
  else if (asked.options.certify)
    other = "certify";
  else if (asked.options.max_steps)
    other = "max_steps";
  else if (!asked.events.empty())
    other = "events";
  if (other.empty()) return {};
  return fault{"digits", "digits_alone", *asked.options.digits, {{"other", other}}};
}

maybe check_together(const request& asked, const method_row& method) {
  const run_options& options = asked.options;
  if (auto found = check_digits_alone(asked)) return found;
  if (method.adaptive && options.step)
    return fault{"step", "step_of_adaptive", *options.step, {{"method", asked.method}}};
  if (!method.adaptive && options.tolerance)
    return fault{"tolerance",
                 "tolerance_of_fixed",
                 *options.tolerance,
                 {{"method", asked.method}, {"example", std::string("taylor")}}};
  if (!method.adaptive && !asked.events.empty())
    return fault{"events",
                 "events_of_fixed",
                 {},
                 {{"method", asked.method},
                  {"any_of", names_where(method_rows(), [](const method_row& each) { return each.adaptive; })}}};
  return {};
}

// A trust horizon and guaranteed digits come of the Taylor method with more digits, whatever the method of the run.
maybe check_series(const request& asked) {
  const bool certified = asked.options.certify.has_value();
  if (!certified && !asked.options.digits) return {};
  for (const method_row& method : method_rows())
    if (method.needs == facet::analytic && takes_system(method, asked.system.name)) return {};
  return fault{certified ? "certify" : "digits", "needs_series", {}, {{"system", asked.system.name}}};
}

maybe check_events(const request& asked) {
  const std::size_t rods = system_named(asked.system.name)->degrees_of_freedom;
  names choices;
  for (std::size_t i = 1; i <= rods; ++i) choices.push_back(std::to_string(i));
  for (const event& each : asked.events)
    if (each.kind != event_kind::tip_height && (each.index < 0 || static_cast<std::size_t>(each.index) >= rods))
      return fault{
          "i", "rod", static_cast<std::int64_t>(each.index) + 1, {{"system", asked.system.name}, {"any_of", choices}}};
  return {};
}

}  // namespace

maybe check(const system_description& of) {
  const system_row* const row = system_named(of.name);
  if (!row)
    return fault{
        "system", "unknown_name", of.name, {{"choices", names_where(system_rows(), [](const auto&) { return true; })}}};
  const form& form = row->forms[std::min(of.form, row->forms.size() - 1)];
  const auto parameters = form.parameters;
  if (of.form >= row->forms.size() || of.parameters.size() != parameters.size())
    return fault{"parameters",
                 "count_of_parameters",
                 static_cast<std::int64_t>(of.parameters.size()),
                 {{"count", static_cast<std::int64_t>(parameters.size())}, {"form", std::string(form.name)}}};
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double value = of.parameters[i];
    const std::string name(parameters[i].name), unit(parameters[i].unit);
    if (!std::isfinite(value)) return fault{name, "finite", value, {{"unit", unit}}};
    const range allowed = parameters[i].allowed;
    if (allowed != range::any && (value < 0.0 || (value == 0.0 && allowed == range::positive)))
      return fault{name, allowed == range::positive ? "positive" : "not_negative", value, {{"unit", unit}}};
  }
  for (const auto& [name, value, may_vanish] : numbers_of(of).constants)
    if (!std::isfinite(value) || (value <= 0.0 && !may_vanish))
      return fault{"parameters", "constants", value, {{"constant", std::string(name)}}};
  return {};
}

maybe check_method(const request& asked) {
  const method_row* const method = method_named(asked.method);
  if (!method)
    return fault{"method", "unknown_name", asked.method, {{"choices", names_where(method_rows(), [](const auto&) {
                                                             return true;
                                                           })}}};
  if (takes_system(*method, asked.system.name)) return {};
  static constexpr std::string_view rules[] = {"", "needs_energetic", "needs_mechanical", "needs_separable",
                                               "needs_analytic"};
  const names others = names_where(method_rows(), [&](const method_row& other) {
    return (other.symplectic || !method->symplectic || !system_named(asked.system.name)->can.conservative) &&
           takes_system(other, asked.system.name);
  });
  const bool ideal_alone = method->symplectic && !system_named(asked.system.name)->can.conservative;
  return fault{"method",
               ideal_alone ? "needs_conservative" : rules[static_cast<std::size_t>(method->needs)],
               asked.method,
               {{"system", asked.system.name}, {"choices", others}}};
}

maybe check_options(const request& asked) {
  const method_row& method = *method_named(asked.method);
  if (auto found = check_whole("digits", asked.options.digits)) return found;
  if (auto found = check_together(asked, method)) return found;
  if (method.adaptive)
    if (auto found = check_rounding_of_times(asked)) return found;
  if (!method.adaptive)
    if (auto found = check_step(asked)) return found;
  if (auto found = check_whole("max_steps", asked.options.max_steps)) return found;
  if (auto found = check_tolerance(asked)) return found;
  if (auto found = check_events(asked)) return found;
  if (auto found = check_series(asked)) return found;
  return check_certify(asked);
}

maybe check_of_doubles(const request& asked) {
  if (auto found = check(asked)) return found;
  if (!asked.options.digits) return {};
  return fault{"digits", "not_of_doubles", *asked.options.digits, {}};
}

maybe check(const request& asked) {
  if (auto found = check(asked.system)) return found;
  if (auto found = check_method(asked)) return found;
  if (auto found = check_state(asked)) return found;
  if (auto found = check_times(asked)) return found;
  if (auto found = check_direction(asked)) return found;
  return check_options(asked);
}

}  // namespace pendula
