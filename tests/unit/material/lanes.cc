// Several points side by side do what each of them does alone.

#include "tests/unit/material/samples.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

constexpr int L = 4;
using V = Lanes<double, L>;

struct Reading {
  std::string name, material;
  std::vector<std::string> changes;
};
void PrintTo(const Reading& reading, std::ostream* stream) { *stream << reading.name; }

class Side : public testing::TestWithParam<Reading> {};

/// Random walks of four points with the same volume and different shapes, pressed and pulled by turns.
TEST_P(Side, BySide) {
  const Afc law = [] {
    Afc made = concrete(GetParam().material, GetParam().changes);
    made.prepare({8e-3});
    return made;
  }();
  SinglePoint<Afc> mean(law, 8e-3); // gives the volume and the deformation that the points share
  std::array<Sym3, L> stress_alone{};
  std::array<Afc::State, L> state_alone{};
  Sym<V> stress{};
  Afc::StateOf<V> state;
  RandomStrain random(1);
  int open = 0, flowed = 0;
  for (int n = 0; n < 6000; ++n) {
    const double size = n % 500 < 250 ? 2e-5 : 2e-4, volume = 3 * size * std::sin(n * 2e-3);
    mean.advance(plus_spherical(size * deviator(random()), volume / 3), 1e-6);
    StrainStepOf<V> step{{}, 1e-6, mean.volume_ratio(), mean.deformation, 8e-3};
    for (std::size_t m = 0; m < L; ++m) {
      const Sym3 increment = plus_spherical(size * deviator(random()), volume / 3);
      put_lane<L>(step.increment, static_cast<int>(m), increment);
      law.update(stress_alone[m], state_alone[m],
                 {increment, step.dt, step.volume_ratio, step.deformation, step.spacing});
    }
    law.update(stress, state, step);
    for (std::size_t m = 0; m < L; ++m) {
      const Afc::State one = state_in_lane<L, Afc::StateOf>(state, static_cast<int>(m));
      const double scale = 1e-9 * (1e6 + largest_component(stress_alone[m]));
      for (std::size_t c = 0; c < 6; ++c) ASSERT_NEAR(stress[c][m], stress_alone[m][c], scale) << n;
      for (const auto& field : Afc::fields)
        ASSERT_NEAR(one.*field.value, state_alone[m].*field.value, 1e-9) << field.name << n;
    }
    open += trace(stress_alone[0]) > 0;
    flowed += state_alone[0].plastic_strain > 0;
  }
  EXPECT_GT(open, 100);
  EXPECT_GT(flowed, 100);
}

INSTANTIATE_TEST_SUITE_P(
    Readings, Side,
    testing::Values(Reading{"ours", "wes5000", {"AFC/Damage table=" SPALL_DATA "/tables/wes5000.h5"}},
                    Reading{"as_printed", "wes5000", {"AFC/Readings=as printed"}},
                    Reading{"cut_off", "wes5000_u", {}},
                    Reading{"principal_difference", "wes5000", {"AFC/C5 limits=principal difference"}}),
    [](const auto& tested) { return tested.param.name; });

/// The functions of lanes are those of the standard library.
TEST(LaneMath, IsThatOfNumbers) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int n = 0; n < 100000; ++n) {
    const double u = unit(engine), x = 600 * u, y = std::exp(300 * unit(engine));
    EXPECT_NEAR(exponential_function(x) / std::exp(x), 1, 5e-16);
    EXPECT_NEAR(natural_logarithm(y), std::log(y), 5e-16 * std::max(1., std::abs(std::log(y))));
    EXPECT_NEAR(cosine_of_third(u), std::cos(std::acos(u) / 3), 1e-14);
    const V several{x, -x, 0.5 * x, 0};
    EXPECT_NEAR(exponential_function(several)[2] / std::exp(0.5 * x), 1, 5e-16);
    EXPECT_NEAR(natural_logarithm(V{y, 1, 2, 3})[0], std::log(y),
                5e-16 * std::max(1., std::abs(std::log(y))));
  }
  EXPECT_EQ(natural_logarithm(1.), 0);
  EXPECT_EQ(exponential_function(0.), 1);
  EXPECT_NEAR(cosine_of_third(-1.), 0.5, 1e-14);
  EXPECT_NEAR(cosine_of_third(1.), 1, 1e-14);
}

} // namespace
} // namespace spall::test
