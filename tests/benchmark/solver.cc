// Benchmarks of the solver's phases, in seconds per point (columns per_point; "300n" is 300 ns).
//
//   build/tests/benchmark/benchmark_macro --benchmark_min_time=2
//   build/tests/benchmark/benchmark_macro --benchmark_filter=Step --benchmark_repetitions=5
// On a shared machine compare results of the same run only: one thread with two (real time), schemes, float
// with double. The cost of a simulation per point and step is step + refresh / refresh interval.

#include "macro/material/afc.h"
#include "macro/material/j2.h"
#include "macro/material/material_inputs.h"
#include "macro/shape/fill.h"
#include "macro/solid/solid.h"

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <random>

namespace spall {
namespace {

/// Aluminium bar of the paper's resolution, full model, in a motion that strains every point.
std::unique_ptr<Solid> bar(const SolidInputs& choice, bool double_precision) {
  J2 metal;
  metal.youngs_modulus = 78.6e9, metal.poisson_ratio = 0.33, metal.initial_yield = 420e6,
  metal.hardening_modulus = 0;
  metal.density = 2700;
  const Cylinder cylinder{.radius = 3.81e-3, .height = 23.47e-3};
  Points points = fill_cylinder(cylinder, {10, 62, Boundary::on_surface}, SymmetryPlanes{}, metal.density);
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 x = points.position[i];
    points.velocity.set(i, {3e3 * x[0], 3e3 * x[1], -6e3 * x[2]});
  }
  SolidInputs inputs = choice;
  inputs.double_precision = double_precision;
  if (is_conforming(inputs.integration.scheme)) {
    inputs.cells = std::make_shared<const ConformingCells>(
        voronoi_cells(points, SymmetryPlanes{}, cylinder_outline(cylinder.radius, 0, cylinder.height)));
    adopt_volumes(points, *inputs.cells);
  }
  return make_solid(metal, std::move(points), SymmetryPlanes{}, inputs);
}

void count(benchmark::State& state, std::size_t points) {
  state.counters["per_point"] =
      benchmark::Counter(static_cast<double>(points),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// The measured choices: every scheme, and other bases, kernels and supports with the default scheme. (With
/// conforming cells the shape functions do not change, and a refresh only pushes gradients forward.)
struct Named {
  const char* name;
  SolidInputs inputs;
};
const std::vector<Named>& choices() {
  static const std::vector<Named> all = [] {
    std::vector<Named> list;
    const auto add = [&](const char* name, IntegrationInputs integration,
                         ApproximationInputs approximation = {}) {
      list.push_back({name, {.approximation = approximation, .integration = integration, .cells = nullptr}});
    };
    const IntegrationInputs nsni;
    add("NSNI", nsni);
    add("SNNI", {.scheme = Scheme::snni});
    add("DNI", {.scheme = Scheme::dni});
    add("M-SNNI K=4", {.scheme = Scheme::m_snni, .subcells = 4});
    add("M-SNNI K=8", {.scheme = Scheme::m_snni, .subcells = 8});
    add("SUBPOINT K=4", {.scheme = Scheme::subpoint, .subcells = 4});
    add("SUBPOINT K=6", {.scheme = Scheme::subpoint, .subcells = 6});
    add("SUBPOINT K=8", {.scheme = Scheme::subpoint, .subcells = 8});
    add("SCNI", {.scheme = Scheme::scni}, {.configuration = Configuration::lagrangian, .support = {}});
    add("M-SCNI K=4", {.scheme = Scheme::m_scni},
        {.configuration = Configuration::lagrangian, .support = {}});
    add("NSNI, quadratic, support 3", nsni, {.order = 2, .support = {.normalized_size = 3}});
    add("NSNI, Wendland C4, support 2.4", nsni,
        {.profile = Profile::wendland_c4, .support = {.normalized_size = 2.4}});
    add("NSNI, box, support 1.8", nsni, {.support = {.shape = SupportShape::box, .normalized_size = 1.8}});
    return list;
  }();
  return all;
}

/// Arguments: choice (index, named in the label), double precision, threads.
void arguments(benchmark::internal::Benchmark* b) {
  b->ArgNames({"choice", "double", "threads"})->UseRealTime()->Unit(benchmark::kMillisecond);
  for (int choice = 0; choice < static_cast<int>(choices().size()); ++choice)
    for (const int precise : {0, 1})
      for (const int threads : {1, 2}) b->Args({choice, precise, threads});
}

void Refresh(benchmark::State& state) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, state.range(2));
  const Named& choice = choices()[state.range(0)];
  state.SetLabel(choice.name);
  const auto solid = bar(choice.inputs, state.range(1) != 0);
  for (auto _ : state) solid->refresh();
  count(state, solid->points.owned);
}
BENCHMARK(Refresh)->Apply(arguments);

void Step(benchmark::State& state) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, state.range(2));
  const Named& choice = choices()[state.range(0)];
  state.SetLabel(choice.name);
  const auto solid = bar(choice.inputs, state.range(1) != 0);
  const double dt = 0.1 * solid->refresh().stable_step;
  // The motion reverses its direction regularly, so that the body neither inverts nor moves away.
  double sign = 1;
  std::size_t steps = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(solid->update(dt, 0));
    if (++steps % 20 == 0) {
      state.PauseTiming();
      sign = -sign;
      for (auto& component : solid->points.velocity.component)
        for (double& v : component) v = -v;
      state.ResumeTiming();
    }
  }
  count(state, solid->points.owned);
}
BENCHMARK(Step)->Apply(arguments);

void CriticalStep(benchmark::State& state) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, state.range(2));
  const Named& choice = choices()[state.range(0)];
  state.SetLabel(choice.name);
  const auto solid = bar(choice.inputs, state.range(1) != 0);
  solid->refresh();
  for (auto _ : state) benchmark::DoNotOptimize(solid->critical_step());
  count(state, solid->points.owned);
}
BENCHMARK(CriticalStep)->Apply(arguments);

/// Update of a law for L points at once, which have random strain steps of 2e-4 that turn their sign in every
/// step: the metal yields, the concrete flows. @param pressed relative decrease of the volume of all points
template<class Law, int L> void update(benchmark::State& state, const Law& law, double pressed) {
  using V = std::conditional_t<L == 1, double, Lanes<double, L>>;
  constexpr std::size_t groups = 256;
  std::vector<typename Law::template StateOf<V>> states(groups);
  std::vector<Sym<V>> stress(groups), increment(groups);
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> strain(-2e-4, 2e-4);
  for (auto& of_group : increment)
    for (V& component : of_group)
      if constexpr (L == 1)
        component = strain(engine);
      else
        for (int m = 0; m < L; ++m) component[m] = strain(engine);
  double sign = 1;
  for (auto _ : state) {
    sign = -sign;
    for (std::size_t g = 0; g < groups; ++g) {
      StrainStepOf<V> step{sign * increment[g], 1e-6, 1 - pressed, identity3, 8e-3};
      benchmark::DoNotOptimize(law.update(stress[g], states[g], step));
    }
  }
  count(state, groups * L);
}

/// Reads a law of data/materials.
template<class Law> Law shipped(const std::string& file, const std::vector<std::string>& changes = {}) {
  MaterialInputs inputs;
  Parameters parameters;
  inputs.declare(parameters);
  parameters.read(SPALL_DATA "/materials/" + file, changes);
  Law law = std::get<Law>(inputs.material());
  law.prepare({8e-3});
  return law;
}

/// The metal in groups of eight points, as bars are computed.
void MetalUpdate(benchmark::State& state) { update<J2, 8>(state, shipped<J2>("aluminium_6061_t6.prm"), 0); }
BENCHMARK(MetalUpdate);

/// The same one point after the other.
void MetalUpdateOneByOne(benchmark::State& state) {
  update<J2, 1>(state, shipped<J2>("aluminium_6061_t6.prm"), 0);
}
BENCHMARK(MetalUpdateOneByOne);

/// The concrete with isotropic cracks in groups of four, as the sub-points of a cell are computed; with (1)
/// or without the Lode effect (0), whose cost is the ratio of the two results.
void ConcreteUpdate(benchmark::State& state) {
  const bool lode = state.range(0) != 0;
  update<Afc, 4>(state,
                 shipped<Afc>("wes5000.prm", {"AFC/Crack model=isotropic", lode ? "AFC/Lode eccentricity=0.68"
                                                                                : "AFC/Lode eccentricity=1"}),
                 2e-3);
}
BENCHMARK(ConcreteUpdate)->ArgName("Lode")->Arg(0)->Arg(1);

} // namespace
} // namespace spall
