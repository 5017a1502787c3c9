// Benchmarks of the solver's phases, in seconds per point (columns per_point; "300n" is 300 ns).
//
//   build/tests/benchmark/benchmark_macro --benchmark_min_time=2
//   build/tests/benchmark/benchmark_macro --benchmark_filter=Step --benchmark_repetitions=5
// On a shared machine compare results of the same run only: one thread with two (real time), schemes, float
// with double. The cost of a simulation per point and step is step + refresh / refresh interval.

#include "macro/material/afc.h"
#include "macro/material/j2.h"
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

/// Update of the concrete law with random strain steps about a state of compression and shear. Argument:
/// without (0) or with (1) the Lode effect, whose cost is the ratio of the two results.
void AfcUpdate(benchmark::State& state) {
  Afc afc;
  std::string law;
  Parameters parameters;
  afc.declare(parameters);
  parameters.section("Material").text("Law", law, "");
  parameters.read(SPALL_DATA "/materials/wes5000.prm",
                  {state.range(0) ? "AFC/Lode eccentricity=0.68" : "AFC/Lode eccentricity=1"});
  constexpr std::size_t n = 1024;
  std::vector<Afc::State> states(n);
  std::vector<Sym3> stress(n), increment(n);
  std::vector<double> ratio(n);
  std::vector<Mat3> deformation(n, identity3);
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> strain(-2e-3, 2e-3);
  for (std::size_t i = 0; i < n; ++i) {
    for (double& e : increment[i]) e = strain(engine);
    ratio[i] = 1 - 2e-3 + strain(engine);
    for (int c : {0, 4, 8}) deformation[i][c] = std::cbrt(ratio[i]);
  }
  for (auto _ : state) {
    for (std::size_t i = 0; i < n; ++i)
      benchmark::DoNotOptimize(afc.update(
          stress[i], states[i],
          {.increment = increment[i], .dt = 1e-6, .volume_ratio = ratio[i], .deformation = deformation[i]}));
  }
  count(state, n);
}
BENCHMARK(AfcUpdate)->ArgName("Lode")->Arg(0)->Arg(1);

} // namespace
} // namespace spall
