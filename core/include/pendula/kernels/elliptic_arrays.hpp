// The elliptic functions over arrays. A modulus is given as k or, `complement`, as √(1 − k²). Each is false where
// `watch` ended it.
#pragma once

#include <span>

#include "pendula/kernels/result.hpp"

namespace pendula {

struct moduli {
  std::span<const double> values;
  bool complement;
};

bool complete_K_of(const moduli&, double* out, const watcher&);
bool complete_E_of(const moduli&, double* out, const watcher&);
bool incomplete_F_of(std::span<const double> phi, const moduli&, double* out, const watcher&);
bool K_series_of(const moduli&, long terms, double* out, const watcher&);

struct jacobi_arrays {
  double *am, *sn, *cn, *dn;
};
bool jacobi_of(std::span<const double> u, const moduli&, const jacobi_arrays& out, const watcher&);

}  // namespace pendula
