// The angle of a point in the plane.
#pragma once

#include "pendula/scalar/choose.hpp"

namespace pendula::inline PENDULA_MACHINE {

namespace detail {
// (atan x − x)/x for |x| ≤ 7/16, x² given: the coefficients of fdlibm's s_atan.c (Sun Microsystems 1993).
template <class S>
PENDULA_INLINE S arctangent_polynomial(S z) {
  const S w = z * z;
  const S even = S(3.33333333333329318027e-01) +
                 w * (S(1.42857142725034663711e-01) +
                      w * (S(9.09088713343650656196e-02) +
                           w * (S(6.66107313738753120669e-02) +
                                w * (S(4.97687799461593236017e-02) + w * S(1.62858201153657823623e-02)))));
  const S odd = S(-1.99999999998764832476e-01) +
                w * (S(-1.11111104054623557880e-01) +
                     w * (S(-7.69187620504482999495e-02) +
                          w * (S(-5.83357013379057348645e-02) + w * S(-3.65315727442169155270e-02))));
  return -(z * (even + z * odd));
}
}  // namespace detail

// The angle from (1, 0) to (x, y), in [−π, π], to about 1 ulp. The plane is turned back by the nearest of 0, atan 1/2,
// atan 1, atan 2 and π/2 first, which makes the tangent of the rest at most 0.24; these multiples of x and y are exact.
template <class S>
PENDULA_INLINE S angle_of(S y, S x) {
  const S up = magnitude(y), right = magnitude(x);
  S tangent(0.0), angle(0.0), angle_tail(0.0);
  const auto beyond = [&](double border, double t, double of_t, double of_t_tail) {
    const auto so = less(right * S(border), up);
    tangent = choose(so, S(t), tangent);
    angle = choose(so, S(of_t), angle);
    angle_tail = choose(so, S(of_t_tail), angle_tail);
    return so;
  };
  beyond(0.2361, 0.5, 0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56);
  beyond(0.7208, 1.0, 0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55);
  beyond(1.3874, 2.0, 0x1.1b6e192ebbe44p+0, 0x1.b1b466a88828ep-54);
  const auto steep = beyond(4.2361, 0.0, 0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54);
  const S above = choose(steep, -right, up) - tangent * right, below = choose(steep, up, right) + tangent * up;
  const S t = above / below;
  const S within = angle + (t + (t * detail::arctangent_polynomial(t * t) + angle_tail));
  const S mirrored = S(0x1.921fb54442d18p+1) - (within - S(0x1.1a62633145c07p-53));
  return times_sign_of(choose(less(x, S(0.0)), mirrored, within), y);
}

}  // namespace pendula::inline PENDULA_MACHINE
