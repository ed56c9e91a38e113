#include "bare_loop.hpp"

#include <cmath>

namespace {

constexpr double A = 4.0 / 3.0, B = 1.0 / 3.0, C = 0.5, D = 1.5 * 9.81, E = 0.5 * 9.81;

inline void rhs(const double* y, double* slope) {
  const double delta = y[0] - y[1], c = std::cos(delta), s = std::sin(delta);
  const double r1 = -C * s * y[3] * y[3] - D * std::sin(y[0]), r2 = C * s * y[2] * y[2] - E * std::sin(y[1]);
  const double coupling = C * c, inverse = 1.0 / (A * B - coupling * coupling);
  slope[0] = y[2];
  slope[1] = y[3];
  slope[2] = (B * r1 - coupling * r2) * inverse;
  slope[3] = (A * r2 - coupling * r1) * inverse;
}

}  // namespace

std::array<double, 4> bare_loop(std::array<double, 4> y, double h, long steps) {
  double k1[4], k2[4], k3[4], k4[4], u[4];
  for (long n = 0; n < steps; ++n) {
    rhs(y.data(), k1);
    for (int i = 0; i < 4; ++i) u[i] = y[i] + 0.5 * h * k1[i];
    rhs(u, k2);
    for (int i = 0; i < 4; ++i) u[i] = y[i] + 0.5 * h * k2[i];
    rhs(u, k3);
    for (int i = 0; i < 4; ++i) u[i] = y[i] + h * k3[i];
    rhs(u, k4);
    for (int i = 0; i < 4; ++i) y[i] += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
  }
  return y;
}
