// The closed forms over lists.
#include "pendula/kernels/closed_forms.hpp"

#include <limits>

#include "exchange.hpp"

using namespace pendula_wasm;

namespace {

// The closed form of a described system, with states (m, 2); otherwise a fault.
struct solvable {
  pendula::system_description system;
  std::span<const double> states;
  const pendula::closed_form* form;
  std::optional<pendula::fault> wrong;

  explicit solvable(reader& from, bool periodic = false)
      : system(from.system()),
        states(from.list()),
        form(pendula::closed_form_of(system.name)),
        wrong(pendula::check(system)) {
    if (states.size() % 2 != 0) pendula::wrong_call("states must have two components");
    if (form == nullptr || (periodic && form->period == nullptr)) pendula::wrong_call("no closed form of this system");
  }
  const double* parameters() const { return system.parameters.data(); }
};

}  // namespace

// NaN where a state or a time is so large that no digit is known.
PENDULA_EXPORT(exact) {
  auto from = asked();
  const solvable of(from);
  const double t0 = from.number();
  const auto times = from.list();
  if (of.wrong) return refused(of.wrong);
  auto& to = answer();
  to.assign(of.states.size() * times.size(), std::numeric_limits<double>::quiet_NaN());
  of.form->solve(of.parameters(), of.states, times, t0, to.data(), to_the_end);
  return 0;
}

PENDULA_EXPORT(periods) {
  auto from = asked();
  const solvable of(from, true);
  if (of.wrong) return refused(of.wrong);
  auto& to = answer();
  to.resize(of.states.size() / 2);
  pendula::periods_of(*of.form, of.parameters(), of.states, to.data(), to_the_end);
  return 0;
}
