// Many trajectories at once, and how long each of them is right.
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <limits>

#include "arrays.hpp"
#include "described.hpp"
#include "events.hpp"
#include "pendula/drive/ensemble_kernels.hpp"
#include "pendula/drive/horizon.hpp"
#include "pendula/drive/outcome.hpp"
#include "pool.hpp"

using namespace pendula_python;
using namespace nb::literals;
using namespace pendula_kernels;

namespace {

template <class T>
struct numbers {
  T* data;
  nb::ndarray<nb::numpy, T, nb::ndim<1>> array;

  explicit numbers(std::size_t count) {
    data = new T[count]{};
    array = {data, {count}, nb::capsule(data, [](void* p) noexcept { delete[] static_cast<T*>(p); })};
  }
};

struct found_event {
  std::size_t trajectory;
  int place;
  double t;
  std::array<double, 4> y;
};

// Where all that is told goes: every trajectory has a place of its own.
struct results {
  std::size_t dimension, outputs;
  double* states;
  std::uint8_t* ended;
  std::int64_t* steps;
  double* reached;
};

struct worker final : ensemble_receiver {
  worker(pool& work, const results& to) : work(work), to(to) {}

  std::size_t next() override { return work.next(); }
  void output(std::size_t trajectory, std::size_t place, const double* y) override {
    std::copy_n(y, to.dimension, to.states + (trajectory * to.outputs + place) * to.dimension);
  }
  void event(std::size_t trajectory, int place, double t, const double* y) override {
    events.push_back({trajectory, place, t, {}});
    std::copy_n(y, to.dimension, events.back().y.begin());
  }
  void finish(std::size_t trajectory, std::uint8_t how, std::int64_t taken, double until) override {
    to.ended[trajectory] = how;
    to.steps[trajectory] = taken;
    to.reached[trajectory] = until;
    work.done();
  }
  bool go_on() override { return work.go_on(); }

  pool& work;
  const results& to;
  std::vector<found_event> events;
};
static_assert(pool::none == no_more);

// (trajectories, times, states) of each event, by trajectory and time.
nb::list by_event(const std::vector<worker>& workers, std::size_t kinds, std::size_t dimension) {
  nb::list all;
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    std::vector<const found_event*> mine;
    for (const worker& each : workers)
      for (const found_event& event : each.events)
        if (event.place == static_cast<int>(kind)) mine.push_back(&event);
    std::ranges::stable_sort(mine, {}, &found_event::trajectory);
    numbers<std::int64_t> trajectories(mine.size());
    new_array times({mine.size()}), states({mine.size(), dimension});
    for (std::size_t i = 0; i < mine.size(); ++i) {
      trajectories.data[i] = static_cast<std::int64_t>(mine[i]->trajectory);
      times.data[i] = mine[i]->t;
      std::copy_n(mine[i]->y.begin(), dimension, states.data + i * dimension);
    }
    all.append(nb::make_tuple(trajectories.array, times.array, states.array));
  }
  return all;
}

std::size_t apart(const matrix_in& parameters) { return parameters.shape(0) == 1 ? 0 : parameters.shape(1); }

any_tuple run(const std::string& system, std::size_t form, const matrix_in& parameters, const std::string& method,
              const matrix_in& states, double t0, const array_in& times, double step, double log2_of_tolerance,
              std::int64_t step_limit, const std::vector<any_tuple>& events, std::size_t threads, nb::object progress) {
  const std::size_t count = states.shape(0), dimension = states.shape(1), outputs = times.shape(0);
  const attendance attending{std::move(progress)};
  const std::vector<event_row> rows = events_of(events);
  new_array found({count, outputs, dimension});
  numbers<std::uint8_t> ended(count);
  numbers<std::int64_t> steps(count);
  new_array reached({count});
  std::fill_n(found.data, count * outputs * dimension, std::numeric_limits<double>::quiet_NaN());
  const ensemble_request asked{system,
                               form,
                               parameters.data(),
                               apart(parameters),
                               method,
                               states.data(),
                               t0,
                               times.data()[outputs - 1],
                               step,
                               log2_of_tolerance,
                               step_limit,
                               {times.data(), outputs},
                               rows};
  const results to{dimension, outputs, found.data, ended.data, steps.data, reached.data};
  pool work(count);
  std::vector<worker> workers(std::max<std::size_t>(1, threads), worker(work, to));
  bool well;
  {
    nb::gil_scoped_release released;
    well = work.run(workers.size(), attending, [&](std::size_t i) { run_ensemble(asked, dimension, workers[i]); });
  }
  if (!well) throw nb::python_error();
  return nb::make_tuple(found.array, ended.array, steps.array, reached.array,
                        by_event(workers, rows.size(), dimension));
}

// The trust horizon of each run of an ensemble, which reached the time `reached` of its own.
auto horizons(const std::string& system, std::size_t form, const matrix_in& parameters, const std::string& method,
              const matrix_in& states, double t0, const array_in& reached, double step, double log2_of_tolerance,
              double certify, std::size_t threads, nb::object progress) {
  const std::size_t count = states.shape(0), dimension = states.shape(1);
  const attendance attending{std::move(progress)};
  new_array found({count});
  pool work(count);
  const auto one = [&](std::size_t n) {
    const double end = reached.data()[n];
    if (end == t0) return std::numeric_limits<double>::infinity();
    return pendula::trust_horizon({system,
                                   form,
                                   {parameters.data() + n * apart(parameters), parameters.shape(1)},
                                   {states.data() + n * dimension, dimension},
                                   method,
                                   t0,
                                   end,
                                   step,
                                   log2_of_tolerance,
                                   certify},
                                  [&](double) { return work.go_on(); })
        .value_or(std::numeric_limits<double>::quiet_NaN());
  };
  bool well;
  {
    nb::gil_scoped_release released;
    well = work.run(std::max<std::size_t>(1, threads), attending, [&](std::size_t) {
      for (std::size_t n; (n = work.next()) != pool::none; work.done()) found.data[n] = one(n);
    });
  }
  if (!well) throw nb::python_error();
  return found.array;
}

std::vector<std::string> outcomes() {
  std::vector<std::string> names;
  for (int i = 0; i <= static_cast<int>(pendula::outcome::interrupted); ++i)
    names.emplace_back(pendula::name_of(static_cast<pendula::outcome>(i)));
  return names;
}

}  // namespace

void bind_ensemble(nb::module_& m) {
  m.def("ensemble", &run, "system"_a, "form"_a, "parameters"_a, "method"_a, "states"_a, "t0"_a, "times"_a, "step"_a,
        "log2_of_tolerance"_a, "step_limit"_a, "events"_a, "threads"_a, "progress"_a.none(),
        "States (n, times, d), how each run ended, its steps, the time it reached, and (trajectories, times, states) "
        "of each event, from "
        "states (n, d) and parameters (n, p), or (1, p) for all.");
  m.def("trust_horizons", &horizons, "system"_a, "form"_a, "parameters"_a, "method"_a, "states"_a, "t0"_a, "reached"_a,
        "step"_a, "log2_of_tolerance"_a, "certify"_a, "threads"_a, "progress"_a.none(),
        "The trust horizon (n,) of each run of an ensemble, which came to the time `reached` (n,).");
  m.def("outcomes", &outcomes, "How runs end, by number.");
}
