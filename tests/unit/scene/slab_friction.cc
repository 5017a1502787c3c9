// The friction of the shipped slabs against what is known of faces that slide under the pressure of a nose.

#include "tests/support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace spall::test {
namespace {

constexpr double pressure = 300e6, contact_time = 1e-3, length = 0.05; // Pa, s, m: of the nose in a slab
constexpr double melting = 1200;                                       // K above the room: silicates, paste

/// What a half-space takes up: sqrt(conductivity density heat capacity), W s^0.5 / (m^2 K).
double effusivity(double conductivity, double density, double heat_capacity) {
  return std::sqrt(conductivity * density * heat_capacity);
}

/// Slip velocity, m/s, above which dry friction melts the faces within the contact time. Both are half-spaces
/// that share the heat mu p v: T = 2 mu p v / (e_steel + e_concrete) sqrt(t / pi) (Carslaw and Jaeger 1959).
double melting_slip(double dry) {
  const double steel = effusivity(40, 7850, 480), concrete = effusivity(1.5, 2300, 900);
  return melting * (steel + concrete) / 2 * std::sqrt(std::numbers::pi / contact_time) / (dry * pressure);
}

/// Coefficient of a molten film that is squeezed out over `length` as fast as its own heat melts it: with the
/// film's thickness h, p = 12 eta V length^2 / h^3 and eta v^2 / h = rho H V, hence
/// mu = sqrt(eta v) (p rho H / (12 length^2))^(1/4) / p (close-contact melting, Bejan 1989).
double of_molten_film(double viscosity, double slip) {
  const double density = 2300, heat = 1000 * melting + 4e5; // kg/m^3; J/kg to the melting point, and to melt
  return std::sqrt(viscosity * slip) * std::pow(pressure * density * heat / (12 * length * length), 0.25) /
         pressure;
}

TEST(SlabFriction, IsThatOfAMoltenFilm) {
  EXPECT_LT(melting_slip(0.57), 3); // steel on concrete at rest: the faces melt at any velocity that counts
  const auto slab = shipped("slab_127.prm", {});
  const double friction = slab->scene.contact.friction.at_rest;
  EXPECT_FALSE(slab->scene.contact.friction.depends_on_velocity());
  EXPECT_GT(friction, of_molten_film(3, 100)); // Pa s: molten silicates have some 3 to 300
  EXPECT_LT(friction, of_molten_film(300, 100));
  EXPECT_NEAR(friction, of_molten_film(30, 200), 0.003); // the middle, while a slab is gone through
}

} // namespace
} // namespace spall::test
