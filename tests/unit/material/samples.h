#pragma once

#include "macro/material/material_inputs.h"
#include "macro/material/single_point.h"
#include "shared/error.h"

#include <random>
#include <string>

namespace spall::test {

constexpr double MPa = 1e6;

/// Reads a material of data/materials, with overrides as on the command line.
inline Material material(const std::string& name, const std::vector<std::string>& changes = {}) {
  MaterialInputs inputs;
  Parameters parameters;
  inputs.declare(parameters);
  parameters.read(std::string(SPALL_DATA "/materials/") + name + ".prm", changes);
  return inputs.material();
}
/// What the checks across keys say of a material of data/materials with overrides; empty: nothing.
inline std::string refusal(const std::string& name, const std::vector<std::string>& changes) {
  MaterialInputs inputs;
  Parameters parameters;
  inputs.declare(parameters);
  parameters.read(std::string(SPALL_DATA "/materials/") + name + ".prm", changes);
  try {
    inputs.validate("file.prm");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}
/// Reads a concrete of data/materials, with cracks that have no direction.
inline Afc concrete(const std::string& name, const std::vector<std::string>& changes = {}) {
  std::vector<std::string> isotropic = {"AFC/Crack model=isotropic"};
  isotropic.insert(isotropic.end(), changes.begin(), changes.end());
  return std::get<Afc>(material(name, isotropic));
}
/// The paper's concrete without the constants that Table 1 does not have, and with its limit of mean tension,
/// so that closed forms hold.
inline Afc wes5000(const std::vector<std::string>& changes = {}) {
  std::vector<std::string> table = {"AFC/Lode eccentricity=1",
                                    "AFC/Lode fading pressure=0 MPa",
                                    "AFC/Shear damage reference length=0 m",
                                    "AFC/Opened volume kept=0",
                                    "AFC/Crack dilatancy=0",
                                    "AFC/Tensile rate law=constant",
                                    "AFC/Tension limits=mean stress",
                                    "AFC/Fracture energy rate exponent=1",
                                    "AFC/Crack band=1",
                                    "AFC/Radial cracks=0"};
  table.insert(table.end(), changes.begin(), changes.end());
  return concrete("wes5000", table);
}

/// Reads a metal of data/materials.
inline J2 metal(const std::string& name) { return std::get<J2>(material(name)); }

/// Components uniform in [-size, size], the same in every run.
class RandomStrain {
public:
  explicit RandomStrain(double size) : range(-size, size) {}
  Sym3 operator()() {
    Sym3 e;
    for (double& x : e) x = range(engine);
    return e;
  }

private:
  std::mt19937 engine{7};
  std::uniform_real_distribution<double> range;
};

/// Returns a rotation about a random axis.
inline Mat3 rotation() {
  const double a = 0.7, b = 1.9;
  const Mat3 z = {std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1};
  const Mat3 x = {1, 0, 0, 0, std::cos(b), -std::sin(b), 0, std::sin(b), std::cos(b)};
  return multiply(z, x);
}

/// R a R^T
inline Sym3 rotate(const Mat3& r, const Sym3& a) {
  const Mat3 full = {a[0], a[3], a[5], a[3], a[1], a[4], a[5], a[4], a[2]};
  const Mat3 b = multiply(multiply(r, full), transpose(r));
  return {b[0], b[4], b[8], b[1], b[5], b[2]};
}

/// Expects equal stress components up to `tolerance`.
#define EXPECT_SAME_STRESS(a, b, tolerance)                                                                  \
  for (int i_ = 0; i_ < 6; ++i_) EXPECT_NEAR((a)[i_], (b)[i_], tolerance) << "component " << i_

} // namespace spall::test
