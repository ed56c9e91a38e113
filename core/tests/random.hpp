// The same random numbers in every run.
#pragma once

#include <cmath>
#include <random>

inline std::mt19937_64 generator() { return std::mt19937_64(20240305); }
