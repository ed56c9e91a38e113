// The truth for the damped, driven linear pendulum: with (cos, sin) of the drive's phase as further components its
// equations are y' = M y, and y(t) = e^{Mt} y(0) by the power series, scaling and squaring (Higham 2008, Functions of
// Matrices, 10.3) in 150 digits. It knows no roots and no regimes.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "pendula/exact/driven_linear.hpp"

namespace truth {

using long_number =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<150>, boost::multiprecision::et_off>;
using matrix = std::array<std::array<long_number, 4>, 4>;

inline matrix operator*(const matrix& a, const matrix& b) {
  matrix product{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k)
        if (a[i][k] != 0 && b[k][j] != 0) product[i][j] += a[i][k] * b[k][j];
  return product;
}

// The first terms' sizes fall as those of 2^-20n/n!: after 24 of them they are below 2^-550.
inline matrix exponential(matrix m) {
  long_number norm = 0;
  for (const auto& row : m) {
    long_number sum = 0;
    for (const auto& x : row) sum += abs(x);
    norm = sum > norm ? sum : norm;
  }
  int squarings = 0;
  for (; norm > ldexp(long_number(1), -20); norm /= 2) ++squarings;
  matrix sum{}, term{};
  for (std::size_t i = 0; i < 4; ++i) sum[i][i] = term[i][i] = 1;
  for (auto& row : m)
    for (auto& x : row) x = ldexp(x, -squarings);
  for (int n = 1; n <= 24; ++n) {
    term = term * m;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) sum[i][j] += term[i][j] /= n;
  }
  for (; squarings > 0; --squarings) sum = sum * sum;
  return sum;
}

struct driven_state {
  long_number theta, omega;
};

inline driven_state driven_linear(const pendula::driven_linear_parameters& of, double theta, double omega, double t0,
                                  double t) {
  const long_number inertia = long_number(of.mass) * of.length * of.length, elapsed = long_number(t) - t0;
  const long_number phase = long_number(of.drive_frequency) * t0 + of.drive_phase;
  matrix m{};
  m[0][1] = elapsed;
  m[1][0] = -(elapsed * of.gravity / of.length);
  m[1][1] = -(elapsed * of.viscous / inertia);
  m[1][2] = elapsed * of.torque / inertia;
  m[2][3] = -(elapsed * of.drive_frequency);
  m[3][2] = elapsed * of.drive_frequency;
  const matrix moved = exponential(m);
  const std::array<long_number, 4> start{theta, omega, cos(phase), sin(phase)};
  driven_state y{0, 0};
  for (std::size_t k = 0; k < 4; ++k) {
    y.theta += moved[0][k] * start[k];
    y.omega += moved[1][k] * start[k];
  }
  return y;
}

}  // namespace truth
