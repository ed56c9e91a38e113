// The linear pendulum in closed form: Herrera et al. (2024), eq. 11, and its derivative (9), where ω stands for ωn.
#pragma once

#include <cmath>

namespace pendula {

class exact_linear {
 public:
  exact_linear(double length, double gravity, double theta0, double omega0)
      : frequency_(std::sqrt(gravity / length)), theta0_(theta0), omega0_(omega0) {}

  void at(double t, double& theta, double& omega) const {
    const double s = std::sin(frequency_ * t), c = std::cos(frequency_ * t);
    theta = theta0_ * c + omega0_ / frequency_ * s;
    omega = omega0_ * c - theta0_ * frequency_ * s;
  }

 private:
  double frequency_, theta0_, omega0_;
};

}  // namespace pendula
