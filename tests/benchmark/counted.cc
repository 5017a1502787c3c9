// Kernels of the solver with small fixed inputs, whose instructions `.ci/run numbers` counts:
//
//   build/tests/benchmark/counted NAME
//
// runs one of them. Everything but the function `counted` is left out of the count, so that neither the start
// of the program nor its inputs matter. One thread, no random numbers: the same instructions every time. The
// target is compiled for any x86-64 processor (CMakeLists.txt), as `-march=native` makes other instructions
// on every machine, some of which valgrind does not know.

#include "macro/integration/gradient_operators.h"
#include "macro/material/afc.h"
#include "macro/material/j2.h"
#include "tests/unit/points/clouds.h"

#include <tbb/global_control.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <stdexcept>

namespace {
using namespace spall;

/// Numbers between -1 and 1 without a pattern: the fractional parts of multiples of the golden ratio.
double scattered(std::size_t i) {
  return 2 * std::fmod(0.6180339887498949 * static_cast<double>(i + 1), 1.0) - 1;
}

/// Points of a material and strain steps of up to 0.2 % about a state of compression and shear, as in
/// tests/benchmark.
template<class Law> struct MaterialPoints {
  static constexpr std::size_t count = 64, rounds = 20;
  Law law;
  std::vector<typename Law::State> states{count};
  std::vector<Sym3> stress{count}, increment{count};
  std::vector<Mat3> deformation{count, identity3};
  std::vector<double> ratio = std::vector<double>(count);

  explicit MaterialPoints(Law chosen) : law(std::move(chosen)) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t c = 0; c < 6; ++c) increment[i][c] = 2e-3 * scattered(7 * i + c);
      ratio[i] = 1 - 2e-3 + 2e-3 * scattered(7 * i + 6);
      for (int c : {0, 4, 8}) deformation[i][c] = std::cbrt(ratio[i]);
    }
  }
  double run() {
    double sum = 0;
    for (std::size_t round = 0; round < rounds; ++round)
      for (std::size_t i = 0; i < count; ++i) {
        law.update(
            stress[i], states[i],
            {.increment = increment[i], .dt = 1e-6, .volume_ratio = ratio[i], .deformation = deformation[i]});
        sum += stress[i][0];
      }
    return sum;
  }
};

/// A block of points off a lattice, its neighbours, and the gradient operators of one scheme for them.
struct Refresh {
  static constexpr std::size_t edge = 8;
  static constexpr double spacing = 0.01;
  Points points;
  std::vector<Support> supports;
  ApproximationInputs approximation;
  IntegrationInputs integration;
  NeighborSearch search;
  GradientOperators<float> operators;
  OperatorScratch<float> scratch;

  explicit Refresh(const IntegrationInputs& scheme) : integration(scheme) {
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < edge * edge * edge; ++i) {
      const auto place = [&](std::size_t k, std::size_t c) {
        return spacing * (static_cast<double>(k) + 0.1 * scattered(3 * i + c));
      };
      places.push_back({place(i % edge, 0), place(i / edge % edge, 1), place(i / edge / edge, 2)});
    }
    points = test::points_at(places, spacing);
    for (std::size_t i = 0; i < points.owned; ++i)
      supports.push_back(make_support(points.deformation(i), points.spacing[i], approximation.support));
    operators.end = points.owned;
    run(); // the first pass allocates; where memory then lies is a matter of the environment
  }
  double run() {
    search.rebuild(points, spacing);
    const std::string failure =
        build_gradient_operators(operators, {points, search, supports, approximation, integration}, scratch);
    if (!failure.empty()) throw std::runtime_error(failure);
    return static_cast<double>(operators.column.size());
  }
};

Afc concrete(const char* file) {
  Afc afc;
  std::string law;
  Parameters parameters;
  afc.declare(parameters);
  parameters.section("Material").text("Law", law, "");
  parameters.read(file, {});
  return afc;
}

J2 aluminium() {
  J2 metal;
  metal.youngs_modulus = 78.6e9, metal.poisson_ratio = 0.33, metal.initial_yield = 420e6,
  metal.hardening_modulus = 0;
  metal.density = 2700;
  return metal;
}
} // namespace

/// The only function whose instructions are counted.
extern "C" __attribute__((noinline)) double counted(const std::function<double()>& kernel) {
  return kernel();
}

int main(int argc, char** argv) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  MaterialPoints<J2> metal(aluminium());
  MaterialPoints<Afc> afc(concrete(SPALL_DATA "/materials/wes5000.prm"));
  Refresh nsni({.scheme = Scheme::nsni}), subpoint({.scheme = Scheme::subpoint, .subcells = 8});
  const std::map<std::string, std::function<double()>> kernels = {
      {"j2_update", [&] { return metal.run(); }},
      {"afc_update", [&] { return afc.run(); }},
      {"refresh_nsni", [&] { return nsni.run(); }},
      {"refresh_subpoint", [&] { return subpoint.run(); }}};
  const auto chosen = argc == 2 ? kernels.find(argv[1]) : kernels.end();
  if (chosen == kernels.end()) {
    std::cerr << "usage: counted NAME; allowed:";
    for (const auto& kernel : kernels) std::cerr << ' ' << kernel.first;
    std::cerr << '\n';
    return 2;
  }
  std::cout << chosen->first << ' ' << counted(chosen->second) << '\n';
}
