// The laws of thermodynamics at a point, for every law and every reading of it, along random paths: the work
// is never less than what is stored and what has been dissipated, and what is dissipated never comes back.

#include "tests/unit/material/cracking_cell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace spall::test {
namespace {

constexpr double dt = 1e-6, cell = 16e-3;

/// Work that the trapezoidal rule misses at most in one step, J/m^3, if the step crosses a kink of the stress
/// (onset of tension, of flow, of damage, reversal of the shear stress): K tr(e)^2 / 8 + G e' : e' / 4. And
/// what the round-off of the volume makes.
template<class Law> double missed_work(const Law& law, const SinglePoint<Law>& point, const Sym3& e) {
  const Stiffness stiffness = law.elastic(point.state);
  const Sym3 s = deviator(e);
  constexpr double round_off = 1e-15;
  return stiffness.bulk * trace(e) * trace(e) / 8 + stiffness.shear * contract(s, s) / 4 +
         round_off * std::sqrt(contract(point.stress, point.stress));
}

/// Random strain paths: a random walk about slow swings along a fixed tensor, in pieces between which the
/// tensor, the size of the steps and the orientation of the point change.
template<class Law> class RandomPath {
public:
  /// @param scale_ of all strains: small for a material that yields to small ones
  RandomPath(const Law& law_, unsigned seed, double scale_)
      : law(law_), point(law_, cell), engine(seed), scale(scale_) {}

  void turn() {
    swing = random_tensor(1);
    if (number(0, 1) < 0.5) swing = plus_spherical(0.3 * deviator(swing), number(-1, 1));
    if (number(0, 1) < 0.2) swing = {1, 0, 0, 0, 0, 0};
    size = scale * std::exp(number(std::log(5e-7), std::log(2e-5)));
    walk = number(0, 1) < 0.5 ? 0 : number(0, 1);
    frequency = std::exp(number(std::log(3e-3), std::log(3e-1)));
    phase = number(0, 6.28);
    // A rigid rotation: stress and deformation turn along, work and energy stay.
    point.turn(exponential_of_spin({number(-2, 2), number(-2, 2), number(-2, 2)}));
  }
  Sym3 next() {
    phase += frequency;
    return size * (std::cos(phase) * swing + walk * random_tensor(1));
  }
  double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine); }
  Sym3 random_tensor(double range) {
    Sym3 e;
    for (double& x : e) x = number(-range, range);
    return e;
  }
  double stored() const { return point.volume() * law.stored_energy(point.stress, point.state).total(); }

  const Law& law;
  SinglePoint<Law> point;

private:
  /// A rotation by |w| about w (Rodrigues).
  static Mat3 exponential_of_spin(const Vec3& w) {
    const double angle = norm(w), s = std::sin(angle) / angle, c = (1 - std::cos(angle)) / (angle * angle);
    const Mat3 spin = {0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0};
    return identity3 + s * spin + c * multiply(spin, spin);
  }
  std::mt19937 engine;
  double scale;
  Sym3 swing{};
  double size = 0, walk = 0, frequency = 0, phase = 0;
};

/// What comes back from here on along a path that gives as much as it can: always against the stress.
/// @param step largest strain of a step; near the end they are short against what is left
template<class Law> double recovered(const Law& law, SinglePoint<Law> point, double step, double& missed) {
  const double before = point.work;
  double least = before;
  missed = 0;
  for (int i = 0; i < 500; ++i) {
    const double size = std::sqrt(contract(point.stress, point.stress));
    if (!(size > 1)) break;
    const Sym3 stiff = law.elastic(point.state)(point.stress);
    const double left = size * size / std::sqrt(contract(stiff, stiff)); // elastic strain
    const Sym3 e = -std::min(step, 0.05 * left) / size * point.stress;
    missed += missed_work(law, point, e);
    point.advance(e, dt);
    least = std::min(least, point.work);
  }
  return before - least;
}

/// All laws hold along `paths` random paths of this law.
template<class Law> void expect_lawful(const Law& law, int paths, const std::string& what, double scale = 1) {
  for (int path = 0; path < paths; ++path) {
    RandomPath<Law> walk(law, path, scale);
    double dissipated = 0, most_dissipated = 0, most_stored = 0;
    for (int piece = 0; piece < 4; ++piece) {
      walk.turn();
      for (int i = 0; i < 250; ++i) {
        const Sym3 e = walk.next();
        const double missed = missed_work(law, walk.point, e);
        walk.point.advance(e, dt);
        const double stored = walk.stored(), now = walk.point.work - stored;
        ASSERT_GE(stored, 0);
        ASSERT_GE(now, dissipated - missed - 1e-10 * std::abs(walk.point.work))
            << what << ": dissipation, path " << path << ", piece " << piece << ", step " << i;
        dissipated = now;
        most_dissipated = std::max(most_dissipated, now);
        most_stored = std::max(most_stored, stored);
      }
      // Over the whole path: what the steps miss does not add up.
      ASSERT_GE(dissipated, most_dissipated - 0.01 * most_stored) << what << ": path " << path;
      // Nothing comes back beyond what is stored: along the steepest way, and on the straight way to no
      // strain, which closes the path, with net work that is not negative.
      double missed = 0;
      const double back = recovered(law, walk.point, 5e-6 * scale, missed);
      ASSERT_LE(back, walk.stored() + std::min(missed, 0.01 * most_stored) + 1e-6)
          << what << ": path " << path << ", piece " << piece;
      SinglePoint<Law> home = walk.point;
      const int steps = 1 + static_cast<int>(largest_component(home.strain) / (1e-5 * scale));
      const Sym3 e = -1.0 / steps * home.strain;
      for (int i = 0; i < steps; ++i) home.advance(e, dt);
      ASSERT_GE(home.work, -0.01 * most_stored) << what << ": closed path " << path << ", piece " << piece;
      ASSERT_LE(walk.point.work - home.work, walk.stored() + 0.01 * most_stored) << what << ": " << path;
    }
  }
}

/// Every reading of AFC that is not the default, alone, and presets.
const std::vector<std::vector<std::string>> readings = {
    {},
    {"AFC/Readings=as printed"},
    {"AFC/Readings=as printed", "AFC/Damage definition=strength", "AFC/Invariant=mean stress"},
    {"AFC/Invariant=trace"},
    {"AFC/Hydrostat=printed"},
    {"AFC/Unloading=elastic"},
    {"AFC/Volumetric strain=density ratio"},
    {"AFC/Opened volume kept=0", "AFC/Crack dilatancy=0"},
    {"AFC/Opened volume kept=0.4", "AFC/Crack dilatancy=0"},
    {"AFC/Opened volume kept=1"},
    {"AFC/Crack dilatancy=10"},
    {"AFC/C5 limits=principal difference", "AFC/C5=20 MPa"},
    {"AFC/C5 limits=nothing"},
    {"AFC/Lode range=compression"},
    {"AFC/Lode eccentricity=1"},
    {"AFC/Damage definition=stiffness"},
    {"AFC/Damage definition=stiffness renormalised"},
    {"AFC/Shear damage acts in=compression"},
    {"AFC/Tensile damage acts in=compression and tension"},
    {"AFC/Damage strain=total"},
    {"AFC/Damage weight=none"},
    {"AFC/Tensile rate law=constant"},
    {"AFC/Tensile rate law=fib 2010"},
    {"AFC/Failure strain floor=0"},
    {"AFC/Shear damage=no"},
    {"AFC/Damage law=exponential"}};

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += word + " ";
  return all;
}

TEST(Thermodynamics, HoldsForConcreteInEveryReading) {
  for (const auto& reading : readings)
    for (const bool cracks : {false, true}) {
      Afc afc = concrete("wes5000", reading);
      if (afc.tensile.law == TensileLaw::exponential) afc.prepare({cell});
      if (cracks) afc.tensile.use(cracking_cell(afc, cell, 2.47 * MPa, 80), {cell});
      expect_lawful(afc, 40, joined(reading) + (cracks ? "with a table" : ""));
      if (HasFatalFailure()) return;
    }
}

TEST(Thermodynamics, HoldsForCracksWithDirections) {
  const std::vector<std::vector<std::string>> changes = {
      {},
      {"AFC/Opened volume kept=0", "AFC/Crack dilatancy=0"},
      {"AFC/Opened volume kept=0.4", "AFC/Crack dilatancy=10"},
      {"AFC/Opened volume kept=1"},
      {"AFC/Shear damage=no"},
      {"AFC/Tensile rate law=constant"},
      {"AFC/Damage law=exponential"}};
  for (const auto& reading : changes)
    for (const CrackModel model : {CrackModel::fixed, CrackModel::rotating})
      for (const bool cracks : {false, true}) {
        Afc afc = concrete("wes5000", reading);
        afc.crack_model = model;
        if (afc.tensile.law == TensileLaw::exponential) afc.prepare({cell});
        if (cracks) afc.tensile.use(cracking_cell(afc, cell, 2.47 * MPa, 80), {cell});
        expect_lawful(OrientedAfc(afc), 40,
                      joined(reading) + (model == CrackModel::fixed ? "fixed" : "rotating") +
                          (cracks ? " with a table" : ""));
        if (HasFatalFailure()) return;
      }
}

/// The materials of data/materials. Those that are left out cut the pressure off (Opening::cut_off), which
/// gives back what opening has cost: for verification only.
std::vector<std::string> shipped_materials() {
  const std::set<std::string> left_out = {"wes5000_u", "wes5000_g2", "wes5000_g3"};
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(SPALL_DATA "/materials"))
    if (!left_out.contains(entry.path().stem())) names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

TEST(Thermodynamics, HoldsForEveryShippedMaterialAndLaw) {
  std::set<std::size_t> laws;
  for (const std::string& name : shipped_materials()) {
    Material law = material(name);
    prepare(law, {cell});
    // The cut-off of the soil is at a volumetric strain of 2e-7.
    std::visit([&](const auto& one) { expect_lawful(one, 60, name, name == "soil" ? 1e-3 : 1); }, law);
    if (HasFatalFailure()) return;
    laws.insert(law.index());
  }
  EXPECT_EQ(laws.size(), std::tuple_size_v<Laws>);
}

/// Readings of the other laws that are not the default: material and change.
const std::vector<std::pair<std::string, std::vector<std::string>>> other_readings = {
    {"copper_ofhc_jc", {"Johnson-Cook/Failure=yes", "Johnson-Cook/D1=1e-4", "Johnson-Cook/D2=1e-3"}},
    {"copper_ofhc_jc", {"Johnson-Cook/Specific heat=0.01 J/(kg K)"}},
    {"concrete_48_hjc", {"HJC/Opened volume kept=1"}},
    {"concrete_48_hjc", {"HJC/Opened volume kept=0", "HJC/Crack dilatancy=0"}},
    {"concrete_48_hjc", {"HJC/EFMIN=1e-4"}},
    {"concrete_48_hjc", {"HJC/Tension=damage table", "HJC/Damage law=exponential"}},
    {"concrete_48_hjc", {"HJC/Pcrush=1 MPa", "HJC/mu crush=1e-4", "HJC/Plock=10 MPa", "HJC/mu lock=2e-3"}},
    {"soil",
     {"Foam/Strains=0.0005, 0.01", "Foam/Pressures=1 MPa, 50 MPa", "Foam/Tension cut-off=2 MPa",
      "Foam/a0=1e13", "Foam/a1=2 MPa", "Foam/Shear modulus=2 GPa", "Foam/Unloading modulus=8 GPa"}},
    {"concrete_35_rht", {"RHT/Opened volume kept=0", "RHT/Crack dilatancy=0"}},
    {"concrete_35_rht", {"RHT/EPM=1e-5", "RHT/D1=1e-4"}},
    {"concrete_35_rht", {"RHT/Tension=damage table", "RHT/Damage law=exponential"}},
    {"concrete_35_rht", {"RHT/Pel=1 MPa", "RHT/Pcomp=20 MPa", "RHT/alpha0=1.002"}}};

TEST(Thermodynamics, HoldsForTheReadingsOfTheOtherLaws) {
  for (const auto& reading : other_readings) {
    const auto& name = reading.first;
    const auto& changes = reading.second;
    Material law = material(name, changes);
    prepare(law, {cell});
    std::visit([&](const auto& one) { expect_lawful(one, 60, name + " " + joined(changes)); }, law);
    if (HasFatalFailure()) return;
  }
}

/// The table of data/ in the concrete of data/, at one spacing.
Afc shipped(std::vector<std::string> changes = {}) {
  changes.insert(changes.begin(), "AFC/Crack band=1"); // one point by itself
  changes.push_back("AFC/Tensile rate law=constant");
  changes.push_back("AFC/Damage table=" SPALL_DATA "/tables/wes5000.h5");
  Afc afc = concrete("wes5000", changes);
  afc.prepare({cell});
  return afc;
}

TEST(Thermodynamics, AClosingCrackGivesBackNoMoreThanIsStored) {
  const Afc afc = shipped();
  SinglePoint point(afc, cell);
  const auto pull = [&](double strain) {
    for (int i = 0; i < 1000; ++i) point.advance({strain / 1000, 0, 0, 0, 0, 0}, 1e-6);
  };
  pull(2e-3);
  const double work = point.work, stored = afc.stored_energy(point.stress, point.state).total();
  const Afc::State open = point.state;
  EXPECT_NEAR(work, 4120, 50);
  pull(-2e-3);
  EXPECT_LE(work - point.work, stored + 1);
  EXPECT_NEAR(point.state.plastic_strain, open.plastic_strain, 1e-9);
  EXPECT_NEAR(point.state.shear_damage, open.shear_damage, 1e-9);
  EXPECT_EQ(point.state.tensile_damage, open.tensile_damage);
}

/// Ways to pull, and the share of the opening that is kept.
struct Pull {
  Sym3 direction;
  bool free_sides;
  double kept;
};
class Closing : public ::testing::TestWithParam<Pull> {
protected:
  void pull(SinglePoint<Afc>& point, double strain) {
    for (int i = 0; i < 1000; ++i)
      if (GetParam().free_sides)
        point.advance_with_free_sides(strain / 1000, 1);
      else
        point.advance(strain / 1000 * GetParam().direction, 1);
  }
  Afc afc = shipped({"AFC/Crack dilatancy=0", "AFC/Opened volume kept=" + std::to_string(GetParam().kept)});
};
INSTANTIATE_TEST_SUITE_P(
    Pulls, Closing,
    ::testing::Values(Pull{{1, 0, 0, 0, 0, 0}, false, 0}, Pull{{}, true, 0},
                      Pull{{1, 1, 1, 0, 0, 0}, false, 0}, Pull{{1, 1, 0, 0, 0, 0}, false, 0},
                      Pull{{1, 0.2, 0, 0.3, 0, 0.1}, false, 0}, Pull{{1, 0, 0, 0, 0, 0}, false, 0.1},
                      Pull{{1, 1, 1, 0, 0, 0}, false, 0.5}, Pull{{1, 1, 1, 0, 0, 0}, false, 1}));

// In tension a point unloads towards the strain where its cracks touch, along the secant of the damage in
// force, and loads again along it; from there on it is pressed as if it had never cracked.
TEST_P(Closing, FollowsTheSecantAndThenPresses) {
  for (const double strain : {3e-4, 1e-3, 3e-3}) {
    SinglePoint<Afc> point(afc, cell);
    pull(point, strain);
    const Sym3 open = point.stress;
    const Afc::State state = point.state;
    ASSERT_GT(state.tensile_damage, 0);
    const double volume = trace(point.strain), touching = state.opened;
    for (const double share : {0.75, 0.5, 0.25, 0.01, 0.5, 0.999}) {
      // Of the way from the touching of the cracks.
      const double aim = (touching + share * (volume - touching)) / volume * strain;
      pull(point, aim - point.strain[0]);
      if (touching == 0)
        EXPECT_SAME_STRESS(point.stress, share * open, 1e-3 * std::abs(open[0]) + 1);
      else
        EXPECT_NEAR(trace(point.stress), share * trace(open), 1e-3 * trace(open) + 1);
      EXPECT_NEAR(point.state.plastic_strain, state.plastic_strain, 1e-9);
      // With free sides d_t is late by up to a step, and catches up when the point starts to unload.
      EXPECT_NEAR(point.state.tensile_damage, state.tensile_damage, GetParam().free_sides ? 1e-3 : 1e-9);
      EXPECT_NEAR(point.state.shear_damage, state.shear_damage, 1e-9);
    }
    // Closed and pressed: the elastic line of the sound material, in volume. (Uniaxial, with free sides: E.)
    const double pressed = -1e-4, closed = touching / volume * strain;
    pull(point, closed - point.strain[0]);
    // A step that closes a point is taken with the sound stiffness: with free sides that is an error.
    const double tolerance = 1e-3 * MPa + (GetParam().free_sides ? 1e-3 * strain * afc.youngs_modulus() : 0);
    EXPECT_NEAR(trace(point.stress), 0, tolerance);
    const Sym3 before = point.strain;
    pull(point, pressed);
    if (GetParam().free_sides)
      EXPECT_NEAR(point.stress[0], pressed * afc.youngs_modulus(), tolerance);
    else
      EXPECT_NEAR(trace(point.stress), 3 * afc.bulk_modulus() * (trace(point.strain) - trace(before)),
                  0.01 * MPa);
  }
}

// At P = 0 the concrete has its cohesion; a point that is open and has lost all tension must not find it
// there.
TEST(Cracks, AnOpenPointWithoutAnyStrengthCarriesNoShear) {
  for (const char* kept : {"0", "0.1", "1"}) {
    Afc afc = concrete("wes5000_g3", {std::string("AFC/Opened volume kept=") + kept});
    afc.prepare({cell});
    SinglePoint<Afc> point(afc, cell);
    for (int i = 0; i < 100000 && point.state.tensile_damage < 1; ++i)
      point.advance({5e-6, 0, 0, 0, 0, 0}, 1e-6);
    ASSERT_EQ(point.state.tensile_damage, 1) << kept;
    for (int i = 0; i < 1000; ++i) {
      point.advance({2e-6, 0, 0, 5e-6, 0, 0}, 1e-6); // it opens further and is sheared
      ASSERT_LT(equivalent_stress(deviator(point.stress)), 1) << "kept " << kept << ", Pa";
    }
  }
}

} // namespace
} // namespace spall::test
