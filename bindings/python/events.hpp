// Events as Python's rows.
#pragma once

#include <nanobind/stl/vector.h>

#include <vector>

#include "pendula/drive/adaptive_kernels.hpp"

namespace pendula_python {

using any_tuple = nanobind::typed<nanobind::tuple, nanobind::any, nanobind::ellipsis>;

inline std::vector<pendula_kernels::event_row> events_of(const std::vector<any_tuple>& rows) {
  namespace nb = nanobind;
  std::vector<pendula_kernels::event_row> events;
  for (const nb::tuple& row : rows)
    events.push_back({nb::cast<std::uint8_t>(row[0]), nb::cast<int>(row[1]), nb::cast<double>(row[2]),
                      nb::cast<double>(row[3]), nb::cast<bool>(row[4]), nb::cast<int>(row[5]),
                      nb::cast<std::int64_t>(row[6])});
  return events;
}

}  // namespace pendula_python
