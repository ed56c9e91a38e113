// The two lists, of systems and of methods, and the only place where they meet. Python names, command-line
// choices, the documentation's tables and the conformance tests follow from them.
#pragma once

#include <tuple>

#include "pendula/facets.hpp"
#include "pendula/method/dop853.hpp"
#include "pendula/method/euler.hpp"
#include "pendula/method/gauss4.hpp"
#include "pendula/method/gauss6.hpp"
#include "pendula/method/gauss8.hpp"
#include "pendula/method/heun.hpp"
#include "pendula/method/midpoint.hpp"
#include "pendula/method/rk4.hpp"
#include "pendula/method/symplectic_euler.hpp"
#include "pendula/method/taylor.hpp"
#include "pendula/method/verlet.hpp"
#include "pendula/method/yoshida4.hpp"
#include "pendula/method/yoshida6.hpp"
#include "pendula/method/yoshida8.hpp"
#include "pendula/system/damped_double_pendulum.hpp"
#include "pendula/system/double_pendulum.hpp"
#include "pendula/system/driven_linear_pendulum.hpp"
#include "pendula/system/driven_pendulum.hpp"
#include "pendula/system/linear_pendulum.hpp"
#include "pendula/system/simple_pendulum.hpp"

namespace pendula::inline PENDULA_MACHINE {

using ideal_systems = std::tuple<linear_pendulum, simple_pendulum, double_pendulum>;
using real_systems = std::tuple<driven_linear_pendulum, driven_pendulum, damped_double_pendulum>;
using systems = decltype(std::tuple_cat(ideal_systems{}, real_systems{}));
using fixed_methods = std::tuple<euler, heun, rk4, symplectic_euler, verlet, yoshida4, yoshida6, yoshida8, midpoint,
                                 gauss4, gauss6, gauss8>;
using adaptive_methods = std::tuple<dop853, taylor>;
using methods = decltype(std::tuple_cat(fixed_methods{}, adaptive_methods{}));

// What goes through lanes: everything, but in a browser, where a program has to be small, what is run there by the
// thousand. The rest runs one after the other, with the same bits.
#ifdef PENDULA_FEW_LANES
using systems_in_lanes = std::tuple<double_pendulum, driven_pendulum>;
using fixed_methods_in_lanes = std::tuple<rk4>;
using adaptive_methods_in_lanes = std::tuple<taylor>;
#else
using systems_in_lanes = systems;
using fixed_methods_in_lanes = fixed_methods;
using adaptive_methods_in_lanes = adaptive_methods;
#endif

template <class List, class Visitor>
constexpr void for_each(Visitor&& visit) {
  [&]<class... Entries>(std::type_identity<std::tuple<Entries...>>) {
    (visit.template operator()<Entries>(), ...);
  }(std::type_identity<List>{});
}

// Calls visit.operator()<Entry>() for the entry of that name; false where there is none.
template <class List, class Visitor>
bool with(std::string_view name, Visitor&& visit) {
  bool found = false;
  for_each<List>([&]<class Entry>() {
    if (Entry::name == name) {
      found = true;
      visit.template operator()<Entry>();
    }
  });
  return found;
}

// Whether the method takes the system; both are entries of the lists.
template <class Method, class Entry>
inline constexpr bool takes = Takes<Method, typename Entry::template over<double>>;

// An entry of the list of systems: name, parameter rows, capabilities, and the system over any scalar.
template <class T>
concept SystemEntry = Flow<typename T::template over<double>> && Energetic<typename T::template over<double>> &&
                      Positioned<typename T::template over<double>> &&
                      requires(const double* p, const typename T::template over<double>& system) {
                        { T::name } -> std::convertible_to<std::string_view>;
                        { T::components[0] } -> std::convertible_to<component>;
                        { T::forms[0] } -> std::convertible_to<form>;
                        { T::can } -> std::convertible_to<capabilities>;
                        {
                          T::template make<double>(std::size_t{}, p)
                        } -> std::same_as<typename T::template over<double>>;
                        { system.constants()[0] } -> std::convertible_to<constant<double>>;
                      };

// An entry of the list of methods. One that iterates has no fixed number of evaluations and says 0.
template <class T>
concept MethodEntry = requires {
  { T::name } -> std::convertible_to<std::string_view>;
  { T::order } -> std::convertible_to<int>;
  { T::evaluations_per_step } -> std::convertible_to<int>;
  { T::adaptive } -> std::convertible_to<bool>;
  { T::symplectic } -> std::convertible_to<bool>;
  { T::needs } -> std::convertible_to<facet>;
  { T::source } -> std::convertible_to<std::string_view>;
};

namespace detail {
template <class... Entries>
constexpr bool all_systems(std::type_identity<std::tuple<Entries...>>) {
  return (SystemEntry<Entries> && ...);
}
template <class... Entries>
constexpr bool all_methods(std::type_identity<std::tuple<Entries...>>) {
  return (MethodEntry<Entries> && ...);
}
}  // namespace detail
static_assert(detail::all_systems(std::type_identity<systems>{}));
static_assert(detail::all_methods(std::type_identity<methods>{}));

}  // namespace pendula::inline PENDULA_MACHINE
