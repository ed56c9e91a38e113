// Each rule is broken by a request that breaks nothing else, and its sentences have what they name.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <set>

#include "pendula/kernels/check.hpp"
#include "requests.hpp"

using namespace requests;

namespace {

struct broken {
  std::string_view rule, argument;
  request asked;
};

template <class Change>
request changed(request asked, Change&& change) {
  change(asked);
  return asked;
}

constexpr double no_number = __builtin_nan(""), infinity = __builtin_inf();

std::vector<broken> broken_descriptions() {
  const auto of = [](auto&& change) { return changed(adaptive(), [&](request& r) { change(r.system); }); };
  return {
      {"unknown_name", "system", of([](auto& s) { s.name = "triple"; })},
      {"count_of_parameters", "parameters", of([](auto& s) { s.parameters.pop_back(); })},
      {"count_of_parameters", "parameters", of([](auto& s) { s.form = 3; })},
      {"finite", "m1", of([](auto& s) { s.parameters[0] = no_number; })},
      {"positive", "l2", of([](auto& s) { s.parameters[3] = 0.0; })},
      {"positive", "gravity", of([](auto& s) { s.parameters[4] = -9.8; })},
      {"not_negative", "c1", of([](auto& s) {
         s = described("double", 2);
         s.parameters[3] = -1.0;
       })},
      {"constants", "parameters", of([](auto& s) { s.parameters[2] = 1e-200; })},
      {"constants", "parameters", of([](auto& s) { s.parameters[2] = 1e200; })},
  };
}

std::vector<broken> broken_starts_and_times() {
  const auto of = [](auto&& change) { return changed(adaptive(), change); };
  return {
      {"unknown_name", "method", of([](auto& r) { r.method = "leapfrog"; })},
      {"needs_separable", "method",
       changed(with_method("verlet", "simple"),
               [](auto& r) {
                 r.system = described("double");
                 r.state.assign(4, 0.1);
               })},
      {"count_of_components", "state", of([](auto& r) { r.state.pop_back(); })},
      {"all_finite", "state", of([](auto& r) { r.state[3] = infinity; })},
      {"finite", "t0", of([](auto& r) { r.t0 = no_number; })},
      {"monotonic", "t", of([](auto& r) { r.times = {}; })},
      {"monotonic", "t", of([](auto& r) { r.times = {0.5, 0.5}; })},
      {"monotonic", "t", of([](auto& r) { r.times = {-0.5, 0.5}; })},
      {"monotonic", "t", of([](auto& r) { r.times = {0.5, no_number}; })},
      {"monotonic", "t", of([](auto& r) { r.times = {0.5, 1.0, 0.0}; })},
      {"differs_from_start", "t", of([](auto& r) {
         r.own_steps = true;
         r.times = {r.t0};
       })},
      {"one_end", "t", of([](auto& r) {
         r.own_steps = true;
         r.times = {0.5, 1.0};
       })},
      {"rounding_of_times", "t", of([](auto& r) { r.times = {1e13}; })},
      {"rounding_of_late_times", "t", of([](auto& r) {
         r.t0 = 1e13;
         r.times = {1e13 + 1.0};
       })},
      {"backward_of_dry_friction", "t", of([](auto& r) {
         r.system = described("damped-double");
         r.system.parameters.back() = 0.1;
         r.times = {-1.0};
       })},
      {"rod", "i", of([](auto& r) { r.events = {{event_kind::angle, 2}}; })},
      {"rod", "i", of([](auto& r) { r.events = {{event_kind::velocity_zero, -1}}; })},
  };
}

std::vector<broken> broken_steps() {
  const auto of = [](auto&& change) { return changed(fixed(), change); };
  return {
      {"step_needed", "step", of([](auto& r) { r.options.step = {}; })},
      {"finite", "step", of([](auto& r) { r.options.step = infinity; })},
      {"positive", "step", of([](auto& r) { r.options.step = -0.01; })},
      {"step_within_span", "step", of([](auto& r) { r.options.step = 1.5; })},
      {"steps_countable", "step", of([](auto& r) { r.options.step = 1e-17; })},
      {"step_above_rounding", "step", of([](auto& r) {
         r.t0 = 1e9;
         r.times = {1e9 + 1.0};
         r.options.step = 1e-8;
       })},
      {"outputs_of_steps", "step", of([](auto& r) {
         r.own_steps = true;
         r.times = {1.0};
         r.options.step = 5e-9;
       })},
      {"tolerance_of_fixed", "tolerance", of([](auto& r) { r.options.tolerance = 1e-9; })},
      {"events_of_fixed", "events", of([](auto& r) { r.events = {{event_kind::angle}}; })},
      {"digits_alone", "digits", of([](auto& r) { r.options.digits = 12; })},
      {"needs_conservative", "method", of([](auto& r) {
         r.system = described("driven");
         r.method = "verlet";
       })},
  };
}

std::vector<broken> broken_options() {
  const auto of = [](auto&& change) { return changed(adaptive(), [&](request& r) { change(r.options); }); };
  const auto with_digits = [](auto&& change) {
    return changed(adaptive(), [&](request& r) {
      r.options.digits = 12;
      change(r);
    });
  };
  return {
      {"step_of_adaptive", "step", of([](auto& o) { o.step = 0.01; })},
      {"whole_range", "max_steps", of([](auto& o) { o.max_steps = 0; })},
      {"whole_range", "digits", of([](auto& o) { o.digits = 0; })},
      {"whole_range", "digits", of([](auto& o) { o.digits = 16; })},
      {"finite", "tolerance", of([](auto& o) { o.tolerance = no_number; })},
      {"tolerance_range", "tolerance", of([](auto& o) { o.tolerance = 0.01; })},
      {"tolerance_too_small", "tolerance", of([](auto& o) { o.tolerance = 1e-17; })},
      {"finite", "certify", of([](auto& o) { o.certify = infinity; })},
      {"positive", "certify", of([](auto& o) { o.certify = 0.0; })},
      {"angle_to_certify", "certify", of([](auto& o) { o.certify = 1.5; })},
      {"digits_alone", "digits", with_digits([](auto& r) { r.options.step = 0.01; })},
      {"digits_alone", "digits", with_digits([](auto& r) { r.options.tolerance = 1e-9; })},
      {"digits_alone", "digits", with_digits([](auto& r) { r.options.certify = 1e-9; })},
      {"digits_alone", "digits", with_digits([](auto& r) { r.options.max_steps = 100; })},
      {"digits_alone", "digits", with_digits([](auto& r) { r.events = {{event_kind::angle}}; })},
  };
}

std::vector<broken> all_broken() {
  std::vector<broken> all;
  for (auto&& some : {broken_descriptions(), broken_starts_and_times(), broken_steps(), broken_options()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

// Rules that no request to a system of the catalogue breaks: all of these have those facets, and what is not a number
// at all is found where a request is made, in the bindings.
const std::set<std::string_view> of_others{
    "number", "needs_energetic", "needs_mechanical", "needs_analytic", "needs_series", "not_of_doubles", "rows"};

std::set<std::string> placeholders(std::string_view sentence) {
  std::set<std::string> found;
  for (std::size_t i = 0; i < sentence.size(); ++i) {
    if (sentence[i] != '{' && sentence[i] != '<') continue;
    const std::size_t end = sentence.find(sentence[i] == '{' ? '}' : '>', i);
    BOOST_TEST_REQUIRE(end != sentence.npos, sentence);
    found.emplace(sentence.substr(i, end + 1 - i));
  }
  return found;
}

const rule_row* row_of(std::string_view rule) {
  const auto found = std::ranges::find(rule_rows(), rule, &rule_row::key);
  return found == rule_rows().end() ? nullptr : &*found;
}

// Whether the fault brings what stands in braces in a sentence. A unit is named where there is one.
bool brings(const fault& found, const std::string& placeholder) {
  if (placeholder.front() == '<' || placeholder == "{value}" || placeholder == "{in_unit}") return true;
  return std::ranges::any_of(found.details,
                             [&](const auto& detail) { return placeholder == "{" + std::string(detail.first) + "}"; });
}

}  // namespace

BOOST_AUTO_TEST_SUITE(kernels)

BOOST_AUTO_TEST_CASE(a_sound_request_breaks_no_rule) {
  BOOST_TEST(!check(adaptive()));
  BOOST_TEST(!check(fixed()));
  for_each_pair([](const method_row& method, std::string_view system) {
    BOOST_TEST(!check(with_method(method.name, system)), method.name << " " << system);
  });
  for (const system_row& row : system_rows())
    for (std::size_t form = 0; form < row.forms.size(); ++form) BOOST_TEST(!check(described(row.name, form)));
  for (auto change :
       {+[](request& r) { r.times = {r.t0}; }, +[](request& r) { r.times = {-0.5, -1.0}; },
        +[](request& r) { r.options = {{}, 1e-9, 1e-6, 1000, {}}; }, +[](request& r) { r.options.digits = 12; },
        +[](request& r) { r.events = {{event_kind::angle, 1}, {event_kind::tip_height, 7}}; }})
    BOOST_TEST(!check(changed(adaptive(), change)));
}

BOOST_AUTO_TEST_CASE(each_rule_is_found_where_it_alone_is_broken) {
  for (const auto& [rule, argument, asked] : all_broken()) {
    const auto found = check(asked);
    BOOST_TEST_CONTEXT(rule << " of " << argument) {
      BOOST_TEST_REQUIRE(found.has_value());
      BOOST_TEST(found->rule == rule);
      BOOST_TEST(found->argument == argument);
      const rule_row* const row = row_of(found->rule);
      BOOST_TEST_REQUIRE(row);
      for (const auto& sentence : {row->english, row->way_out_in_english})
        for (const std::string& each : placeholders(sentence)) BOOST_TEST(brings(*found, each), each);
    }
  }
}

BOOST_AUTO_TEST_CASE(every_rule_can_be_broken) {
  std::set<std::string_view> found = of_others;
  for (const broken& each : all_broken()) found.insert(each.rule);
  for (const rule_row& row : rule_rows()) BOOST_TEST(found.erase(row.key) == 1u, row.key);
  BOOST_TEST(found.empty());
}

BOOST_AUTO_TEST_CASE(both_languages_of_a_rule_say_the_same) {
  std::set<std::string_view> keys;
  for (const rule_row& row : rule_rows()) {
    BOOST_TEST_CONTEXT(row.key) {
      BOOST_TEST(keys.insert(row.key).second);
      BOOST_TEST((!row.english.empty() && !row.spanish.empty() && row.english != row.spanish));
      BOOST_TEST(row.way_out_in_english.empty() == row.way_out_in_spanish.empty());
      BOOST_TEST((placeholders(row.english) == placeholders(row.spanish)));
      BOOST_TEST((placeholders(row.way_out_in_english) == placeholders(row.way_out_in_spanish)));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
