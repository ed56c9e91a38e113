// Motions of any system with variations, one after the other, by numbers that carry their derivatives.
#include <algorithm>
#include <array>
#include <cmath>

#include "pendula/drive/growth.hpp"
#include "pendula/kernels/variations.hpp"

namespace pendula {

namespace {

constexpr std::size_t most = most_variations;
static_assert(most == derived_at_once);

double length_of(const std::array<double, 4>& v) { return std::sqrt(square_of_length<double>(v)); }

class varied_run final : public derivative_receiver {
 public:
  varied_run(const request& asked, const varied_by& by, ensemble_receiver& to, std::size_t trajectory)
      : asked_(asked),
        by_(by),
        to_(to),
        trajectory_(trajectory),
        d_(asked.state.size()),
        values_(d_),
        changes_(d_ * most),
        told_(by.output_size(d_)) {}

  void run() {
    std::vector<double> start((d_ + asked_.system.parameters.size()) * most);
    for (std::size_t i = 0; i < by_.count; ++i)
      for (std::size_t j = 0; j < d_; ++j) start[j * most + i] = by_.start[i * d_ + j];
    changes_.assign(start.begin(), start.begin() + static_cast<std::ptrdiff_t>(d_ * most));
    if (by_.use == variation_use::orthogonal) {
      make_orthogonal();
      std::ranges::copy(changes_, start.begin());
    }
    values_ = asked_.state;
    first_length_ = logarithm(length_of(variation(0)));
    std::size_t at_start = 0;
    for (; at_start < asked_.times.size() && asked_.times[at_start] == asked_.t0; ++at_start) tell(integrals_);
    run_end end{outcome::reached_end, 0, 0, asked_.t0};
    if (asked_.end() != asked_.t0)
      end = best_derivative_kernel().run(asked_, std::span(asked_.times).subspan(at_start), start, *this);
    to_.finish(trajectory_, end);
  }

  void output(const derived_step& step, double tau) override {
    const auto here = integrals_after(step, tau);
    step.at(tau, values_.data(), changes_.data());
    tell(here);
  }
  void step(const derived_step& step, double stop) override {
    integrals_ = integrals_after(step, stop);
    step.at(stop, values_.data(), changes_.data());
    mixes_ = by_.use == variation_use::orthogonal ? to_orthogonal() : to_fitting_length();
  }
  const double* mixing() override { return mixes_ ? matrix_.data() : nullptr; }
  bool go_on(double) override { return to_.go_on(); }

 private:
  static constexpr double often = 0x1p10;  // a growth that leaves ten digits of what is made orthogonal

  std::array<double, 4> variation(std::size_t i) const {
    std::array<double, 4> v{};
    for (std::size_t j = 0; j < d_; ++j) v[j] = changes_[j * most + i];
    return v;
  }

  megno_integrals<double> integrals_after(const derived_step& step, double tau) {
    if (by_.use != variation_use::megno || tau == 0.0) return integrals_;
    std::array<double, gauss_of_eight::count> growth;
    for (std::size_t node = 0; node < growth.size(); ++node) {
      step.at(tau * gauss_8.node[node], values_.data(), changes_.data());
      growth[node] = logarithm(length_of(variation(0))) + (fifth_[0] * 300.0 * ln_2 - first_length_);
    }
    return integrals_.after(step.start() - asked_.t0, tau, growth);
  }

  // Whether long variations are to be made shorter, or short ones, where friction acts, longer, by `matrix_`.
  bool to_fitting_length() {
    matrix_ = {};
    bool any = false;
    for (std::size_t i = 0; i < most; ++i) {
      const double length = i < by_.count ? length_of(variation(i)) : 1.0;
      const bool longer = length > taken_off, shorter = length > 0.0 && length < 1.0 / taken_off;
      matrix_[i * most + i] = longer ? 1.0 / taken_off : shorter ? taken_off : 1.0;
      fifth_[i] += longer ? 1.0 : shorter ? -1.0 : 0.0;
      any = any || longer || shorter;
    }
    return any;
  }
  // Where friction acts, the shorter ones turn into the longer ones' directions before those have grown.
  bool to_orthogonal() {
    const auto lengths = make_orthogonal();
    const auto [least, largest] = std::minmax_element(lengths.begin(), lengths.begin() + by_.count);
    if (*least > (1.0 / often) && *largest < often) return false;
    for (std::size_t i = 0; i < by_.count; ++i) fifth_[i] += logarithm(lengths[i]);
    return true;
  }

  // Gram and Schmidt's, of `changes_`; the lengths that were taken off. `matrix_` is what the columns were multiplied
  // by.
  std::array<double, most> make_orthogonal() {
    std::array<double, most> lengths{};
    matrix_ = {};
    for (std::size_t i = 0; i < most; ++i) matrix_[i * most + i] = 1.0;
    const auto add = [this](std::size_t to, std::size_t from, double times) {
      for (std::size_t j = 0; j < d_; ++j) changes_[j * most + to] += times * changes_[j * most + from];
      for (std::size_t j = 0; j < most; ++j) matrix_[j * most + to] += times * matrix_[j * most + from];
    };
    for (std::size_t i = 0; i < by_.count; ++i) {
      for (std::size_t before = 0; before < i; ++before) {
        double along = 0.0;
        for (std::size_t j = 0; j < d_; ++j) along += changes_[j * most + i] * changes_[j * most + before];
        add(i, before, -along);
      }
      lengths[i] = length_of(variation(i));
      add(i, i, 1.0 / lengths[i] - 1.0);
    }
    return lengths;
  }

  void tell(const megno_integrals<double>& integrals) {
    std::ranges::copy(values_, told_.begin());
    auto fifth = fifth_;
    if (by_.use == variation_use::orthogonal) {
      const auto lengths = make_orthogonal();
      for (std::size_t i = 0; i < by_.count; ++i) fifth[i] += logarithm(lengths[i]);
    }
    for (std::size_t i = 0; i < by_.count; ++i) {
      const auto mine = variation(i);
      std::copy_n(mine.begin(), d_, told_.begin() + static_cast<std::ptrdiff_t>(d_ + (d_ + 1) * i));
      told_[d_ + (d_ + 1) * i + d_] = fifth[i];
    }
    if (by_.use == variation_use::megno) {
      told_[told_.size() - 2] = integrals.of_growth;
      told_[told_.size() - 1] = integrals.of_megno;
    }
    to_.output(trajectory_, outputs_told_++, told_.data());
  }

  const request& asked_;
  const varied_by& by_;
  ensemble_receiver& to_;
  std::size_t trajectory_, d_, outputs_told_ = 0;
  std::vector<double> values_, changes_, told_;
  std::array<double, most> fifth_{};
  std::array<double, most * most> matrix_{};
  megno_integrals<double> integrals_;
  double first_length_ = 0.0;
  bool mixes_ = false;
};

}  // namespace

void vary_alone(const request& asked, const varied_by& by, ensemble_receiver& to, std::size_t trajectory) {
  varied_run(asked, by, to, trajectory).run();
}

}  // namespace pendula
