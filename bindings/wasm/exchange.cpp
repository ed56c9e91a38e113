#include "exchange.hpp"

#include <cmath>
#include <cstdio>
#include <deque>

#include "pendula/kernels/catalog_rows.hpp"

namespace pendula_wasm {

namespace {

std::vector<double> given;
std::deque<std::vector<double>> answers;
std::string fault_text;

void write(const std::string& text) {
  fault_text += '"';
  for (const char c : text) {
    if (c == '"' || c == '\\') fault_text += '\\';
    fault_text += c;
  }
  fault_text += '"';
}
void write(std::monostate) { fault_text += "null"; }
void write(double x) {
  if (!std::isfinite(x)) return write(std::string(std::isnan(x) ? "nan" : x > 0.0 ? "inf" : "-inf"));
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  fault_text += text;
}
void write(std::int64_t n) { fault_text += std::to_string(n); }
void write(const std::vector<std::string>& texts) {
  fault_text += '[';
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (i > 0) fault_text += ',';
    write(texts[i]);
  }
  fault_text += ']';
}
void write(const pendula::fault_value& value) {
  std::visit([](const auto& each) { write(each); }, value);
}

}  // namespace

double reader::number() {
  if (next_ >= given.size()) pendula::wrong_call("more numbers are read than were given");
  return given[next_++];
}

std::size_t reader::place(std::size_t below) {
  const double x = number();
  if (!(x >= 0.0 && x < static_cast<double>(below))) pendula::wrong_call("no such place in a list");
  return static_cast<std::size_t>(x);
}

std::span<const double> reader::list() {
  const std::size_t count = place(given.size() - next_ + 1);
  const std::span all(given);
  next_ += count;
  if (next_ > given.size()) pendula::wrong_call("a list is longer than what was given");
  return all.subspan(next_ - count, count);
}

std::optional<double> reader::option() {
  const double x = number();
  return std::isnan(x) ? std::optional<double>() : x;
}

std::span<const double> reader::read() const { return std::span(given).first(next_); }

pendula::system_description reader::system() {
  const auto& row = pendula::system_rows()[place(pendula::system_rows().size())];
  const std::size_t form = place(row.forms.size());
  const auto parameters = list();
  return {std::string(row.name), form, {parameters.begin(), parameters.end()}};
}

pendula::request reader::request() {
  constexpr double rest_of_pi = 1.2246467991473532e-16;  // π less the double nearest to it
  pendula::request asked;
  asked.system = system();
  asked.method = std::string(pendula::method_rows()[place(pendula::method_rows().size())].name);
  asked.t0 = number();
  asked.own_steps = flag();
  asked.options.step = option();
  asked.options.tolerance = option();
  asked.options.certify = option();
  if (const auto most = option()) asked.options.max_steps = static_cast<std::int64_t>(*most);
  const auto state = list(), times = list();
  asked.state.assign(state.begin(), state.end());
  asked.times.assign(times.begin(), times.end());
  const auto events = whole();
  for (std::int64_t i = 0; i < events; ++i) {
    pendula::event each{static_cast<pendula::event_kind>(place(std::size(pendula::event_kind_names)))};
    each.index = static_cast<int>(whole());
    each.value = number();
    each.every_turn = flag();
    each.value_tail = each.every_turn && each.value == 0x1.921fb54442d18p+1 ? rest_of_pi : 0.0;
    each.direction = static_cast<int>(whole());
    each.terminal = whole();
    asked.events.push_back(each);
  }
  return asked;
}

reader asked() {
  answers.clear();
  fault_text.clear();
  return {};
}

std::vector<double>& answer() { return answers.emplace_back(); }

int refused(const std::optional<pendula::fault>& found) {
  if (!found) return 0;
  fault_text = "{\"argument\":";
  write(found->argument);
  fault_text += ",\"rule\":";
  write(std::string(found->rule));
  fault_text += ",\"value\":";
  write(found->value);
  fault_text += ",\"details\":{";
  for (std::size_t i = 0; i < found->details.size(); ++i) {
    if (i > 0) fault_text += ',';
    write(std::string(found->details[i].first));
    fault_text += ':';
    write(found->details[i].second);
  }
  fault_text += "}}";
  return 1;
}

}  // namespace pendula_wasm

using namespace pendula_wasm;

// Where the numbers that are asked with go; where a list of the answer lies, or the fault's text, and how long it is.
extern "C" __attribute__((export_name("input"))) double* input(std::size_t count) {
  given.resize(count);
  return given.data();
}
extern "C" __attribute__((export_name("answer_count"))) std::size_t answer_count() { return answers.size(); }
extern "C" __attribute__((export_name("answer_data"))) const double* answer_data(std::size_t i) {
  return answers[i].data();
}
extern "C" __attribute__((export_name("answer_size"))) std::size_t answer_size(std::size_t i) {
  return answers[i].size();
}
extern "C" __attribute__((export_name("fault_data"))) const char* fault_data() { return fault_text.data(); }
extern "C" __attribute__((export_name("fault_size"))) std::size_t fault_size() { return fault_text.size(); }
