// Which systems a method takes: those that have the facet it needs.
#pragma once

#include "pendula/description.hpp"
#include "pendula/system/series.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <facet f, class Sys>
constexpr bool has_facet() {
  if constexpr (f == facet::flow) {
    return Flow<Sys>;
  } else if constexpr (f == facet::energetic) {
    return Energetic<Sys>;
  } else if constexpr (f == facet::mechanical) {
    return Mechanical<Sys>;
  } else if constexpr (f == facet::separable) {
    return Separable<Sys>;
  } else {
    static_assert(f == facet::analytic);
    return Analytic<Sys>;
  }
}

template <class Method, class Sys>
concept Takes = has_facet<Method::needs, Sys>();

}  // namespace pendula::inline PENDULA_MACHINE
