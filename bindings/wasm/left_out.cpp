// Derivatives by start and parameters would make up a third of the module. No function of it asks for them: what does
// all the same ends the instance.
#include "pendula/kernels/closed_forms.hpp"
#include "pendula/kernels/derivatives.hpp"

namespace pendula {

namespace plain {
extern const derivative_kernel derivative_runs;
const derivative_kernel derivative_runs{nullptr};
}  // namespace plain

#define PENDULA_LEFT_OUT(name)                                                                                   \
  bool name(const double*, const double*, std::span<const double>, double, std::span<const derived_by>, double*, \
            const watcher&) {                                                                                    \
    __builtin_trap();                                                                                            \
  }
PENDULA_LEFT_OUT(derivatives_of_linear)
PENDULA_LEFT_OUT(derivatives_of_simple)
PENDULA_LEFT_OUT(derivatives_of_driven_linear)

}  // namespace pendula
