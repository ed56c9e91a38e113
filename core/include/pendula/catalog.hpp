// The two lists, of systems and of methods, and the only place where they meet. Python names, command-line
// choices, the documentation's tables and the conformance tests follow from them.
#pragma once

#include <tuple>

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
#include "pendula/system/double_pendulum.hpp"
#include "pendula/system/linear_pendulum.hpp"
#include "pendula/system/simple_pendulum.hpp"

namespace pendula {

using systems = std::tuple<linear_pendulum, simple_pendulum, double_pendulum>;
using fixed_methods = std::tuple<euler, heun, rk4, symplectic_euler, verlet, yoshida4, yoshida6, yoshida8, midpoint,
                                 gauss4, gauss6, gauss8>;
using adaptive_methods = std::tuple<dop853, taylor>;
using methods = decltype(std::tuple_cat(fixed_methods{}, adaptive_methods{}));

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
inline constexpr bool takes = Method::template takes<typename Entry::template over<double>>;

namespace detail {
template <class... Entries>
constexpr bool all_systems(std::type_identity<std::tuple<Entries...>>) {
  return (System<Entries> && ...);
}
template <class... Entries>
constexpr bool all_methods(std::type_identity<std::tuple<Entries...>>) {
  return (Method<Entries> && ...);
}
}  // namespace detail
static_assert(detail::all_systems(std::type_identity<systems>{}));
static_assert(detail::all_methods(std::type_identity<methods>{}));

}  // namespace pendula
