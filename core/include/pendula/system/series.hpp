// The Taylor series of a motion belongs to its system: each header of a series names it here.
#pragma once

#include "pendula/scalar/sincos.hpp"

namespace pendula {

template <class Sys>
struct series_of;

// A series of a given order, made by `expand` from a point in canonical variables.
template <class Series>
concept SeriesOver =
    requires(Series& series, const typename Series::system& system, const typename Series::system::state& point,
             const typename Series::system::scalar& h, const typename Series::system::scalar* inverse) {
      series.expand(system, point, point, inverse);
      { series.increment(h, inverse) } -> std::same_as<typename Series::system::state>;
      { series.velocity(0, 0) } -> std::convertible_to<typename Series::system::scalar>;
    };

// Of an angle and its tail, from that of the angle: all that the tail is about is its rounding.
template <class S>
PENDULA_INLINE sine_cosine<S> turned_by(sine_cosine<S> of_angle, S tail) {
  return {of_angle.sin + of_angle.cos * tail, of_angle.cos - of_angle.sin * tail};
}

template <class Sys>
using series = typename series_of<Sys>::type;

}  // namespace pendula
