// Shadows of motions, worked out with twice a double's digits.
#include <vector>

#include "pendula/catalog.hpp"
#include "pendula/drive/pieces.hpp"
#include "pendula/kernels/shadow_kernels.hpp"
#include "pendula/scalar/wide_sincos.hpp"

namespace {

using namespace pendula;

using wide_number = wide<double>;

template <class Sys>
class taylor_shadow final : public shadow {
 public:
  taylor_shadow(const Sys& system, const request& asked)
      : stepper_(system, -104.0), time_(asked.t0), direction_(asked.direction()) {
    typename Sys::state start;
    for (std::size_t i = 0; i < start.size(); ++i) start[i] = wide_number(asked.state[i]);
    stepper_.start(time_, start);
    expand();
  }

  void proceed() override {
    const wide_number next = end();
    if (piece_ends_) {
      if constexpr (Piecewise<Sys>) pieces_.begin_next(stepper_, {next, wide_number(0.0)}, *piece_ends_);
    } else {
      stepper_.proceed(stepper_.at_end());
    }
    time_ = next;
    expand();
  }
  two_doubles step_end() const override { return {end().hi, end().lo}; }
  void angles(two_doubles time, two_doubles* to) const override {
    const auto there = stepper_.after(wide_number(time.head, time.tail) - time_).head;
    for (std::size_t i = 0; i < degrees_of_freedom<Sys>; ++i) to[i] = {there[i].hi, there[i].lo};
  }

 private:
  void expand() {
    const head_and_tail<wide_number> now{time_, wide_number(0.0)};
    stepper_.expand(now, direction_);
    if constexpr (Piecewise<Sys>) {
      pieces_.mended(stepper_, now, direction_);
      piece_ends_ = pieces_.end_in_step(stepper_, now);
    }
  }
  wide_number end() const { return time_ + piece_ends_.value_or(wide_number(stepper_.length())); }

  taylor_stepper<Sys> stepper_;
  piece_follower<taylor_stepper<Sys>> pieces_;
  std::optional<wide_number> piece_ends_;  // after the start of the step
  wide_number time_;
  double direction_;
};

std::unique_ptr<shadow> make(const request& asked) {
  std::unique_ptr<shadow> made;
  with<systems>(asked.system.name, [&]<class Entry>() {
    using Sys = typename Entry::template over<wide_number>;
    if constexpr (Analytic<Sys>) {
      const std::vector<wide_number> parameters(asked.system.parameters.begin(), asked.system.parameters.end());
      made = std::make_unique<taylor_shadow<Sys>>(
          Entry::template make<wide_number>(asked.system.form, parameters.data()), asked);
    }
  });
  return made;
}

}  // namespace

namespace pendula::PENDULA_MACHINE {
extern const shadow_maker shadows{make};
}  // namespace pendula::PENDULA_MACHINE
