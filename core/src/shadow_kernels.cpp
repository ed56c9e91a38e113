// Built once for each machine, with its options and `pendula` defined as a name of its own, so that no inline function
// of one build can stand in for that of another.
#include "pendula/drive/shadow_kernels.hpp"

#include "pendula/catalog.hpp"
#include "pendula/scalar/wide_sincos.hpp"

namespace {

using namespace pendula;
using pendula_kernels::shadow;
using pendula_kernels::shadow_request;
using pendula_kernels::two_doubles;

using number = wide<double>;

template <class Sys>
class taylor_shadow final : public shadow {
 public:
  taylor_shadow(const Sys& system, const shadow_request& asked)
      : stepper_(system, -104.0), time_(asked.t0), direction_(asked.direction) {
    typename Sys::state start;
    for (std::size_t i = 0; i < start.size(); ++i) start[i] = number(asked.state[i]);
    stepper_.start(start);
    stepper_.expand(direction_);
  }

  void proceed() override {
    time_ = end();
    stepper_.proceed(stepper_.after(number(stepper_.length())));
    stepper_.expand(direction_);
  }
  two_doubles step_end() const override { return {end().hi, end().lo}; }
  void angles(two_doubles time, two_doubles* to) const override {
    const auto there = stepper_.after(number(time.head, time.tail) - time_).head;
    for (std::size_t i = 0; i < Sys::dimension / 2; ++i) to[i] = {there[i].hi, there[i].lo};
  }

 private:
  number end() const { return time_ + number(stepper_.length()); }

  taylor_stepper<Sys> stepper_;
  number time_;
  double direction_;
};

std::unique_ptr<shadow> make(const shadow_request& asked) {
  std::unique_ptr<shadow> made;
  with<systems>(asked.system, [&]<class Entry>() {
    using Sys = typename Entry::template over<number>;
    number parameters[16];
    for (std::size_t i = 0; i < Entry::forms[asked.form].parameters.size(); ++i)
      parameters[i] = number(asked.parameters[i]);
    made = std::make_unique<taylor_shadow<Sys>>(Entry::template make<number>(asked.form, parameters), asked);
  });
  return made;
}

}  // namespace

namespace pendula_kernels {
extern const shadow_maker PENDULA_KERNELS{make};
}  // namespace pendula_kernels
