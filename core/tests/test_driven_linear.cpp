#include <boost/test/unit_test.hpp>
#include <cstring>

#include "driven_linear_truth.hpp"
#include "random.hpp"

using pendula::driven_linear_motion, pendula::driven_linear_parameters;
using truth::long_number;

namespace {

struct randoms {
  std::mt19937_64 random = generator();
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  double power_of_ten(double low, double high) { return std::pow(10.0, between(low, high)); }
  double sign() { return between(-1.0, 1.0) < 0.0 ? -1.0 : 1.0; }
  bool one_in(double count) { return between(0.0, count) < 1.0; }
};

double inertia(const driven_linear_parameters& of) { return of.mass * of.length * of.length; }
double natural_frequency(const driven_linear_parameters& of) { return std::sqrt(of.gravity / of.length); }

struct motion {
  driven_linear_parameters of;
  double theta, omega, t0, t;

  double damping() const { return of.viscous / (2.0 * inertia(of)); }
  double frequency() const { return natural_frequency(of); }
  // Of the faster root.
  double fastest_decay() const {
    const double over = damping() * damping() - frequency() * frequency();
    return damping() + std::sqrt(std::max(over, 0.0));
  }
  double largest_frequency() const {
    return std::max({frequency(), fastest_decay(), of.torque == 0.0 ? 0.0 : std::fabs(of.drive_frequency)});
  }
};

const char* const regimes[] = {"undamped",           "underdamped",       "very little damped",
                               "overdamped",         "very much damped",  "critical",
                               "next to critical",   "critical, slow",    "resonant",
                               "undamped, resonant", "next to resonance", "next to resonance, very little damped",
                               "constant torque"};
constexpr int critical = 5, resonant = 9;

// Parameters of a regime; γ/ωn and Ω/ωn leave one that they are next to by 1e-17 to 1e-3.
driven_linear_parameters some_parameters(int regime, randoms& some) {
  driven_linear_parameters of{some.power_of_ten(-2, 2), some.power_of_ten(-1, 2), some.power_of_ten(-3, 3), 0, 0, 0, 0};
  if (regime == critical || regime == resonant)
    of.length = some.one_in(2) ? 1.0 : 0.25, of.gravity = 16.0 * of.length * (of.length == 1.0 ? 1.0 : 4.0),
    of.mass = 1.0;
  if (regime == 7) of.gravity = 1e-12 * of.length;
  const double own = natural_frequency(of), next = 1.0 + some.sign() * some.power_of_ten(-17, -3);
  const double damping[] = {0.0,
                            some.power_of_ten(-4, -0.1),
                            some.power_of_ten(-20, -6),
                            some.power_of_ten(0.01, 1),
                            some.power_of_ten(1, 18),
                            1.0,
                            next,
                            next,
                            some.power_of_ten(-4, -0.1),
                            0.0,
                            some.power_of_ten(-4, -0.1),
                            some.power_of_ten(-20, -5),
                            some.power_of_ten(-3, 3)};
  const double part = damping[regime], slower = std::sqrt(std::max((1.0 - part) * (1.0 + part), 0.0));
  of.viscous = 2.0 * inertia(of) * (part * own);
  of.drive_frequency = own * some.sign() * some.power_of_ten(-3, 3);
  if (some.one_in(4)) of.drive_frequency = own * some.power_of_ten(-19, -1);
  if (regime >= 8 && regime <= 11) of.drive_frequency = own * slower * (regime < 10 ? 1.0 : next);
  if (regime == 12) of.drive_frequency = 0.0;
  of.drive_phase = some.between(-4.0, 4.0);
  of.torque = some.one_in(4) ? 0.0 : some.sign() * inertia(of) * some.power_of_ten(-2, 2);
  return of;
}

// Up to 1e6 s before and after, where the motion neither grows nor decays by more than the truth has digits for.
motion some_motion(int regime, randoms& some) {
  motion m{some_parameters(regime, some), some.between(-2.0, 2.0), 0.0, 0.0, 0.0};
  m.omega = some.one_in(8) ? 0.0 : m.frequency() * some.between(-2.0, 2.0);
  if (some.one_in(8)) m.theta = m.omega = 0.0;
  if (!some.one_in(4)) m.t0 = some.sign() * some.power_of_ten(-3, 6);
  double span = some.sign() * some.power_of_ten(-9, 6);
  if (some.one_in(3)) span = some.sign() * some.power_of_ten(-9, 0) / m.largest_frequency();  // all nodes meet
  const double fast = m.fastest_decay(), own = m.frequency(), slow = m.damping() > own ? own * own / fast : fast;
  const double rate = span < 0.0 ? fast : slow, most = 150.0;
  if (std::fabs(span) * rate > most) span = std::copysign(most / rate * some.power_of_ten(-3, 0), span);
  m.t = m.t0 + span;
  return m;
}

// Rounded as if from exact numbers, but for 2^-75 of the motion's size, angle or angular velocity.
void check(const motion& m, const char* regime) {
  const auto want = truth::driven_linear(m.of, m.theta, m.omega, m.t0, m.t);
  const auto [theta, omega] = driven_linear_motion(m.of, m.theta, m.omega, m.t0).at(m.t);
  const double fastest = m.largest_frequency(), of_theta = std::fabs(want.theta.convert_to<double>()),
               of_omega = std::fabs(want.omega.convert_to<double>()), size = std::max(of_theta, of_omega / fastest);
  const auto within = [](double got, const long_number& number, double value, double scale) {
    const double half_unit = value == 0.0 ? 0.0 : std::ldexp(1.0, std::ilogb(value) - 53);
    const double error = long_number(abs(got - number)).convert_to<double>();
    return error <= half_unit + 0x1p-75 * scale;
  };
  const auto told = [&] {
    std::ostringstream text;
    text << std::hexfloat << regime << ": " << m.of.length << " " << m.of.gravity << " " << m.of.mass << " "
         << m.of.viscous << " " << m.of.torque << " " << m.of.drive_frequency << " " << m.of.drive_phase << ", "
         << m.theta << " " << m.omega << " " << m.t0 << " " << m.t << ": " << theta << " " << omega;
    return text.str();
  };
  BOOST_TEST(within(theta, want.theta, of_theta, size), "angle, " << told());
  BOOST_TEST(within(omega, want.omega, of_omega, size * fastest), "angular velocity, " << told());
}

// Roots −1 and −4: γ = 5/2, ωn = 2.
constexpr driven_linear_parameters two_decays{1.0, 4.0, 1.0, 5.0, 0.0, 0.0, 0.0};

}  // namespace

BOOST_AUTO_TEST_CASE(motions_with_friction_and_drive_have_all_their_digits_in_every_regime) {
  randoms some;
  for (int regime = 0; regime < static_cast<int>(std::size(regimes)); ++regime)
    for (int i = 0; i < 250; ++i) check(some_motion(regime, some), regimes[regime]);
}

BOOST_AUTO_TEST_CASE(a_mode_alone_keeps_its_digits_where_the_other_overflows) {
  const auto relative = [](double theta, double root, double t) {
    const auto [angle, velocity] = driven_linear_motion(two_decays, theta, theta * root, 0.0).at(t);
    const long_number want = theta * exp(long_number(root) * t);
    const double error = long_number(abs(angle / want - 1)).convert_to<double>();
    BOOST_TEST(error < 0x1.001p-53, root << " " << t);
    BOOST_TEST(velocity == root * angle);
  };
  for (double t : {-700.0, -100.0, 3.0, 50.0, 700.0}) relative(1.0, -1.0, t);
  for (double t : {-175.0, -10.0, 3.0, 50.0, 175.0}) relative(1.0, -4.0, t);
  relative(0x1p-1000, -1.0, -1390.0);  // of e^1390
  relative(0x1p900, -1.0, 1300.0);
  const auto gone = driven_linear_motion(two_decays, 1.0, 0.0, 0.0).at(1e6);
  BOOST_TEST((gone.theta == 0.0 && gone.omega == 0.0));
  const auto grown = driven_linear_motion(two_decays, 1.0, 0.0, 0.0).at(-1e3);
  BOOST_TEST((std::isinf(grown.theta) && std::isinf(grown.omega)));
}

BOOST_AUTO_TEST_CASE(a_mode_that_a_state_has_only_by_its_rounding_keeps_its_digits) {
  randoms some;
  for (int i = 0; i < 100; ++i) {  // back from what remains of a driven motion when its own has died out
    motion m = some_motion(1, some);
    m.of.torque = inertia(m.of);
    m.t = m.t0 + 100.0 / m.damping();
    const auto late = driven_linear_motion(m.of, m.theta, m.omega, m.t0).at(m.t);
    check({m.of, late.theta, late.omega, m.t, m.t0}, "back from the steady motion");
  }
  for (int i = 0; i < 100; ++i) {  // on, with next to nothing of the slower mode
    motion m = some_motion(3, some);
    m.of.torque = 0.0;
    m.omega = -m.fastest_decay() * m.theta;
    m.t = m.t0 + some.between(1.0, 100.0) / m.fastest_decay();
    check(m, "the faster mode");
  }
}

BOOST_AUTO_TEST_CASE(at_its_start_a_driven_motion_is_the_state_it_was_given) {
  randoms some;
  for (int regime = 0; regime < static_cast<int>(std::size(regimes)); ++regime) {
    const motion m = some_motion(regime, some);
    const auto [theta, omega] = driven_linear_motion(m.of, m.theta, m.omega, m.t0).at(m.t0);
    BOOST_TEST((theta == m.theta && omega == m.omega), regimes[regime]);
  }
}

BOOST_AUTO_TEST_CASE(phases_beyond_three_doubles_are_not_told) {
  const driven_linear_parameters slow{1.0, 9.81, 1.0, 0.0, 0.0, 0.0, 0.0}, fast{1.0, 9.81, 1.0, 20.0, 1.0, 1e12, 0.0};
  BOOST_TEST(std::isnan(driven_linear_motion(slow, 1.0, 0.0, 0.0).at(2e15).theta));
  BOOST_TEST(std::isnan(driven_linear_motion(fast, 1.0, 0.0, 0.0).at(1e4).omega));
  BOOST_TEST(!std::isnan(driven_linear_motion(fast, 1.0, 0.0, 0.0).at(1e3).omega));
}

BOOST_AUTO_TEST_CASE(points_of_many_driven_motions_are_those_of_each_alone) {
  randoms some;
  const driven_linear_parameters of = some_parameters(1, some);
  std::vector<double> states, times;
  for (int i = 0; i < 600; ++i) states.push_back(some.between(-2.0, 2.0));
  for (int i = 0; i < 270; ++i) times.push_back(some.sign() * some.power_of_ten(-9, 2));
  std::vector<double> out(states.size() * times.size());
  const pendula::driven_linear system(of, 0.25);
  const auto points = [&](auto&& go_on) {
    return pendula::driven_linear_points(system, states.data(), states.size() / 2, times.data(), times.size(),
                                         out.data(), go_on);
  };
  BOOST_TEST(points([] { return true; }));
  int others = 0;
  for (std::size_t i = 0; i < states.size() / 2; i += 23) {
    const driven_linear_motion alone(of, states[2 * i], states[2 * i + 1], 0.25);
    for (std::size_t j = 0; j < times.size(); ++j) {
      const auto point = alone.at(times[j]);
      others += std::memcmp(&point, &out[2 * (i * times.size() + j)], sizeof point) != 0;
    }
  }
  BOOST_TEST(others == 0);
  BOOST_TEST(!points([] { return false; }));
}
