// Runs the whole catalogue and the closed forms with several numbers of lanes and hashes every bit of what they give.
// Prints the hash of each width; with a file as argument, compares them with the hash it holds, which changes only
// where the arithmetic is changed on purpose.
#include <array>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "adaptive_bits.hpp"
#include "pendula/catalog.hpp"
#include "pendula/drive/fixed.hpp"
#include "pendula/exact/elliptic.hpp"
#include "pendula/exact/incomplete_F.hpp"
#include "pendula/exact/linear.hpp"
#include "pendula/exact/simple_times.hpp"
#include "variation_bits.hpp"

using namespace pendula;

namespace {

constexpr int trajectories = 16;

struct hash {  // FNV-1a, 64 bits
  std::uint64_t value = 14695981039346656037u;
  void add(double x) {
    unsigned char bytes[sizeof x];
    std::memcpy(bytes, &x, sizeof x);
    for (unsigned char byte : bytes) value = (value ^ byte) * 1099511628211u;
  }
};

double parameter_of(int trajectory, std::size_t i) { return 0.6 + 0.07 * trajectory + 0.11 * static_cast<double>(i); }
double component_of(int trajectory, std::size_t i) { return 2.4 - 0.31 * trajectory + 0.9 * static_cast<double>(i); }

// Every number that W trajectories from `first` on produce, lane by lane, in an order that does not depend on W.
template <class Entry, class Method, class S>
void run(std::size_t form, int first, std::vector<std::vector<double>>& numbers) {
  using Sys = typename Entry::template over<S>;
  constexpr int width = lanes<S>::count;
  std::vector<S> p(Entry::forms[form].parameters.size());
  typename Sys::state start;
  for (int l = 0; l < width; ++l) {
    for (std::size_t i = 0; i < p.size(); ++i) set_lane(p[i], l, parameter_of(first + l, i));
    for (std::size_t i = 0; i < start.size(); ++i) set_lane(start[i], l, component_of(first + l, i));
  }
  const auto system = Entry::template make<S>(form, p.data());
  std::vector<fixed_output> outputs;
  for (std::int64_t n = 0; n <= 400; n += 20) outputs.push_back({n, n % 40 == 0 ? 0.0 : 0.003});
  const auto keep = [&](const S& x) {
    for (int l = 0; l < width; ++l) numbers[static_cast<std::size_t>(first + l)].push_back(lane(x, l));
  };
  fixed_run<Method, Sys>(system, start, 0.0, 0.01, 100000)
      .through(
          outputs,
          [&](std::size_t, const auto& y) {
            for (const S& component : y) keep(component);
            keep(system.kinetic_energy(y));
            keep(system.potential_energy(y));
            for (const auto& point : system.positions(y))
              for (const S& coordinate : point) keep(coordinate);
          },
          [](auto) { return true; });
}

template <class List, class S>
std::uint64_t hash_of_catalogue() {
  hash all;
  for_each<List>([&]<class Entry>() {
    for (std::size_t form = 0; form < Entry::forms.size(); ++form)
      for_each<fixed_methods>([&]<class Method>() {
        if constexpr (takes<Method, Entry>) {
          std::vector<std::vector<double>> numbers(trajectories);
          for (int first = 0; first < trajectories; first += lanes<S>::count)
            run<Entry, Method, S>(form, first, numbers);
          for (const auto& trajectory : numbers)
            for (double x : trajectory) all.add(x);
        }
      });
  });
  return all.value;
}

constexpr event every_kind_of_event[] = {{event_kind::angle, 0, 0.3},
                                         {event_kind::angle, 0, 3.141592653589793, 1.2246467991473532e-16, true, 1},
                                         {event_kind::velocity_zero, 0},
                                         {event_kind::tip_height, 0, -0.4}};

// Parameters of a trajectory that can go through lanes: without the friction that changes from piece to piece.
template <class Entry>
std::vector<double> without_pieces(int trajectory) {
  std::vector<double> p;
  for (const parameter& row : Entry::forms[0].parameters) {
    const bool in_pieces = row.name.starts_with("coulomb") || row.name == "quadratic";
    p.push_back(in_pieces ? 0.0 : parameter_of(trajectory, p.size()));
  }
  return p;
}

// Outputs and events of the adaptive methods' runs, through the lanes or one by one.
template <class List, class S>
void adaptive_runs(hash& all) {
  for_each<List>([&]<class Entry>() {
    using Sys = typename Entry::template over<double>;
    for_each<adaptive_methods>([&]<class Method>() {
      for (const double log2_of_tolerance : {-52.0, -23.5}) {
        const auto place = [&](std::size_t n) {
          const int i = static_cast<int>(n);
          const std::vector<double> p = without_pieces<Entry>(i);
          typename Method::template stepper<Sys> stepper(Entry::template make<double>(0, p.data()), log2_of_tolerance);
          typename Sys::state start;
          for (std::size_t k = 0; k < start.size(); ++k) start[k] = component_of(i, k);
          stepper.start(0.0, start);
          return stepper;
        };
        std::vector<std::vector<double>> numbers(trajectories);
        const double times[] = {0.01, 0.02, 1.7, 3.0};
        const std::span<const event> events(every_kind_of_event, Method::name == "taylor" ? 4 : 0);
        const lanes_task task{0.0, 3.0, 1 << 20, times, events};
        if constexpr (lanes<S>::count > 1) {
          run_through_lanes<Method, Entry, S>(trajectories, task, log2_of_tolerance, place, numbers);
        } else {
          for (std::size_t n = 0; n < trajectories; ++n) {
            auto stepper = place(n);
            run_task_alone(stepper, task, numbers[n]);
          }
        }
        for (const auto& trajectory : numbers)
          for (double x : trajectory) all.add(x);
      }
    });
  });
}

// Outputs inside the steps, forward and, but for friction that can stick, backward, and events of all kinds.
template <class List>
void outputs_and_events(hash& all) {
  std::vector<double> numbers;
  for_each<List>([&]<class Entry>() {
    using Sys = typename Entry::template over<double>;
    for_each<adaptive_methods>([&]<class Method>() {
      for (const double end : {4.0, -4.0}) {
        if (Piecewise<Sys> && end < 0.0) continue;
        std::vector<double> p(Entry::forms[0].parameters.size());
        for (std::size_t k = 0; k < p.size(); ++k) p[k] = parameter_of(1, k);
        typename Method::template stepper<Sys> stepper(Entry::template make<double>(0, p.data()), -52.0);
        typename Sys::state start;
        for (std::size_t k = 0; k < start.size(); ++k) start[k] = component_of(1, k);
        stepper.start(0.0, start);
        run_alone(stepper, end, every_kind_of_event, numbers);
      }
    });
  });
  for (double x : numbers) all.add(x);
}

// Regular motions, rotations and the neighbourhood of the separatrix, at small and large times.
template <class S>
void exact_motions(hash& all) {
  constexpr int width = lanes<S>::count;
  const simple_constants<S> constants(1.3, 9.81);
  for (double omega : {0.0, 2.5, -5.4937, 0.001, 60.0}) {
    for (int first = 0; first < trajectories; first += width) {
      S theta, speed, size;
      for (int l = 0; l < width; ++l) {
        set_lane(theta, l, 3.1415926 - 0.8 * (first + l) - 1e-3 * omega);
        set_lane(speed, l, omega);
        set_lane(size, l, 0.99 - 0.06 * (first + l));
      }
      const simple_motion<S> motion(constants, start_of(constants, theta, speed));
      const auto near = motion.at(wide<S>(S(0.7))), far = motion.at(wide<S>(S(-1.2e8)));
      const auto of_k = modulus<S>::from_k(S(1.7) * size);
      const auto [am, sn, cn, dn] = jacobi_functions<S>(of_k)(S(3.0) * theta);
      for (int l = 0; l < width; ++l)
        for (const S& x : {near.theta, near.omega, far.theta, far.omega, motion.period(), am, sn, cn, dn,
                           complete_K(modulus<S>::from_kc(size)), complete_E(of_k), complete_B(of_k)})
          all.add(lane(x, l));
    }
  }
}

// What has no lanes: many digits, and the incomplete integral.
void single_numbers(hash& all) {
  for (double theta : {0.5, 2.0, -3.1, 40.0})
    for (double omega : {0.0, -1.0, 7.0}) {
      const simple_motion<double> motion({1.3, 9.81}, start_of_many_digits(1.3, 9.81, theta, omega).start);
      const auto [angle, speed, enough] = motion.at(wide<double>(3e13));
      for (double x :
           {angle, speed, simple_period(1.3, 9.81, theta, omega), simple_action(1.3, 9.81, 2.0, theta, omega),
            simple_time_at(1.3, 9.81, theta, omega, 0.3), linear_time_at(1.3, 9.81, theta, omega, 0.3),
            incomplete_F(theta, modulus<double>::from_k(0.3 + 0.01 * omega))})
        all.add(x);
      const auto frequency = natural_frequency_in_many_digits(1.3, 9.81);
      const auto [head, tail] = wide_of(frequency);
      const auto [rate, middle, rest] = words_of(frequency / pi_in_many_digits());
      const double frequency_words[] = {head, tail}, rate_words[] = {rate, middle, rest};
      const auto linear = linear_motion<double>(frequency_words, rate_words, theta, omega).at(wide<double>(1e9));
      all.add(linear.theta);
      all.add(linear.omega);
    }
}

// As many lanes as S has, but not more than a register: the adaptive methods are large to compile.
template <class S>
using of_machine = std::conditional_t<(lanes<S>::count > lanes_of_machine), pack<double, lanes_of_machine>, S>;

template <class S>
std::uint64_t hash_of_ideal() {
  hash all{hash_of_catalogue<ideal_systems, S>()};
  exact_motions<S>(all);
  single_numbers(all);
  adaptive_runs<ideal_systems, of_machine<S>>(all);
  outputs_and_events<ideal_systems>(all);
  return all.value;
}

template <class S>
std::uint64_t hash_of_real() {
  hash all{hash_of_catalogue<real_systems, S>()};
  adaptive_runs<real_systems, of_machine<S>>(all);
  outputs_and_events<real_systems>(all);
  return all.value;
}

// Derivatives: variations in lanes, and numbers that carry theirs.
template <class S>
std::uint64_t hash_of_derivatives() {
  hash all;
  const auto add = [&](const std::vector<std::vector<double>>& numbers) {
    for (const auto& each : numbers)
      for (double x : each) all.add(x);
  };
  add(varied_runs<of_machine<S>, 1, variation_use::megno>());
  add(varied_runs<of_machine<S>, 2, variation_use::free>());
  add(varied_runs<of_machine<S>, 4, variation_use::orthogonal>());
  add({derived_run<driven_pendulum>(20.0), derived_run<double_pendulum>(5.0)});
  return all.value;
}

// How many lanes are hashed: each number of them takes long to compile.
#ifndef PENDULA_LANES
#define PENDULA_LANES 1, 2, 4, 8
#endif

template <int... width>
std::vector<std::array<std::uint64_t, 3>> hashes(std::integer_sequence<int, width...>) {
  const auto of = []<class S>(S) {
    return std::array{hash_of_ideal<S>(), hash_of_real<S>(), hash_of_derivatives<S>()};
  };
  return {of(std::conditional_t<width == 1, double, pack<double, width == 1 ? 2 : width>>{})...};
}

// By the C library, as not every C++ library for WebAssembly has files.
std::string first_line_of(const char* path) {
  char line[64] = "";
  if (std::FILE* const file = std::fopen(path, "r")) {
    if (std::fgets(line, sizeof line, file)) line[std::strcspn(line, "\n")] = 0;
    std::fclose(file);
  }
  return line;
}

}  // namespace

// Of the ideal systems, of those with friction and drive, and of derivatives.
int main(int count, char** arguments) {
  const std::vector<int> widths{PENDULA_LANES};
  const auto found = hashes(std::integer_sequence<int, PENDULA_LANES>{});
  bool same = true;
  std::string expected;
  if (count > 1) expected = first_line_of(arguments[1]);
  for (std::size_t i = 0; i < found.size(); ++i) {
    char text[51];
    std::snprintf(text, sizeof text, "%016llx %016llx %016llx", static_cast<unsigned long long>(found[i][0]),
                  static_cast<unsigned long long>(found[i][1]), static_cast<unsigned long long>(found[i][2]));
    std::printf("%d lanes: %s\n", widths[i], text);
    same = same && (count > 1 ? text == expected : found[i] == found[0]);
  }
  if (!same) std::printf("not the same bits%s%s\n", count > 1 ? ", expected " : "", expected.c_str());
  return same ? 0 : 1;
}
