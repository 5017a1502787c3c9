// Bonded bodies: two bars that are joined behave as one, whatever they are made of.

#include "macro/restart/byte_archives.h"
#include "shared/error.h"
#include "tests/verification/macro/bodies.h"

#include <gtest/gtest.h>

#include <functional>

namespace spall::test {
namespace {

constexpr double length = 0.04; ///< of each bar, m
constexpr int layers = 32;
constexpr double h = length / layers;

/// Two bars along z that meet at z = 0, bonded; Poisson's ratio 0: one-dimensional theory is exact.
struct Joined {
  J2 upper_material = elastic(78.6e9, 0), lower_material = elastic(78.6e9, 0);
  SymmetryPlanes planes{};
  double lower_spacing = h; ///< of its layers, m
  int rings = 2;
  Boundary boundary = Boundary::centred;

  Simulation run(const std::function<Vec3(const Vec3&)>& velocity) const {
    Bodies bodies;
    for (const bool upper : {true, false}) {
      const J2& material = upper ? upper_material : lower_material;
      const double spacing = upper ? h : lower_spacing;
      const int count = static_cast<int>(std::lround(length / spacing));
      Points points = fill_cylinder({.radius = rings * h, .height = length, .bottom = upper ? 0 : -length},
                                    {static_cast<int>(std::lround(rings * h / spacing)), count, boundary}, planes,
                                    material.density);
      set_velocity(points, velocity);
      bodies.solids.push_back(make_solid(material, std::move(points), planes, Numerics{}.solid()));
      bodies.solids.back()->label = upper ? "upper" : "lower";
    }
    return {std::move(bodies), {.bonded = {{"upper", "lower"}}}, {.end_time = 1}, Numerics{}.solid().integration};
  }
};

/// Mean velocity along z of a body's points between two heights, m/s.
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

/// A pulse that moves down in the upper bar, with its strain: only by its velocity, which makes two halves.
Vec3 pulse(const Vec3& x) { return {0, 0, std::exp(-std::pow((x[2] - 0.5 * length) / (0.1 * length), 2))}; }

TEST(Bonded, AWavePassesBetweenEqualBarsAsInOne) {
  Simulation run = Joined{}.run(pulse);
  const double c = wave_speed(elastic(78.6e9, 0));
  // Of the two halves one has moved through the bond by half a length, in tension or compression.
  while (run.time < length / c) run.advance();
  const double passed = mean_velocity(*run.bodies.solids[1], -0.6 * length, -0.4 * length);
  const double left = mean_velocity(*run.bodies.solids[0], 0.05 * length, 0.3 * length);
  std::printf("half a pulse of 1 m/s: %.4f m/s behind the bond, %.4f m/s left before it, drift %.1e spacings, "
              "lost %.1e of the energy\n",
              passed, left, run.exchange.largest_drift / h, run.energies.contact / run.energies.initial);
  EXPECT_GT(passed, 0.4);
  EXPECT_LT(std::abs(left), 0.02);
  EXPECT_LT(run.exchange.largest_drift, 1e-4 * h);
  EXPECT_LT(std::abs(run.energies.error()), 1e-3);
  EXPECT_LT(std::abs(run.energies.contact), 0.01 * run.energies.initial);
  EXPECT_LT(run.momentum_error().linear, 1e-12);
}

TEST(Bonded, AWaveIsSplitByTheImpedancesInTensionAndInCompression) {
  Joined bars;
  bars.lower_material.youngs_modulus *= 4; // twice the impedance
  for (const double sign : {1.0, -1.0}) {
    Simulation run = bars.run([sign](const Vec3& x) { return sign * pulse(x); });
    const double c = wave_speed(bars.upper_material);
    while (run.time < 0.9 * length / c) run.advance();
    // Transmitted velocity 2 Z1 / (Z1 + Z2) of the half pulse, reflected (Z1 - Z2) / (Z1 + Z2).
    double passed = 0, back = 0;
    for (double z = -length; z < length; z += h) {
      const double v = mean_velocity(*run.bodies.solids[z < 0], z, z + h);
      if (z < 0 && std::abs(v) > std::abs(passed)) passed = v;
      if (z > 0 && z < 0.7 * length && std::abs(v) > std::abs(back)) back = v;
    }
    std::printf("transmitted %.4f of 2/3, reflected %.4f of -1/3 of the half pulse\n", 2 * passed * sign,
                2 * back * sign);
    EXPECT_NEAR(2 * passed * sign, 2. / 3, 0.04);
    EXPECT_NEAR(2 * back * sign, -1. / 3, 0.04);
    EXPECT_LT(run.momentum_error().linear, 1e-12);
  }
}

/// Frequency of the slowest longitudinal vibration of the free joined bars, rad/s.
double frequency(const Joined& bars, double guess) {
  Simulation run = bars.run([](const Vec3& x) { return Vec3{0, 0, 1e-2 * x[2] / length}; });
  // Both ends move apart, stop after a quarter of the period, and come back: through zero again after half.
  const auto parting = [&] {
    return mean_velocity(*run.bodies.solids[0], length - 4 * h, length) -
           mean_velocity(*run.bodies.solids[1], -length, -length + 4 * h);
  };
  double turn = 0;
  while (turn == 0 && run.time < 10 / guess) {
    const double before = parting(), start = run.time;
    run.advance();
    const double now = parting();
    if (before > 0 && now <= 0 && run.time > 0.5 / guess) turn = start + run.step * before / (before - now);
  }
  return 0.5 * std::numbers::pi / turn;
}

TEST(Bonded, TheModulusOfAPairIsThatOfBarsInSeries) {
  // A fine, soft bar of small density between heavy halves would be ideal; for equal densities the slowest
  // vibration solves tan(k1 L) tan(k2 L) = Z1 / Z2. For E2 = 4 E1: k1 = 2 k2, Z2 = 2 Z1.
  Joined bars;
  bars.lower_material.youngs_modulus *= 4;
  const double c2 = wave_speed(bars.lower_material);
  double low = 0.01, high = 0.78; // of k2 L: tan(2 a) tan(a) grows
  for (int n = 0; n < 60; ++n) {
    const double a = 0.5 * (low + high);
    (std::tan(2 * a) * std::tan(a) < 0.5 ? low : high) = a;
  }
  const double exact = low * c2 / length;
  const double found = frequency(bars, exact);
  std::printf("slowest vibration %.4f of the exact one\n", found / exact);
  EXPECT_NEAR(found / exact, 1, 0.1); // the start excites others too
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
  const double whole = run.bodies.solids[0]->points.mass[0];
  while (run.time < 1.5 * length / wave_speed(bars.upper_material)) run.advance();
  EXPECT_GT(whole, 0);
  // They pull each other back: free bars would fly apart.
  EXPECT_LT(mean_velocity(*run.bodies.solids[0], 0, length), 0.5);
  EXPECT_LT(run.exchange.largest_drift, 1e-2 * h);
  EXPECT_LT(run.momentum_error().linear, 1e-12);
  EXPECT_LT(std::abs(run.energies.error()), 1e-2);
}

TEST(Bonded, AQuarterIsTheWhole) {
  const auto ends = [](const SymmetryPlanes& planes) {
    Joined bars{.planes = planes};
    bars.rings = 4;
    Simulation run = bars.run([](const Vec3& x) { return Vec3{20 * x[0], 20 * x[1], x[2] > 0 ? 1.0 : -1.0}; });
    for (int n = 0; n < 100; ++n) run.advance();
    return std::array{run.energies.kinetic / run.energies.initial, run.energies.contact / run.energies.initial,
                      mean_velocity(*run.bodies.solids[0], 0, 4 * h),
                      mean_velocity(*run.bodies.solids[1], -4 * h, 0)};
  };
  const auto whole = ends({}), quarter = ends({{true, true, false}});
  for (std::size_t k = 0; k < whole.size(); ++k) EXPECT_NEAR(quarter[k], whole[k], 1e-3) << k;
}

TEST(Bonded, RingsAboutTheAxisStayJoined) {
  Joined bars{.planes = {.axis = true}};
  bars.rings = 4;
  Simulation run = bars.run(pulse);
  while (run.time < length / wave_speed(bars.upper_material)) run.advance();
  EXPECT_GT(mean_velocity(*run.bodies.solids[1], -0.6 * length, -0.4 * length), 0.4);
  EXPECT_LT(run.exchange.largest_drift, 1e-3 * h);
  EXPECT_LT(run.momentum_error().linear, 1e-12);
  EXPECT_LT(std::abs(run.energies.error()), 1e-3);
}

/// Everything a state consists of.
std::vector<std::byte> state_of(Simulation& run) {
  run.phases = {};
  ByteWriter writer;
  run.transfer(writer);
  return writer.bytes;
}

TEST(Bonded, GoesOnBitForBit) {
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

TEST(Bonded, RefusesBodiesThatAreApartOrNotThere) {
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
