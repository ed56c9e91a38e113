// What a physicist writes first: RK4 of the two rods in one plain loop, sine and cosine from the C library.
#pragma once

#include <array>

std::array<double, 4> bare_loop(std::array<double, 4> y, double h, long steps);
