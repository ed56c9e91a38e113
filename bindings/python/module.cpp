// The extension pendula._core: batches in, arrays out, no logic.
#include <nanobind/nanobind.h>

void bind_catalog(nanobind::module_& m);
void bind_request(nanobind::module_& m);
void bind_runs(nanobind::module_& m);
void bind_closed_forms(nanobind::module_& m);
void bind_maps(nanobind::module_& m);

NB_MODULE(_core, m) {
  nanobind::set_leak_warnings(false);  // a run that is still alive at the end of a program is no leak
  m.doc() = "The compiled core of pendula. Use the package; this module has no checks.";
  bind_catalog(m);
  bind_request(m);
  bind_runs(m);
  bind_closed_forms(m);
  bind_maps(m);
}
