// Tests of bonded bodies: two joined bars behave as one, for equal and different materials.

#include "macro/restart/byte_archives.h"
#include "shared/error.h"
#include "tests/verification/macro/bodies.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

namespace spall::test {
namespace {

constexpr double length = 0.04;       ///< length of each bar, m
constexpr int layers = 32;            ///< number of layers of a bar
constexpr double h = length / layers; ///< spacing of the layers, m

/// Two bonded bars along z that meet at z = 0. With Poisson's ratio 0 one-dimensional theory is exact.
struct Joined {
  J2 upper_material = elastic(78.6e9, 0), lower_material = elastic(78.6e9, 0);
  SymmetryPlanes planes{};
  double spacing = h, lower_spacing = spacing; ///< m
  int rings = 2;                               ///< number of rings of the upper bar

  Simulation run(const std::function<Vec3(const Vec3&)>& velocity) const {
    Bodies bodies;
    for (const bool upper : {true, false}) {
      const J2& material = upper ? upper_material : lower_material;
      const double own = upper ? spacing : lower_spacing, radius = rings * spacing;
      Points points = fill_cylinder({.radius = radius, .height = length, .bottom = upper ? 0 : -length},
                                    {static_cast<int>(std::lround(radius / own)),
                                     static_cast<int>(std::lround(length / own)), Boundary::centred},
                                    planes, material.density);
      set_velocity(points, velocity);
      bodies.solids.push_back(make_solid(material, std::move(points), planes, Numerics{}.solid()));
      bodies.solids.back()->label = upper ? "upper" : "lower";
    }
    return {
        std::move(bodies), {.bonded = {{"upper", "lower"}}}, {.end_time = 1}, Numerics{}.solid().integration};
  }
};

/// Momentum along z of a body's points below a height, N s, and the height of its centre, m.
struct Momentum {
  double sum = 0, centre = 0;
};
Momentum momentum_below(const Solid& solid, double high) {
  Momentum p;
  const Points& points = solid.points;
  for (std::size_t i = 0; i < points.owned; ++i) {
    const double z = points.initial_position[i][2], own = points.mass[i] * points.velocity[i][2];
    if (z < high) p.sum += own, p.centre += own * z;
  }
  p.centre /= p.sum;
  return p;
}

/// Returns the mean velocity along z of a body's points between two heights, m/s.
double mean_velocity(const Solid& solid, double low, double high) {
  double sum = 0, mass = 0;
  const Points& points = solid.points;
  for (std::size_t i = 0; i < points.owned; ++i) {
    const double z = points.initial_position[i][2];
    if (z < low || z > high) continue;
    sum += points.mass[i] * points.velocity[i][2], mass += points.mass[i];
  }
  return sum / mass;
}

double wave_speed(const J2& m) { return std::sqrt(m.youngs_modulus / m.density); }

/// A pulse of velocity, which splits into two halves: one moves down through the bond, the other one up.
Vec3 pulse(const Vec3& x) { return {0, 0, std::exp(-std::pow((x[2] - 0.5 * length) / (0.15 * length), 2))}; }

/// Makes two equal bars in one piece.
Simulation in_one_piece(double spacing, const std::function<Vec3(const Vec3&)>& velocity) {
  const J2 material = elastic(78.6e9, 0);
  Points points = fill_cylinder({.radius = 2 * spacing, .height = 2 * length, .bottom = -length},
                                {2, static_cast<int>(std::lround(2 * length / spacing)), Boundary::centred},
                                SymmetryPlanes{}, material.density);
  set_velocity(points, velocity);
  return {bodies_of(make_solid(material, std::move(points), SymmetryPlanes{}, Numerics{}.solid())),
          {},
          {.end_time = 1},
          Numerics{}.solid().integration};
}

TEST(Bonded, AWavePassesBetweenEqualBarsAsInOneButForADelayOfTheOrderOfTheSpacing) {
  for (const double spacing : {h, 0.5 * h}) {
    Simulation run = Joined{.spacing = spacing}.run(pulse), whole = in_one_piece(spacing, pulse);
    const double end = length / wave_speed(elastic(78.6e9, 0));
    while (run.time < end) run.advance();
    while (whole.time < end) whole.advance();
    const Momentum passed = momentum_below(*run.bodies.solids[1], 0),
                   expected = momentum_below(*whole.bodies.solids[0], 0);
    // The outermost layers of the solids are softer than those inside.
    const double delay = (passed.centre - expected.centre) / spacing;
    std::printf(
        "%.4f of the pulse's momentum has passed, %.2f spacings behind that in one bar; energy errors %.1e, "
        "%.1e; drift %.1e spacings, lost in the bond %.1e of the energy\n",
        passed.sum / expected.sum, delay, run.energies.error(), whole.energies.error(),
        run.exchange.largest_drift / spacing, run.energies.contact / run.energies.initial);
    EXPECT_NEAR(passed.sum / expected.sum, 1, 2e-3);
    EXPECT_LT(std::abs(delay), 1.5);
    EXPECT_LT(std::abs(run.energies.error() - whole.energies.error()), 1e-3);
    EXPECT_LT(run.exchange.largest_drift, 1e-4 * spacing);
    EXPECT_LT(std::abs(run.energies.contact), 1e-3 * run.energies.initial);
    EXPECT_LT(run.momentum_error().linear, 1e-12);
  }
}

TEST(Bonded, AWaveIsSplitByTheImpedancesInTensionAndInCompression) {
  for (const auto& [sign, spacing] : {std::pair(1.0, h), {-1.0, h}, {1.0, 0.5 * h}}) {
    Joined bars{.spacing = spacing};
    bars.lower_material.youngs_modulus *= 4; // so that the impedance is twice as large
    Simulation run = bars.run([sign = sign](const Vec3& x) { return sign * pulse(x); });
    const double half = 0.5 * run.energies.initial_momentum;
    while (run.time < 0.8 * length / wave_speed(bars.upper_material)) run.advance();
    // Of the velocity of the incoming half pulse 2 Z1 / (Z1 + Z2) is transmitted and (Z1 - Z2) / (Z1 + Z2)
    // reflected. The transmitted pulse is c2 / c1 = 2 times as long.
    const double passed = run.energies.solid_momentum[1] / half,
                 back = momentum_below(*run.bodies.solids[0], 0.5 * length).sum / half;
    std::printf("transmitted momentum %.4f of 4/3, reflected %.4f of -1/3\n", passed, back);
    EXPECT_NEAR(passed, 4. / 3, 0.03 * spacing / h);
    // The tails of the two pulses in the upper bar overlap half-way between them.
    const double tail = 0.5 * std::erfc(0.2 / 0.15);
    EXPECT_NEAR(back, -(1 - tail) / 3 + tail, 0.03 * spacing / h);
    EXPECT_LT(run.momentum_error().linear, 1e-12);
  }
}

TEST(Bonded, TheSlowestVibrationIsThatOfTheCompositeBar) {
  // With free ends the velocities are A cos(k1 (L - z)) above and B cos(k2 (L + z)) below. The bond makes
  // velocity and stress equal: Z1 tan(k1 L) + Z2 tan(k2 L) = 0. For E2 = 4 E1: Z2 = 2 Z1, k1 = 2 k2, so
  // tan(k2 L)^2 = 2.
  Joined bars;
  bars.lower_material.youngs_modulus *= 4;
  const double k2 = std::atan(std::sqrt(2.0)) / length, k1 = 2 * k2;
  const double exact = k2 * wave_speed(bars.lower_material);
  const auto shape = [&](double z) {
    return z > 0 ? std::cos(k1 * (length - z)) / std::cos(k1 * length)
                 : std::cos(k2 * (length + z)) / std::cos(k2 * length);
  };
  Simulation run = bars.run([&](const Vec3& x) { return Vec3{0, 0, 1e-2 * shape(x[2])}; });
  // The part of the velocity that has this shape stops after a quarter of a period.
  const auto amplitude = [&] {
    double sum = 0;
    for (const auto& solid : run.bodies.solids)
      for (std::size_t i = 0; i < solid->points.owned; ++i)
        sum += solid->points.mass[i] * shape(solid->points.initial_position[i][2]) *
               solid->points.velocity[i][2];
    return sum;
  };
  double before = amplitude(), now = before;
  while (now > 0) {
    before = now;
    run.advance();
    now = amplitude();
  }
  // Velocities belong to the middle of the step.
  const double quarter = run.time - 0.5 * run.step + run.step * now / (before - now);
  const double found = 0.5 * std::numbers::pi / quarter;
  std::printf("slowest vibration %.4f of the exact one, of what it would be without bond at the most %.2f\n",
              found / exact, std::numbers::pi * wave_speed(bars.upper_material) / length / exact);
  EXPECT_NEAR(found / exact, 1,
              0.05); // the soft outermost layers at all four ends lower the frequency, as in free bars
}

TEST(Bonded, SpinningBarsKeepTheirMomentaAndNeedNoImpulse) {
  Simulation run = Joined{.rings = 3}.run([](const Vec3& x) { return cross(Vec3{300, 0, 200}, x); });
  while (run.time < 20e-6) run.advance();
  const MomentumError error = run.momentum_error();
  std::printf("momentum errors %.1e, %.1e, drift %.1e spacings\n", error.linear, error.angular,
              run.exchange.largest_drift / h);
  EXPECT_LT(error.linear, 1e-12);
  EXPECT_LT(error.angular, 1e-5);
  EXPECT_LT(run.exchange.largest_drift, 1e-3 * h);
  EXPECT_LT(std::abs(run.energies.error()), 1e-3);
}

TEST(Bonded, BarsOfDifferentSpacingsStayJoinedInTension) {
  Joined bars;
  bars.rings = 4, bars.lower_spacing = 2 * h;
  Simulation run = bars.run([](const Vec3& x) { return Vec3{0, 0, x[2] > 0 ? 1.0 : -1.0}; });
  const MomentumError start = run.momentum_error();
  EXPECT_EQ(start.linear, 0);
  while (run.time < 1.5 * length / wave_speed(bars.upper_material)) run.advance();
  // The bond keeps them together; free bars would fly apart.
  EXPECT_LT(mean_velocity(*run.bodies.solids[0], 0, length), 0.5);
  EXPECT_LT(run.exchange.largest_drift, 1e-2 * h);
  EXPECT_LT(run.momentum_error().linear, 1e-12);
  EXPECT_LT(std::abs(run.energies.error()), 1e-2);
}

TEST(Bonded, AQuarterIsTheWhole) {
  const auto ends = [](const SymmetryPlanes& planes) {
    Joined bars{.planes = planes};
    bars.rings = 4;
    Simulation run = bars.run([](const Vec3& x) {
      return Vec3{20 * x[0], 20 * x[1], x[2] > 0 ? 1.0 : -1.0};
    });
    for (int n = 0; n < 100; ++n) run.advance();
    return std::array{
        run.energies.kinetic / run.energies.initial, run.energies.contact / run.energies.initial,
        mean_velocity(*run.bodies.solids[0], 0, 4 * h), mean_velocity(*run.bodies.solids[1], -4 * h, 0)};
  };
  const auto whole = ends({}), quarter = ends({{true, true, false}});
  for (std::size_t k = 0; k < whole.size(); ++k) EXPECT_NEAR(quarter[k], whole[k], 1e-3) << k;
}

TEST(Bonded, RingsAboutTheAxisStayJoined) {
  Joined bars{.planes = {.axis = true}};
  bars.rings = 4;
  Simulation run = bars.run(pulse);
  while (run.time < length / wave_speed(bars.upper_material)) run.advance();
  EXPECT_GT(mean_velocity(*run.bodies.solids[1], -0.6 * length, -0.4 * length),
            0.38); // the exact part of half a pulse is 0.43
  EXPECT_LT(run.exchange.largest_drift, 1e-3 * h);
  EXPECT_LT(run.momentum_error().linear, 1e-12);
  EXPECT_LT(std::abs(run.energies.error()), 5e-3);
}

/// Returns all bytes of a state.
std::vector<std::byte> state_of(Simulation& run) {
  run.phases = {};
  ByteWriter writer;
  run.transfer(writer);
  return writer.bytes;
}

TEST(Bonded, ContinuesBitForBit) {
  const auto advance = [](Simulation& run) {
    for (int n = 0; n < 40; ++n) run.advance();
  };
  Simulation whole = Joined{}.run(pulse), resumed = Joined{}.run(pulse);
  advance(whole);
  ByteReader reader(state_of(whole));
  resumed.transfer(reader);
  advance(whole), advance(resumed);
  EXPECT_EQ(resumed.energies.total(), whole.energies.total());
  for (const std::size_t s : {0, 1})
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(resumed.bodies.solids[s]->points.position.component[c],
                whole.bodies.solids[s]->points.position.component[c]);
      EXPECT_EQ(resumed.bodies.solids[s]->points.velocity.component[c],
                whole.bodies.solids[s]->points.velocity.component[c]);
    }
}

TEST(Bonded, RefusesBodiesThatAreApartOrMissing) {
  const auto make = [](double gap, const std::string& name) {
    Bodies bodies;
    for (const bool upper : {true, false}) {
      const J2 material = elastic();
      Points points = fill_cylinder({.radius = 2 * h, .height = length, .bottom = upper ? gap : -length},
                                    {2, layers, Boundary::centred}, {}, material.density);
      bodies.solids.push_back(make_solid(material, std::move(points), {}, Numerics{}.solid()));
      bodies.solids.back()->label = upper ? "upper" : "lower";
    }
    Simulation run(std::move(bodies), {.bonded = {{"lower", name}}}, {.end_time = 1},
                   Numerics{}.solid().integration);
  };
  EXPECT_NO_THROW(make(0, "upper"));
  EXPECT_THROW(make(0.5 * h, "upper"), InputError);
  EXPECT_THROW(make(10 * h, "upper"), InputError);
  EXPECT_THROW(make(0, "roof"), InputError);
}

} // namespace
} // namespace spall::test
