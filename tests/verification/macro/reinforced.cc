// Tests of concrete with bars: stiffness in extension and bending, conservation, symmetry, threads.

#include "tests/verification/macro/scheme_cases.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

namespace spall::test {
namespace {

const char* const concrete =
    "  set Model = deformable\n  set Shape = block\n"
    "  subsection Material\n    set Law = J2\n  end\n"
    "  subsection J2\n    set Young's modulus = 30 GPa\n    set Poisson's ratio = 0.2\n"
    "    set Hardening modulus = 0 Pa\n    set Density = 2400 kg/m3\n"
    "    set Yield stress = 1000 GPa\n  end\n";
const char* const bars = "  subsection Reinforcement\n    set Faces = both\n    set Bar diameter = 12 mm\n"
                         "    set Young's modulus = 200 GPa\n    set Yield stress = 500 MPa\n"
                         "    set Hardening modulus = 1 GPa\n    set Rupture strain = 0.02\n"
                         "    set Density = 7850 kg/m3\n    set Concrete strength = 40 MPa\n"
                         "    set Rib spacing = 7 mm\n  end\n";
const char* const numerics = "subsection Approximation\n  set Double precision = yes\n"
                             "  set Support size = 1.9\nend\n"
                             "subsection Integration\n  set Scheme = SUBPOINT\n  set Subcells = 8\nend\n"
                             "subsection Time\n  set End time = 1 s\n  set Step factor = 0.5\nend\n";

/// A beam along x with two bars along each of its two faces, or with none.
Simulation beam(bool reinforced, const std::string& size, const std::vector<std::string>& changes) {
  std::vector<std::string> all = {"beam/Reinforcement/Direction=x",
                                  "beam/Reinforcement/Yield stress=1000 GPa"};
  all.insert(all.end(), changes.begin(), changes.end());
  if (!reinforced) all.push_back("beam/Reinforcement/Faces=none");
  return start(*written(
      std::string("subsection Scene\n  set Symmetry planes = none\nend\nsubsection beam\n") + concrete +
          bars + size + "end\nsubsection Answers\n  set Momentum = beam\nend\n" + numerics,
      all));
}

/// Calls visit(points) for the points of the body and for the nodes of its bars.
template<class Visit> void for_all(Simulation& run, const Visit& visit) {
  visit(run.bodies.solids[0]->points);
  for (Reinforcement& one : run.bodies.reinforcements) visit(one.nodes());
}

constexpr double bar_area = std::numbers::pi / 4 * 12e-3 * 12e-3, modular_ratio = 200. / 30;

/// Square of the frequency of the first axial vibration of a free bar, 1/s^2.
double axial_frequency_squared(bool reinforced) {
  constexpr double length = 0.4;
  Simulation run = beam(reinforced,
                        "  set Width = 0.4 m\n  set Depth = 60 mm\n  set Height = 60 mm\n"
                        "  set Spacing = 10 mm\n",
                        {"J2/Poisson's ratio=0", "beam/Reinforcement/Spacing=30 mm",
                         "beam/Reinforcement/Offset=15 mm", "beam/Reinforcement/Cover=8 mm"});
  const auto shape = [](double x) { return std::sin(std::numbers::pi * x / length); };
  for_all(run, [&](Points& points) {
    for (std::size_t i = 0; i < points.owned; ++i)
      points.velocity.set(i, {shape(points.initial_position[i][0]), 0, 0});
  });
  const auto amplitude = [&] { // of the velocity; it vanishes after a quarter of a period
    double sum = 0;
    for_all(run, [&](Points& points) {
      for (std::size_t i = 0; i < points.owned; ++i)
        sum += points.mass[i] * points.velocity[i][0] * shape(points.initial_position[i][0]);
    });
    return sum;
  };
  double before = amplitude(), now = before;
  while (now > 0) {
    run.advance();
    before = now, now = amplitude();
  }
  // Velocities are those of the middles of the steps.
  const double quarter = run.time - 0.5 * run.step - run.step * now / (now - before);
  return std::pow(0.5 * std::numbers::pi / quarter, 2);
}

TEST(Reinforced, ABarVibratesWithTheCompositeModulus) {
  // Rayleigh's quotient with bars that end 8 mm before the faces, where the motion is largest: over them the
  // square of the velocity and that of the strain are, as parts of those over the whole length,
  constexpr double length = 0.4, half = 0.5 * length - 8e-3;
  const double swing = length / (2 * std::numbers::pi) * std::sin(2 * std::numbers::pi * half / length),
               of_velocity = (half - swing) / (0.5 * length), of_strain = (half + swing) / (0.5 * length);
  const double share = 4 * bar_area / (60e-3 * 60e-3);
  const double expected = (1 + share * modular_ratio * of_strain) / (1 + share * 7850 / 2400 * of_velocity);
  const double found = axial_frequency_squared(true) / axial_frequency_squared(false);
  RecordProperty("found", std::to_string(found));
  RecordProperty("expected", std::to_string(expected));
  EXPECT_GT(expected, 1.25);
  EXPECT_NEAR(found, expected, 0.005 * expected);
}

/// Deflection of the tip of a cantilever under its own weight, m: the mean over a period of the vibration
/// after the weight has been switched on.
double tip_deflection(bool reinforced) {
  constexpr double length = 0.4, spacing = 0.1 / 6, weight = 1000; // m/s^2
  Simulation run = beam(reinforced,
                        "  set Width = 0.4 m\n  set Depth = 66.66 mm\n  set Height = 0.1 m\n"
                        "  set Spacing = 16.66 mm\n",
                        {"beam/Reinforcement/Spacing=30 mm", "beam/Reinforcement/Offset=15 mm",
                         "beam/Reinforcement/Cover=8 mm"});
  const auto tip = [&] {
    double sum = 0, count = 0;
    const Points& points = run.bodies.solids[0]->points;
    for (std::size_t i = 0; i < points.owned; ++i)
      if (points.initial_position[i][0] > 0.5 * length - spacing)
        sum += points.position[i][2] - points.initial_position[i][2], ++count;
    return sum / count;
  };
  double sum = 0, last = 0;
  bool falling = false;
  for (int n = 0; n < 5000; ++n) {
    for_all(run, [&](Points& points) {
      for (std::size_t i = 0; i < points.owned; ++i) {
        points.force.add(i, {0, 0, -weight * points.mass[i]});
        if (points.initial_position[i][0] < -0.5 * length + spacing) points.force.set(i, {});
      }
    });
    run.advance();
    const double now = tip();
    sum += now * run.step;
    if (falling && now < last && run.time > 1e-3) break; // back at the top
    falling = falling || now > last;
    last = now;
  }
  return -sum / run.time;
}

TEST(Reinforced, ABeamBendsAsItsTransformedSection) {
  // Bending and shear of a cantilever of Timoshenko: w L^4 / 8 E I + w L^2 / 2 k G A, k = 5/6.
  constexpr double length = 0.4 - 0.1 / 6, depth = 66.66e-3, height = 0.1, modulus = 30e9;
  const double area = depth * height, lever = 0.5 * height - 8e-3 - 6e-3;
  const auto deflection = [&](double steel) {
    const double inertia = depth * std::pow(height, 3) / 12 +
                           modular_ratio * steel * (lever * lever + 12e-3 * 12e-3 / 16),
                 load = 1000 * (2400 * area + 7850 * steel), shear = modulus / 2.4 * area * 5 / 6;
    return load * std::pow(length, 4) / (8 * modulus * inertia) + load * length * length / (2 * shear);
  };
  const double expected = deflection(4 * bar_area) / deflection(0);
  const double plain = tip_deflection(false), found = tip_deflection(true) / plain;
  RecordProperty("plain over beam theory", std::to_string(plain / deflection(0)));
  RecordProperty("found", std::to_string(found));
  RecordProperty("expected", std::to_string(expected));
  EXPECT_NEAR(found, expected, 0.02 * expected);
}

/// A block of concrete with meshes that a heavy bolt hits and breaks.
std::shared_ptr<SceneFile> struck_block(const std::vector<std::string>& changes) {
  return written(
      std::string("subsection Scene\n  set Symmetry planes = none\nend\nsubsection block\n") + concrete +
          bars +
          "  set Width = 0.2 m\n  set Depth = 0.2 m\n  set Height = 60 mm\n  set Spacing = 10 mm\nend\n"
          "subsection bolt\n  set Model = rigid\n  set Shape = projectile\n  set Nose = hemisphere\n"
          "  set Diameter = 40 mm\n  set Length = 80 mm\n  set Mass = 2 kg\n  set Before = block\n"
          "  set Velocity = 200 m/s\nend\nsubsection Contact\n  set Friction = 0.1\nend\n"
          "subsection Answers\n  set Exit = bolt through block\nend\n" +
          numerics,
      joined({"J2/Yield stress=60 MPa", "block/Reinforcement/Spacing=40 mm", "block/Reinforcement/Cover=8 mm",
              "block/Reinforcement/Bar diameter=8 mm"},
             changes));
}

class StruckReinforced : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Bonds, StruckReinforced, ::testing::Values("rigid", "slip"));

TEST_P(StruckReinforced, MomentumIsKeptExactlyAndEnergyToAThousandth) {
  Simulation run =
      start(*struck_block({std::string("block/Reinforcement/Bond=") + GetParam(), "bolt/Obliquity=15 deg",
                           "bolt/Offset x=12 mm", "bolt/Offset y=7 mm"}));
  while (run.time < 150e-6) run.advance();
  const MomentumError error = run.momentum_error();
  EXPECT_LT(error.linear, 1e-12);
  EXPECT_LT(error.angular, 0.01); // the solid's own: without bars it is 6e-4 here
  EXPECT_LT(run.health.largest_energy_error, 1e-3);
  EXPECT_GT(run.bodies.reinforcements[0].bars().ruptured(), 0u);
  EXPECT_GT(run.energies.bar_work, 0.005 * run.energies.initial);
  EXPECT_GT(run.energies.bond_work, 0);
  RecordProperty("momentum", std::to_string(error.linear));
  RecordProperty("energy error", std::to_string(run.health.largest_energy_error));
}

TEST_P(StruckReinforced, AQuarterIsAQuarterOfTheWhole) {
  for (const char* offset : {"0 mm", "20 mm"}) {
    const std::vector<std::string> same = {std::string("block/Reinforcement/Bond=") + GetParam(),
                                           std::string("block/Reinforcement/Offset=") + offset};
    Simulation whole = start(*struck_block(same)),
               part = start(*struck_block(joined(same, {"Scene/Symmetry planes=x, y"})));
    // Round-off grows a millionfold where the concrete flows.
    for (int n = 0; n < 60; ++n) whole.advance(), part.advance();
    EXPECT_NEAR(part.time, whole.time, 1e-6 * whole.time);
    EXPECT_NEAR(part.bodies.rigids[0].velocity[2], whole.bodies.rigids[0].velocity[2], 0.01);
    const auto near_quarter = [&](double a, double b) { EXPECT_NEAR(4 * a, b, 2e-3 * std::abs(b)); };
    near_quarter(part.bodies.reinforcements[0].mass(), whole.bodies.reinforcements[0].mass());
    near_quarter(part.energies.bar_work, whole.energies.bar_work);
    near_quarter(part.energies.bar_kinetic, whole.energies.bar_kinetic);
    near_quarter(part.energies.bond_work, whole.energies.bond_work);
    near_quarter(part.energies.internal.total, whole.energies.internal.total);
  }
}

TEST(Reinforced, HasTheSameBitsForAnyNumberOfThreads) {
  const auto after = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Simulation run = start(*struck_block({"block/Reinforcement/Bond=slip"}));
    for (int n = 0; n < 40; ++n) run.advance();
    return std::pair(run.bodies.solids[0]->points.velocity.component,
                     run.bodies.reinforcements[0].nodes().velocity.component);
  };
  EXPECT_TRUE(after(1) == after(3));
}

} // namespace
} // namespace spall::test
