#include "pendula/kernels/long_runs.hpp"

namespace pendula {

std::vector<long_run_kernel> long_runs() {
  std::vector<long_run_kernel> all;
  for (const auto part : {shorter_long_runs(), longer_long_runs()}) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace pendula
