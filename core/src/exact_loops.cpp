// The loops of the closed form.
#include <algorithm>

#include "pendula/exact/linear.hpp"
#include "pendula/exact/simple.hpp"
#include "pendula/kernels/exact_kernels.hpp"

namespace {

using namespace pendula;

// Twice what a register holds: the long chains of a `wide` number leave room for a second one beside.
using lanes_of_numbers = pack<double, 2 * lanes_of_machine>;
constexpr std::size_t width = lanes<lanes_of_numbers>::count;

void note_lacking(lanes_of_numbers::integers enough, unsigned char* lacking, std::size_t count) {
  if (all_lanes(enough)) return;
  for (std::size_t l = 0; l < std::min(width, count); ++l) lacking[l] = !lane_of(enough, static_cast<int>(l));
}

// Calls block(from, to, count) for `width` numbers of `in_size` doubles at a time; the last block, where it is short,
// from and to a place of its own, where the lanes left over hold zeros.
template <int in_size, class Block>
void by_blocks(const double* from, std::size_t count, double* to, Block&& block) {
  std::size_t i = 0;
  for (; i + width <= count; i += width) block(from + in_size * i, to + 2 * i, i);
  if (i == count) return;
  double in[in_size * width] = {}, out[2 * width];
  std::copy_n(from + in_size * i, in_size * (count - i), in);
  block(in, out, i);
  std::copy_n(out, 2 * (count - i), to + 2 * i);
}

void states(double length, double gravity, const double* states, std::size_t count, double t, double t0, double* out,
            unsigned char* lacking) {
  using S = lanes_of_numbers;
  const simple_constants<S> constants(length, gravity);
  const wide<S> elapsed(two_sum(S(t), S(-t0)));
  by_blocks<2>(states, count, out, [&](const double* from, double* to, std::size_t i) {
    S theta, omega;
    load_pairs(from, theta, omega);
    const auto point = simple_motion<S>(constants, start_of(constants, theta, omega)).at(elapsed);
    store_pairs(point.theta, point.omega, to);
    note_lacking(point.digits_enough, lacking + i, count - i);
  });
}

void times(double length, double gravity, const double* state, const double* t, std::size_t count, double t0,
           double* out, unsigned char* lacking) {
  using S = lanes_of_numbers;
  const simple_constants<S> constants(length, gravity);
  const simple_motion<S> motion(constants, start_of(constants, S(state[0]), S(state[1])));
  by_blocks<1>(t, count, out, [&](const double* from, double* to, std::size_t i) {
    S time;
    load(from, time);
    const auto point = motion.at(wide<S>(two_sum(time, S(-t0))));
    store_pairs(point.theta, point.omega, to);
    note_lacking(point.digits_enough, lacking + i, count - i);
  });
}

void linear(const double frequency[2], const double rate[3], const double* state, const double* t, std::size_t count,
            double t0, double* out) {
  using S = lanes_of_numbers;
  const linear_motion<S> motion(frequency, rate, state[0], state[1]);
  by_blocks<1>(t, count, out, [&](const double* from, double* to, std::size_t) {
    S time;
    load(from, time);
    const auto point = motion.at(wide<S>(two_sum(time, S(-t0))));
    store_pairs(point.theta, point.omega, to);
  });
}

}  // namespace

namespace pendula::PENDULA_MACHINE {
extern const exact_kernel exact_loops{states, times, linear};
}  // namespace pendula::PENDULA_MACHINE
