// The extension pendula._core: batches in, arrays out, no logic.
#include <nanobind/nanobind.h>

void bind_catalog(nanobind::module_& m);
void bind_systems(nanobind::module_& m);
void bind_solve(nanobind::module_& m);
void bind_adaptive(nanobind::module_& m);
void bind_ensemble(nanobind::module_& m);
void bind_trust(nanobind::module_& m);
void bind_exact(nanobind::module_& m);
void bind_elliptic(nanobind::module_& m);

NB_MODULE(_core, m) {
  m.doc() = "The compiled core of pendula. Use the package; this module has no checks.";
  bind_catalog(m);
  bind_systems(m);
  bind_solve(m);
  bind_adaptive(m);
  bind_ensemble(m);
  bind_trust(m);
  bind_exact(m);
  bind_elliptic(m);
}
