#include "macro/output/fragments.h"
#include "macro/output/debris_cone.h"

#include "tests/support/small_bar.h"

#include <gtest/gtest.h>

#include <numeric>

namespace spall::test {
namespace {

constexpr double height = 8e-3; // height of the small bar, whose cells are cubes of 1 mm

using Planes = std::vector<std::string>;
const std::vector<Planes> all_planes = {{}, {"x"}, {"x", "y"}},
                          all_symmetries = {{}, {"x"}, {"x", "y"}, {"axis"}};

/// Makes the bar with displacement(X) and velocity(X) at every point, and finds neighbours again.
template<class Displacement, class Velocity>
std::unique_ptr<Solid> moved_bar(const Planes& planes, const Displacement& displacement,
                                 const Velocity& velocity) {
  auto solid = small_bar(planes).solid();
  Points& points = solid->points;
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 x = points.initial_position[i], u = displacement(x);
    points.position.set(i, {x[0] + u[0], x[1] + u[1], x[2] + u[2]});
    points.velocity.set(i, velocity(x));
  }
  solid->refresh();
  return solid;
}

/// Displacement in which points above z = 6 mm move up, and those beyond x = 2 mm also sideways, so that
/// pieces cross both symmetry planes, or y = 0 alone.
Vec3 parting(const Vec3& x) {
  if (x[2] < 6e-3) return {};
  return {x[0] > 2e-3 ? 5e-3 : x[0] < -2e-3 ? -5e-3 : 0, 0, 10e-3};
}
Vec3 speed(const Vec3& x) {
  const Vec3 u = parting(x);
  return {1e3 * u[0] + 50 * x[0], 20 * x[1], 1e4 * u[2] + 3e3 * x[2]};
}

double body_mass(const Bar& bar) {
  const Points points = bar.points();
  double mass = 0;
  for (std::size_t i = 0; i < points.owned; ++i) mass += points.mass[i];
  return mass * bar.planes.multiplicity();
}

TEST(Fragments, ABodyIsOnePieceBeforeAndAfterItsNeighboursAreFound) {
  for (const Planes& planes : all_symmetries) {
    const Bar bar = small_bar(planes);
    auto solid = bar.solid();
    for (int look = 0; look < 2; ++look) {
      const Fragments found = find_fragments(*solid, {}, 0, height);
      ASSERT_EQ(found.list.size(), 1u);
      const Fragment& f = found.list[0];
      EXPECT_EQ(f.place, FragmentPlace::remainder);
      EXPECT_EQ(f.copies, 1);
      EXPECT_EQ(f.points, static_cast<double>(solid->points.owned) * bar.planes.multiplicity());
      EXPECT_NEAR(f.mass, body_mass(bar), 1e-12 * f.mass);
      EXPECT_NEAR(f.centre[0], 0, 1e-12);
      EXPECT_NEAR(f.centre[1], 0, 1e-12);
      EXPECT_NEAR(f.centre[2], 0.5 * height, 1e-12);
      solid->refresh();
    }
  }
}

TEST(Fragments, PiecesAreTheSameWhateverSymmetryPlanesAreUsed) {
  for (const Planes& planes : all_planes) {
    const auto solid = moved_bar(planes, parting, speed);
    const Fragments found = find_fragments(*solid, {}, 0, height);
    double remainder = 0, middle = 0, sides = 0;
    for (const Fragment& f : found.list) {
      if (f.place == FragmentPlace::remainder) {
        remainder += f.copies;
        EXPECT_EQ(f.points,
                  0.75 * static_cast<double>(solid->points.owned) * solid->ghosts.symmetry().multiplicity());
      } else if (std::abs(f.centre[0]) < 1e-9) {
        middle += f.copies;
        EXPECT_NEAR(f.velocity[0], 0, 1e-9);
      } else {
        sides += f.copies;
        EXPECT_NEAR(f.velocity[0],
                    (f.centre[0] > 0 ? 1 : -1) * 5 + 50 * (f.centre[0] - std::copysign(5e-3, f.centre[0])),
                    1e-9);
      }
      EXPECT_NEAR(f.centre[1], 0, 1e-9);
      if (f.place != FragmentPlace::remainder) {
        EXPECT_EQ(f.place, FragmentPlace::debris);
      }
    }
    EXPECT_EQ(remainder, 1);
    EXPECT_EQ(middle, 1);
    EXPECT_EQ(sides, 2);
  }
}

TEST(Fragments, HoldEveryPointTheMassTheMomentumAndTheEnergyOfTheBody) {
  for (const Planes& planes : all_symmetries) {
    const auto solid = moved_bar(planes, parting, speed);
    const Points& points = solid->points;
    const Fragments found = find_fragments(*solid, {}, 0, height);
    double count = 0, mass = 0, momentum = 0, energy = 0;
    for (const Fragment& f : found.list) {
      count += f.copies * f.points, mass += f.copies * f.mass;
      momentum += f.copies * f.mass * f.velocity[2], energy += f.copies * f.kinetic_energy;
    }
    double body = 0, impulse = 0, kinetic = 0;
    for (std::size_t i = 0; i < points.owned; ++i) {
      const Vec3 v = points.velocity[i];
      body += points.mass[i], impulse += points.mass[i] * v[2];
      kinetic += 0.5 * points.mass[i] * dot(v, v);
      EXPECT_LT(found.of_point[i], found.list.size());
    }
    const double copies = solid->ghosts.symmetry().multiplicity();
    EXPECT_EQ(count, copies * static_cast<double>(points.owned));
    EXPECT_NEAR(mass, copies * body, 1e-12 * mass);
    EXPECT_NEAR(momentum, copies * impulse, 1e-12 * std::abs(momentum));
    EXPECT_NEAR(energy, copies * kinetic, 1e-12 * energy);
  }
}

TEST(Fragments, OfRingsLieOnTheAxis) {
  const auto lifted = [](const Vec3& x) { return Vec3{0, 0, x[2] > 6e-3 ? 5e-3 : 0}; };
  const auto outwards = [](const Vec3& x) { return Vec3{100 * x[0], 0, x[2] > 6e-3 ? 3.0 : 0}; };
  const auto solid = moved_bar({"axis"}, lifted, outwards);
  const Fragments found = find_fragments(*solid, {}, 0, height);
  ASSERT_EQ(found.list.size(), 2u);
  for (const Fragment& f : found.list)
    for (int c = 0; c < 2; ++c) {
      EXPECT_EQ(f.centre[c], 0);
      EXPECT_EQ(f.velocity[c], 0);
    }
  EXPECT_NEAR(found.list[1].mass, 0.25 * body_mass(small_bar()), 1e-9 * found.list[1].mass);
  EXPECT_NEAR(found.list[1].velocity[2], 3, 1e-12);
}

TEST(Fragments, APointInFreeFlightIsAFragmentOfItsOwn) {
  for (const Planes& planes : all_planes) {
    const auto far = [](const Vec3& x) {
      const bool corner = std::abs(x[0]) > 2e-3 && std::abs(x[1]) > 2e-3 && x[2] < 1e-3;
      return Vec3{corner ? 20 * x[0] : 0, corner ? 20 * x[1] : 0, corner ? -20e-3 : 0};
    };
    const auto solid = moved_bar(planes, far, [](const Vec3& x) {
      return Vec3{0, 0, x[2] < 1e-3 ? -1.0 : 0};
    });
    const Fragments found = find_fragments(*solid, {}, 0, height);
    const FragmentSums ejecta = sum_of(found, FragmentPlace::ejecta);
    EXPECT_GE(ejecta.count, 4);
    EXPECT_EQ(ejecta.lone, ejecta.count);
    EXPECT_NEAR(ejecta.momentum, -ejecta.mass, 1e-12);
    EXPECT_EQ(std::fmod(ejecta.count, 4), 0);
  }
}

TEST(Fragments, ABodyThatTurnsStaysWhole) {
  const double c = std::cos(1.0), s = std::sin(1.0);
  auto solid = small_bar().solid();
  Points& points = solid->points;
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 x = points.initial_position[i];
    points.position.set(i, {c * x[0] - s * x[2], x[1], s * x[0] + c * x[2]});
    points.reference[i] = {c, 0, -s, 0, 1, 0, s, 0, c};
  }
  solid->refresh();
  EXPECT_EQ(find_fragments(*solid, {}, 0, height).list.size(), 1u);
}

TEST(Fragments, ACrackWiderThanTheGapSeparatesThem) {
  for (const double opening : {0.05e-3, 0.15e-3}) {
    const auto solid = moved_bar(
        {},
        [&](const Vec3& x) {
          return Vec3{0, 0, x[2] > 5e-3 ? opening : 0};
        },
        [](const Vec3&) { return Vec3{}; });
    EXPECT_EQ(find_fragments(*solid, {.gap = 0.1}, 0, height).list.size(), opening > 0.1e-3 ? 2u : 1u);
  }
}

TEST(DebrisCone, ItsBinsHoldTheMassTheMomentumAndTheEnergyOfTheDebris) {
  for (const Planes& planes : all_symmetries) {
    const auto lifted = [](const Vec3& x) { return Vec3{0, 0, x[2] > 6e-3 ? 5e-3 : 0}; };
    const auto solid = moved_bar(planes, lifted, [](const Vec3& x) {
      return Vec3{400 * x[0], 100 * x[1], x[2] > 6e-3 ? 2.0 : 0};
    });
    const Fragments found = find_fragments(*solid, {}, 0, height);
    const FragmentSums debris = sum_of(found, FragmentPlace::debris);
    const DebrisCone cone = debris_cone(*solid, found);
    const auto sum = [](const auto& bins) { return std::accumulate(bins.begin(), bins.end(), 0.0); };
    EXPECT_GT(debris.mass, 0);
    EXPECT_NEAR(sum(cone.mass), debris.mass, 1e-12 * debris.mass);
    EXPECT_NEAR(sum(cone.momentum), debris.momentum, 1e-12 * debris.momentum);
    EXPECT_NEAR(sum(cone.kinetic_energy), debris.kinetic_energy, 1e-12 * debris.kinetic_energy);
    EXPECT_GT(cone.half_of_energy, 0);
    EXPECT_LT(cone.half_of_energy, cone.most_of_energy);
  }
}

TEST(DebrisCone, DebrisThatFliesInOneDirectionIsInOneBin) {
  for (const double angle : {0.02, 0.5, 1.4}) {
    const auto solid = moved_bar({}, parting, [&](const Vec3& x) {
      return x[2] > 6e-3 ? Vec3{30 * std::sin(angle), 0, 30 * std::cos(angle)} : Vec3{};
    });
    const Fragments found = find_fragments(*solid, {}, 0, height);
    const DebrisCone cone = debris_cone(*solid, found);
    EXPECT_NEAR(cone.half_of_energy, angle, 1e-6);
    EXPECT_NEAR(cone.most_of_energy, angle, 1e-6);
    for (std::size_t i = 0; i < DebrisCone::bins; ++i)
      EXPECT_EQ(cone.mass[i] > 0, i == static_cast<std::size_t>(angle / DebrisCone::width)) << i;
  }
}

TEST(DebrisCone, WithoutDebrisThereIsNone) {
  const auto solid = small_bar().solid();
  const DebrisCone cone = debris_cone(*solid, find_fragments(*solid, {}, 0, height));
  EXPECT_TRUE(std::isnan(cone.half_of_energy));
  for (const double mass : cone.mass) EXPECT_EQ(mass, 0);
}

} // namespace
} // namespace spall::test
