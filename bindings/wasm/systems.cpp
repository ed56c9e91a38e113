// The physics of the systems over lists of states, and what is wrong with a request.
#include "exchange.hpp"
#include "pendula/kernels/catalog_rows.hpp"

using namespace pendula_wasm;

namespace {

// A described system and states of it, both checked; otherwise a fault.
struct given_states {
  pendula::system_description system;
  std::span<const double> states;
  std::optional<pendula::fault> wrong;
  std::size_t dimension;

  explicit given_states(reader& from) : system(from.system()), states(from.list()), wrong(pendula::check(system)) {
    dimension = pendula::system_named(system.name)->components.size();
    if (states.size() % dimension != 0) pendula::wrong_call("states of another dimension than the system's");
  }
  std::size_t count() const { return states.size() / dimension; }
};

}  // namespace

PENDULA_EXPORT(check) {
  auto from = asked();
  return refused(pendula::check_of_doubles(from.request()));
}

PENDULA_EXPORT(check_system) {
  auto from = asked();
  return refused(pendula::check(from.system()));
}

PENDULA_EXPORT(energies) {
  auto from = asked();
  const given_states of(from);
  if (of.wrong) return refused(of.wrong);
  auto &kinetic = answer(), &potential = answer();
  kinetic.resize(of.count());
  potential.resize(of.count());
  pendula::energies_of(of.system, of.states, kinetic.data(), potential.data());
  return 0;
}

PENDULA_EXPORT(positions) {
  auto from = asked();
  const given_states of(from);
  if (of.wrong) return refused(of.wrong);
  auto& to = answer();
  to.resize(of.states.size());
  pendula::positions_of(of.system, of.states, to.data());
  return 0;
}

PENDULA_EXPORT(rhs) {
  auto from = asked();
  const double t = from.number();
  const given_states of(from);
  if (of.wrong) return refused(of.wrong);
  auto& to = answer();
  to.resize(of.states.size());
  pendula::rhs_of(of.system, t, of.states, to.data());
  return 0;
}

// The scales and, after them, the constants in the order of their names in the catalogue.
PENDULA_EXPORT(numbers) {
  auto from = asked();
  const auto system = from.system();
  if (const auto wrong = pendula::check(system)) return refused(wrong);
  const auto found = pendula::numbers_of(system);
  answer() = {found.energy_scale, found.largest_frequency, found.sticks ? 1.0 : 0.0};
  auto& constants = answer();
  for (const auto& each : found.constants) constants.push_back(each.value);
  return 0;
}
