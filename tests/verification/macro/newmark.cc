// Tests of the time integration with the first longitudinal mode of an elastic bar, an oscillator of known
// frequency.

#include "tests/verification/macro/bodies.h"

#include <gtest/gtest.h>

#include <numbers>

namespace spall::test {
namespace {

using std::numbers::pi;

constexpr double length = 0.1;
constexpr int layers = 10;
const J2 material = elastic(78.6e9, 0);
const double omega = pi * std::sqrt(material.youngs_modulus / material.density) / length;

/// Makes the bar in its first mode at the largest velocity, 1 cm/s.
Simulation vibrating_bar(const Numerics& numerics) {
  const double h = length / layers;
  Points points = fill_cylinder({.radius = 2 * h, .height = length}, {2, layers, Boundary::centred},
                                SymmetryPlanes{}, material.density);
  set_velocity(points, [](const Vec3& x) { return Vec3{0, 0, 1e-2 * std::cos(pi * x[2] / length)}; });
  return free_flight(material, std::move(points), numerics);
}
double mode_velocity(const Simulation& run) {
  const Points& p = run.bodies.solids[0]->points;
  double sum = 0;
  for (std::size_t i = 0; i < p.owned; ++i)
    sum += p.mass[i] * p.velocity[i][2] * std::cos(pi * p.initial_position[i][2] / length);
  return sum;
}
/// Returns the time of the sixth sign change of the mode's velocity over its value for the continuous bar.
double period(double step_factor) {
  Simulation run = vibrating_bar({.step_factor = step_factor});
  double last = mode_velocity(run), last_time = 0;
  for (int changes = 0;;) {
    run.advance();
    const double value = mode_velocity(run), time = run.time - 0.5 * run.step;
    if (value * last < 0 && ++changes == 6)
      return (last_time + (time - last_time) * last / (last - value)) * omega / (5.5 * pi);
    last = value, last_time = time;
  }
}
/// Returns the mechanical energy after four periods over that at the start, and the step.
std::pair<double, double> energy_kept(double gamma) {
  // The step is short, because energies at the middle of a step differ by (omega dt)^2 / 4 from the conserved
  // ones.
  Simulation run = vibrating_bar({.step_factor = 0.1, .newmark_gamma = gamma});
  while (run.time < 8 * pi / omega) run.advance();
  const Energies& b = run.energies;
  EXPECT_LT(std::abs(b.error()), 1e-3); // the lost energy is recorded as damping
  return {(b.kinetic + b.internal.total + b.stabilization) / b.initial, run.step};
}

TEST(Newmark, CentralDifferencesAreOfSecondOrder) {
  const double coarse = period(0.8), middle = period(0.4), fine = period(0.2);
  std::printf("period %.6f, %.6f, %.6f of the continuous bar's at step factors 0.8, 0.4, 0.2\n", coarse,
              middle, fine);
  EXPECT_NEAR((coarse - middle) / (middle - fine), 4, 0.4);
  // The computed period of an oscillator is too short by (omega dt)^2 / 24.
  const double step = 0.8 / (layers * std::sqrt(material.youngs_modulus / material.density) / length);
  EXPECT_NEAR((fine - coarse) / (std::pow(omega * step, 2) / 24 * 15 / 16), 1, 0.1);
}

TEST(Newmark, GammaOneHalfConservesEnergyAndLargerOnesDampAtTheKnownRate) {
  const auto [kept, unused] = energy_kept(0.5);
  EXPECT_NEAR(kept, 1, 1e-3);
  for (const double gamma : {0.6, 0.9}) {
    const auto [part, step] = energy_kept(gamma);
    const double rate = (gamma - 0.5) * omega * omega * step, expected = std::exp(-rate * 8 * pi / omega);
    std::printf("gamma %.1f: %.4f of the energy after four periods, theory %.4f\n", gamma, part, expected);
    EXPECT_NEAR(std::log(part) / std::log(expected), 1, 0.05);
  }
}

} // namespace
} // namespace spall::test
