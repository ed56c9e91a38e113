// The Taylor series of a motion belongs to its system, which names it as its `series`.
#pragma once

#include "pendula/concepts.hpp"
#include "pendula/scalar/product.hpp"
#include "pendula/scalar/sincos.hpp"

namespace pendula::inline PENDULA_MACHINE {

// A series of a given even order, made by `expand` from a time and a point in canonical variables, each with its
// tail, what it has beyond a double. `inverse` holds u/k at place k, where u is the unit of
// time: each order is made of the ones before it by one such factor, so that the series is one in h/u.
template <class Series, class Sys>
concept SeriesOver =
    std::constructible_from<Series, int> &&
    requires(Series& series, const Sys& system, const head_and_tail<typename Sys::scalar>& t,
             const typename Sys::state& point, const typename Sys::scalar& h, const typename Sys::scalar* inverse) {
      series.expand(system, t, point, point, inverse);
      { series.increment(h, inverse) } -> std::same_as<typename Sys::state>;
      { series.velocity(0, 0) } -> std::convertible_to<typename Sys::scalar>;
    };

template <class Sys>
concept Analytic =
    Canonical<Sys> && Energetic<Sys> && requires { typename Sys::series; } && SeriesOver<typename Sys::series, Sys>;

// Sine and cosine of angle + tail to first order in the tail, which is about the angle's rounding error.
template <class S>
PENDULA_INLINE sine_cosine<S> sincos_with_tail(sine_cosine<S> of_angle, S tail) {
  return {of_angle.sin + of_angle.cos * tail, of_angle.cos - of_angle.sin * tail};
}

}  // namespace pendula::inline PENDULA_MACHINE
