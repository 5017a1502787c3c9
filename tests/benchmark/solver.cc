// Cost of the solver's phases in seconds per point (columns per_point; "300n" is 300 ns).
//
//   build/tests/benchmark/benchmark_macro --benchmark_min_time=2
//   build/tests/benchmark/benchmark_macro --benchmark_filter=Step --benchmark_repetitions=5
//
// On a machine that is shared compare ratios of one run, not numbers of two: one thread with two (real time),
// schemes, float with double. A run's cost per point and step is step + refresh / refresh interval.

#include "macro/dynamics/solid.h"
#include "macro/material/afc.h"
#include "macro/material/j2.h"
#include "macro/scene/fill.h"
#include "macro/scene/scene_inputs.h"

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <random>

namespace spall {
namespace {

/// Aluminium bar of the paper's resolution, full model, in a motion that strains every point.
std::unique_ptr<Solid> bar(Scheme scheme, bool double_precision) {
  J2 metal;
  metal.youngs_modulus = 78.6e9, metal.poisson_ratio = 0.33, metal.initial_yield = 420e6,
  metal.hardening_modulus = 0;
  metal.density = 2700;
  Points points = fill_cylinder({.radius = 3.81e-3, .height = 23.47e-3}, 10, 62, Boundary::on_surface,
                                SymmetryPlanes{}, metal.density);
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 x = points.position[i];
    points.velocity.set(i, {3e3 * x[0], 3e3 * x[1], -6e3 * x[2]});
  }
  SolidInputs inputs;
  inputs.integration.scheme = scheme;
  inputs.double_precision = double_precision;
  return make_solid(metal, std::move(points), SymmetryPlanes{}, inputs);
}

void count(benchmark::State& state, std::size_t points) {
  state.counters["per_point"] =
      benchmark::Counter(static_cast<double>(points),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

constexpr Scheme schemes[] = {Scheme::nsni, Scheme::snni, Scheme::dni, Scheme::m_snni, Scheme::subpoint};

/// Arguments: scheme (index), double precision, threads.
void arguments(benchmark::internal::Benchmark* b) {
  b->ArgNames({"scheme", "double", "threads"})->UseRealTime()->Unit(benchmark::kMillisecond);
  for (int scheme = 0; scheme < 5; ++scheme)
    for (const int precise : {0, 1})
      for (const int threads : {1, 2}) b->Args({scheme, precise, threads});
}

void Refresh(benchmark::State& state) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, state.range(2));
  const auto solid = bar(schemes[state.range(0)], state.range(1) != 0);
  for (auto _ : state) solid->refresh();
  count(state, solid->points.owned);
}
BENCHMARK(Refresh)->Apply(arguments);

void Step(benchmark::State& state) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, state.range(2));
  const auto solid = bar(schemes[state.range(0)], state.range(1) != 0);
  const double dt = 0.1 * solid->refresh().stable_step;
  // Forth and back, so that the body neither inverts nor moves away however long it runs.
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
  const auto solid = bar(schemes[state.range(0)], state.range(1) != 0);
  solid->refresh();
  for (auto _ : state) benchmark::DoNotOptimize(solid->critical_step());
  count(state, solid->points.owned);
}
BENCHMARK(CriticalStep)->Apply(arguments);

/// Concrete with random strain steps about a state of compression and shear.
void AfcUpdate(benchmark::State& state) {
  SceneInputs scene;
  Parameters parameters;
  scene.declare(parameters);
  parameters.read(SPALL_DATA "/materials/wes5000.prm", {"Scene/Kind=taylor", "Scene/Impact velocity=1 m/s",
                                                        "Body/Diameter=1 m", "Body/Height=1 m"});
  const Afc afc = scene.afc;
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
BENCHMARK(AfcUpdate);

} // namespace
} // namespace spall
