// The simple pendulum released from rest, in closed form: Herrera et al. (2024), eq. 21 with the modulus k = sin(θ0/2)
// throughout.
#pragma once

#include "pendula/exact/elliptic.hpp"

namespace pendula {

// k and its complement each from its own formula: cos(θ0/2) keeps the digits that 1 − k² loses near the top.
inline modulus modulus_of_amplitude(double amplitude) {
  return {std::fabs(std::sin(0.5 * amplitude)), std::fabs(std::cos(0.5 * amplitude))};
}

class exact_simple {
 public:
  exact_simple(double length, double gravity, double theta0)
      : frequency_(std::sqrt(gravity / length)),
        turns_(2.0 * std::numbers::pi * std::nearbyint(theta0 / (2.0 * std::numbers::pi))),
        theta0_(theta0),
        sign_(std::sin(0.5 * (theta0 - turns_)) < 0.0 ? -1.0 : 1.0),
        m_(modulus_of_amplitude(theta0)),
        elliptic_(m_) {}

  // With u = ωn t: sin(θ/2) = k sn(u + K) and cos(θ/2) = dn(u + K), so tan(θ/2) = (k/kc) cn u, which keeps its digits
  // next to the turning points, and θ̇ = 2 ωn k cn(u + K) = −2 ωn k kc sn u/dn u (DLMF table 22.4.3).
  void at(double t, double& theta, double& omega) const {
    if (t == 0.0 || m_.k == 0.0) {
      theta = theta0_;
      omega = 0.0;
      return;
    }
    const auto [am, sn, cn, dn] = elliptic_(frequency_ * t);
    theta = turns_ + sign_ * 2.0 * std::atan(m_.k * cn / m_.kc);
    omega = -sign_ * 2.0 * frequency_ * m_.k * m_.kc * sn / dn;
  }

 private:
  double frequency_, turns_, theta0_, sign_;
  modulus m_;
  jacobi elliptic_;
};

}  // namespace pendula
