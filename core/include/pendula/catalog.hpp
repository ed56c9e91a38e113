// The two lists, of systems and of methods, and the only place where they meet. Python names, command-line
// choices, the documentation's tables and the conformance tests follow from them.
#pragma once

#include <tuple>

#include "pendula/method/euler.hpp"
#include "pendula/method/heun.hpp"
#include "pendula/method/rk4.hpp"
#include "pendula/system/double_pendulum.hpp"
#include "pendula/system/linear_pendulum.hpp"
#include "pendula/system/simple_pendulum.hpp"

namespace pendula {

using systems = std::tuple<linear_pendulum, simple_pendulum, double_pendulum>;
using methods = std::tuple<euler, heun, rk4>;

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
