// Tests of the stresses at sub-points, compared with those of a single point.

#include "macro/solid/stress_store.h"
#include "macro/material/oriented_afc.h"

#include "tests/unit/material/samples.h"
#include "tests/unit/solid/samples.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

constexpr double dt = 1e-6;

IntegrationInputs subpoints(int used) { return {.scheme = Scheme::subpoint, .subcells = used}; }
IntegrationInputs subpoints_around_axis() { return {.scheme = Scheme::subpoint, .axisymmetric = true}; }

J2 elastic_metal() {
  return {.youngs_modulus = 70e9,
          .poisson_ratio = 0.3,
          .initial_yield = 1e30,
          .hardening_modulus = 0,
          .density = 2700};
}

/// Rates of L operators in the form of a store, which advances several points at once: the same for all.
template<class Store> auto arranged(const MatLanes<Store::lanes>& rate) {
  std::array<MatLanes<Store::lanes>, Store::group> of_points;
  of_points.fill(rate);
  return Store::arrange(of_points);
}

/// The values of the first of the points that a store advances at once.
template<class Store> Sym3 first_point(const Sym<typename Store::V>& a) { return lane<Store::group>(a, 0); }
/// The tensors of its operators, from their form in the store.
template<class Store>
SymLanes<Store::lanes> operators(const std::array<Sym<typename Store::W>, Store::N>& a) {
  if constexpr (Store::group == 1) {
    return a[0];
  } else {
    SymLanes<Store::lanes> all;
    for (std::size_t m = 0; m < a.size(); ++m)
      put_lane<Store::lanes>(all, static_cast<int>(m), first_point<Store>(a[m]));
    return all;
  }
}

/// Drives a store of one point by rates of deformation, with the state that a solid holds for it.
template<class Store, class Material> struct Driver {
  static constexpr int L = Store::lanes;
  using V = typename Store::V;
  const Material& material;
  Store store;
  Sym3 stress{};
  Mat3 deformation = identity3;
  double work = 0, stabilization_work = 0;
  SymLanes<L> strain{};         ///< sum of the strain increments
  SymLanes<L> last{}, turned{}; ///< stresses, increments of the last step

  Driver(const Material& m, const IntegrationInputs& inputs) : material(m), store(1, inputs) {}
  void step(const MatLanes<L>& rate) {
    PointGroup<Store::group> point;
    point.add(0);
    point.fill();
    const auto rates = arranged<Store>(rate);
    Mat<V> start;
    Sym<V> stresses;
    for (int m = 0; m < Store::group; ++m)
      put_lane<Store::group>(start, m, deformation), put_lane<Store::group>(stresses, m, stress);
    const auto k = step_kinematics(rates, store.node_rate(rates), start, dt);
    const auto result =
        store.advance(material, point, stresses, k,
                      StressStep<V>{.dt = dt, .volume_ratio = k.volume_factor, .deformation = k.end});
    deformation = lane<Store::group>(k.end, 0);
    stress = first_point<Store>(stresses);
    last = operators<Store>(result.stresses);
    turned = operators<Store>(k.increment);
    work += get_lane<Store::group, double>(result.work, 0);
    stabilization_work += get_lane<Store::group, double>(result.stabilization_work, 0);
    strain += turned;
  }
};

/// Returns the same rate at the first `used` sub-points and zero in the other lanes.
template<int L> MatLanes<L> uniform(const Mat3& rate, int used) {
  MatLanes<L> rates{};
  for (int q = 0; q < used; ++q) put_lane<L>(rates, q, rate);
  return rates;
}

template<int L, class Material> void expect_the_answer_of_a_plain_point(const Material& material, int used) {
  Driver<PlainStress<Material, double>, Material> plain(material, {});
  Driver<SubpointStress<Material, double, L>, Material> cell(material, subpoints(used));
  RandomTensors random;
  const double largest = 100e6;
  for (int n = 0; n < 60; ++n) {
    const Mat3 rate = random.matrix(2e-3 / dt);
    plain.step(uniform<1>(rate, 1));
    cell.step(uniform<L>(rate, used));
    for (int c = 0; c < 6; ++c) ASSERT_NEAR(cell.stress[c], plain.stress[c], 1e-9 * largest) << n;
    Sym3 sum{};
    for (int q = 0; q < used; ++q) sum += lane<L>(cell.last, q);
    for (int c = 0; c < 6; ++c) ASSERT_NEAR(sum[c], plain.stress[c], 1e-9 * largest) << n;
  }
  EXPECT_NEAR(cell.work, plain.work, 1e-9 * std::abs(plain.work));
  EXPECT_NEAR(cell.stabilization_work, 0, 1e-9 * std::abs(plain.work));
  for (const auto& field : Material::fields)
    EXPECT_NEAR(cell.store.history(0, field.value), plain.store.history(0, field.value), 1e-9) << field.name;
  EXPECT_GT(plain.store.history(0, &Material::State::plastic_strain), 1e-3);
}

TEST(SubpointStress, HomogeneousStrainGivesTheStressOfASinglePoint) {
  const J2 aluminium = metal("aluminium_6061_t6");
  const Afc concrete = wes5000();
  expect_the_answer_of_a_plain_point<4>(aluminium, 4);
  expect_the_answer_of_a_plain_point<8>(aluminium, 6);
  expect_the_answer_of_a_plain_point<8>(aluminium, 8);
  expect_the_answer_of_a_plain_point<4>(concrete, 4);
  expect_the_answer_of_a_plain_point<8>(concrete, 6);
}

/// Returns different rates at six sub-points.
MatLanes<8> different(RandomTensors& random, double size) {
  MatLanes<8> rate{};
  for (auto& entry : rate)
    for (int q = 0; q < 6; ++q) entry[q] = size * random.number();
  return rate;
}

TEST(SubpointStress, DifferencesOfVolumeInsideTheCellDoNoWork) {
  const Afc concrete = wes5000();
  Driver<SubpointStress<Afc, double, 8>, Afc> cell(concrete, subpoints(6)), breathing = cell;
  RandomTensors random(2);
  for (int n = 0; n < 30; ++n) {
    MatLanes<8> rate = different(random, 1e-4 / dt);
    cell.step(rate);
    // The volumes of the sub-points change in the present configuration, that of the node does not.
    const Mat3& f = breathing.deformation;
    double total = 0;
    for (int q = 0; q < 6; ++q) {
      const double swelling = q < 5 ? 1e-3 / dt * random.number() : -total;
      total += swelling;
      for (int c = 0; c < 9; ++c) rate[c][q] += swelling * f[c];
    }
    breathing.step(rate);
  }
  // The volume change refers to F at the start of the step, which differs from F at midstep by the size of an
  // increment.
  for (int c = 0; c < 6; ++c)
    EXPECT_NEAR(breathing.stress[c], cell.stress[c], 2e-3 * std::abs(cell.stress[0]) + 1e3);
  EXPECT_NEAR(breathing.work, cell.work, 1e-2 * cell.work);
}

TEST(SubpointStress, ElasticWorkIsTheEnergyStored) {
  const J2 metal = elastic_metal();
  Driver<SubpointStress<J2, double, 8>, J2> cell(metal, subpoints(6));
  RandomTensors random(3);
  MatLanes<8> rate = different(random, 1e-6 / dt);
  for (int c = 0; c < 3; ++c) // no spin
    for (int i = 0; i < c; ++i) rate(c, i) = rate(i, c);
  for (int n = 0; n < 50; ++n) cell.step(rate);
  // The mean of K e^2 / 2 + G d : d over the sub-points, where d is the deviator and e the volume strain:
  // that of the mean, and the differences along x, y, z between two sub-points each.
  double shear = 0;
  Lanes<double, 8> e{};
  for (int q = 0; q < 6; ++q) {
    e[q] = trace(lane<8>(cell.strain, q));
    const Sym3 d = deviator(lane<8>(cell.strain, q));
    shear += contract(d, d) / 6;
  }
  const double mean = sum_of_lanes(e) / 6;
  double volume = mean * mean;
  for (int q = 0; q < 6; q += 2) volume += 2 * std::pow(0.5 * (e[q] - e[q + 1]), 2) / 6;
  const double stored = 0.5 * metal.bulk_modulus() * volume + metal.shear_modulus() * shear;
  EXPECT_NEAR(cell.work + cell.stabilization_work, stored, 1e-3 * stored); // strains are 5e-5
  EXPECT_GT(cell.stabilization_work, 0.1 * stored);
}

/// Cells that resist more than the linear part of the volume rate lock where the concrete flows.
TEST(SubpointStress, VolumeThatDoesNotChangeLinearlyOverTheCellIsNotResisted) {
  const J2 metal = elastic_metal();
  const auto swell = [&]<int L>(const IntegrationInputs& inputs, const std::vector<double>& swelling) {
    Driver<SubpointStress<J2, double, L>, J2> cell(metal, inputs);
    MatLanes<L> rate{};
    for (std::size_t q = 0; q < swelling.size(); ++q)
      put_lane<L>(rate, static_cast<int>(q), 1e-6 / dt * swelling[q] * identity3);
    cell.step(rate);
    return cell.work + cell.stabilization_work;
  };
  const double of_mean = swell.operator()<4>(subpoints_around_axis(), {1, 1, 1, 1});
  // Sub-points along +x, +z, -x, -z, and along both sides of x, y, z.
  EXPECT_NEAR(swell.operator()<4>(subpoints_around_axis(), {1, -1, 1, -1}), 0, 1e-9 * of_mean);
  EXPECT_NEAR(swell.operator()<4>(subpoints_around_axis(), {1, 1, -1, -1}), of_mean, 1e-4 * of_mean);
  EXPECT_NEAR(swell.operator()<8>(subpoints(6), {1, 1, -1, -1, 0, 0}), 0, 1e-9 * of_mean);
  EXPECT_NEAR(swell.operator()<8>(subpoints(6), {1, -1, 1, -1, 1, -1}), of_mean, 1e-4 * of_mean);
  // Every difference between the corners of a tetrahedron is linear.
  EXPECT_NEAR(swell.operator()<4>(subpoints(4), {1, -1, 1, -1}), of_mean, 1e-4 * of_mean);
}

/// Fragments: the sub-points of a cell crack, come apart by as much as their size, and are strained between.
TEST(SubpointStress, CracksThatOpenDifferentlyGiveBackNoMoreThanIsStored) {
  Afc concrete = wes5000();
  concrete.crack_model = CrackModel::fixed;
  const OrientedAfc law(concrete);
  for (unsigned seed = 0; seed < 10; ++seed) {
    Driver<SubpointStress<OrientedAfc, double, 8>, OrientedAfc> cell(law, subpoints(6));
    RandomTensors random(seed);
    double work = 0, dissipated = 0, most_stored = 0;
    for (int piece = 0; piece < 12; ++piece) {
      const bool wide = piece % 3 == 0;
      const int steps = wide ? 10000 : 2000;
      MatLanes<8> rate = different(random, (wide ? 0.3 : 3e-4) / steps / dt);
      if (wide) rate += uniform<8>(0.15 / steps / dt * identity3, 6);
      for (int n = 0; n < steps; ++n) {
        const double before = cell.work + cell.stabilization_work, volume = determinant(cell.deformation);
        cell.step(rate);
        const double volume_after = determinant(cell.deformation),
                     stored = volume_after * cell.store.stored(law, 0, cell.stress).total();
        work += (cell.work + cell.stabilization_work - before) * (volume + volume_after) / 2;
        most_stored = std::max(most_stored, stored);
        ASSERT_GE(work - stored, 0.999 * dissipated - 0.05 * most_stored - 1)
            << "seed " << seed << ", " << piece << ", " << n;
        dissipated = std::max(dissipated, work - stored);
      }
    }
    EXPECT_GT(cell.store.history(0, &OrientedAfc::State::opened), 0.1);
  }
}

TEST(SubpointStress, TheForceDoesTheRecordedWork) {
  // Work of the next small step with the stresses of this one: stress : D summed over the sub-points.
  const Afc concrete = wes5000();
  Driver<SubpointStress<Afc, double, 8>, Afc> cell(concrete, subpoints(6));
  RandomTensors random(4);
  for (int n = 0; n < 20; ++n) cell.step(different(random, 2e-4 / dt));
  const SymLanes<8> stress = cell.last;
  const MatLanes<8> rate = different(random, 1e-9 / dt);
  const double before = cell.work + cell.stabilization_work;
  cell.step(rate);
  double power = 0;
  for (int c = 0; c < 6; ++c)
    for (int q = 0; q < 8; ++q) power += (c < 3 ? 1 : 2) * stress[c][q] * cell.turned[c][q];
  EXPECT_NEAR(cell.work + cell.stabilization_work - before, power, 1e-4 * std::abs(power));
}

TEST(SubpointStress, ARotationOfTheCellTurnsAllSubpoints) {
  const J2 aluminium = metal("aluminium_6061_t6");
  Driver<SubpointStress<J2, double, 4>, J2> cell(aluminium, subpoints(4));
  RandomTensors random(5);
  MatLanes<4> rate{};
  for (auto& entry : rate)
    for (int q = 0; q < 4; ++q) entry[q] = 1e-2 / dt * random.number();
  cell.step(rate);
  const SymLanes<4> before = cell.last;
  const Sym3 stress = cell.stress;
  const Mat3 q = random.rotation(0.8), end = multiply(q, cell.deformation);
  const Mat3 turning = (end - cell.deformation) / dt;
  cell.step(uniform<4>(turning, 4));
  const SymLanes<4> expected = spall::rotate(q, before);
  const Sym3 turned = spall::rotate(q, stress);
  for (int c = 0; c < 6; ++c) {
    EXPECT_NEAR(cell.stress[c], turned[c], 1e-4);
    for (int m = 0; m < 4; ++m) EXPECT_NEAR(cell.last[c][m], expected[c][m], 1e-4);
  }
}

TEST(StressStores, TheElasticOperatorIsTheSlopeOfAdvance) {
  const J2 metal = elastic_metal();
  const auto check = [&]<class Store>(const IntegrationInputs& inputs) {
    constexpr int L = Store::lanes;
    RandomTensors random(6);
    MatLanes<L> rate{};
    for (auto& entry : rate)
      for (int m = 0; m < L; ++m) set_lane<L, double>(entry, m, 1e-9 / dt * random.number());
    Driver<Store, J2> point(metal, inputs);
    point.step(rate);
    const auto elastic = point.store.elastic(metal, 0, point.turned);
    for (int c = 0; c < 6; ++c)
      for (int m = 0; m < L; ++m) {
        const double e = get_lane<L, double>(elastic[c], m), s = get_lane<L, double>(point.last[c], m);
        EXPECT_NEAR(s, e, 1e-5 * std::abs(e) + 1e-7) << m;
      }
  };
  check.operator()<PlainStress<J2, double>>({});
  check.operator()<MomentStress<J2, double, 4>>({.stabilization = 0.3});
  check.operator()<MomentStress<J2, double, 8>>({.stabilization = 0.3});
  check.operator()<SubpointStress<J2, double, 4>>(subpoints(4));
  check.operator()<SubpointStress<J2, double, 8>>(subpoints(8));
}

/// Points that are advanced at once, with a law that takes them at once and one that takes them one by one.
TEST(StressStores, PointsSideBySideDoWhatEachDoesAlone) {
  const auto check = [&]<class Store>(const auto& material, const IntegrationInputs& inputs) {
    constexpr int P = Store::group, points = 11;
    using V = typename Store::V;
    using Rate = Mat<Lanes<double, Store::lanes>>;
    Store together(points, inputs), alone(points, inputs);
    std::vector<Sym3> stress_together(points), stress_alone(points);
    RandomTensors random(7);
    // As many at once as there is room for, in an order of their own, and fewer.
    const std::vector<std::vector<std::size_t>> groups = {{0, 2, 3, 4, 7, 8, 9, 10}, {1, 5, 6}};
    for (int n = 0; n < 30; ++n) {
      std::vector<Rate> rate(points);
      for (Rate& r : rate)
        for (auto& entry : r)
          for (int m = 0; m < Store::lanes; ++m)
            set_lane<Store::lanes, double>(entry, m, 3e-3 / dt * random.number());
      const auto advance = [&](Store& store, const std::vector<std::size_t>& members,
                               std::vector<Sym3>& stress) {
        PointGroup<P> group;
        for (const std::size_t i : members) group.add(i);
        group.fill();
        std::array<Rate, P> gathered;
        for (std::size_t m = 0; m < P; ++m) gathered[m] = rate[group.point[m]];
        const auto rates = Store::arrange(gathered);
        const auto k = step_kinematics(rates, store.node_rate(rates), identity_of<V>(), dt);
        Sym<V> stresses = load(stress, group);
        store.advance(material, group, stresses, k,
                      StressStep<V>{.dt = dt, .volume_ratio = k.volume_factor, .deformation = k.end});
        spall::store(stress, group, stresses);
      };
      for (const auto& group : groups) advance(together, group, stress_together);
      for (std::size_t i = 0; i < points; ++i) advance(alone, {i}, stress_alone);
    }
    double plastic = 0;
    for (std::size_t i = 0; i < points; ++i) {
      for (std::size_t c = 0; c < 6; ++c)
        EXPECT_NEAR(stress_together[i][c], stress_alone[i][c], 1e-3) << i; // of 1e8 Pa
      const auto strain = &std::decay_t<decltype(material)>::State::plastic_strain;
      EXPECT_NEAR(together.history(i, strain), alone.history(i, strain), 1e-12);
      plastic += alone.history(i, strain);
    }
    EXPECT_GT(plastic, 1e-2);
  };
  const J2 aluminium = metal("aluminium_6061_t6");
  const Afc concrete = wes5000();
  check.operator()<MomentStress<J2, double, 4>>(aluminium, {.stabilization = 0.3});
  check.operator()<PlainStress<J2, double>>(aluminium, {});
  check.operator()<PlainStress<Afc, double>>(concrete, {});
}

} // namespace
} // namespace spall::test
