#include "macro/material/oriented_cracks.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace spall {
namespace {

/// Component of a symmetric tensor between normals 1 and 2, 2 and 3, 3 and 1.
constexpr std::array<std::size_t, 3> shear_component = {3, 4, 5};

/// Turns the second and third normal about the first until nothing of s is sheared between them. Returns s in
/// the new axes.
Sym3 turn_about_first(Mat3& normals, const Sym3& s) {
  const double angle = 0.5 * std::atan2(2 * s[4], s[1] - s[2]);
  const double c = std::cos(angle), d = std::sin(angle);
  const Mat3 q = {1, 0, 0, 0, c, d, 0, -d, c};
  normals = multiply(q, normals);
  return rotate(q, s);
}

/// Values of the three cracks in another order.
Vec3 in_order(const Vec3& a, const std::array<std::size_t, 3>& from) {
  return {a[from[0]], a[from[1]], a[from[2]]};
}

/// Puts the crack of one direction first; the normals stay a right-handed set.
void put_first(OrientedCracks::State& state, Sym3& s, std::size_t first) {
  const std::array<std::size_t, 3> from = {first, (first + 1) % 3, (first + 2) % 3};
  const Mat3 n = state.normals;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      state.normals(i, j) = n(static_cast<int>(from[static_cast<std::size_t>(i)]), j);
  for (Vec3* a :
       {&state.opening, &state.largest, &state.touch, &state.limit, &state.damage, &state.shear_share})
    *a = in_order(*a, from);
  const Sym3 t = s;
  for (std::size_t i = 0; i < 3; ++i) s[i] = t[from[i]], s[3 + i] = t[3 + from[i]];
}

} // namespace

Mat3 principal_directions(const Sym3& a) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  Eigen::Matrix3d m;
  m << a[0], a[3], a[5], a[3], a[1], a[4], a[5], a[4], a[2];
  eigen.computeDirect(m);
  const auto& v = eigen.eigenvectors();
  const Vec3 first = {v(0, 2), v(1, 2), v(2, 2)}, second = {v(0, 1), v(1, 1), v(2, 1)},
             third = cross(first, second);
  return {first[0], first[1], first[2], second[0], second[1], second[2], third[0], third[1], third[2]};
}

double OrientedCracks::State::compliance(std::size_t i) const {
  if (!open(i)) return 0;
  return limit[i] > 0 ? (largest[i] - touch[i]) / limit[i] : std::numeric_limits<double>::infinity();
}

Sym3 OrientedCracks::trial(State& state, const Sym3& before, const Sym3& strain, double G) const {
  const auto opening = [&] {
    const double mean = state.total_opening() / 3;
    return Sym3{state.opening[0] - mean, state.opening[1] - mean, state.opening[2] - mean, 0, 0, 0};
  };
  if (model == CrackModel::rotating || !state.cracked()) {
    // The stress without cracks has the same directions as the strain of the point; so has the stress then.
    const Sym3 sound = before + 2 * G * (strain + rotate(transpose(state.normals), opening()));
    state.normals = principal_directions(sound);
    Sym3 s = rotate(state.normals, sound) - 2 * G * opening();
    for (const std::size_t c : shear_component) s[c] = 0;
    return s;
  }
  Sym3 s = rotate(state.normals, before);
  const Sym3 e = rotate(state.normals, strain);
  for (std::size_t i = 0; i < 3; ++i) {
    s[i] += 2 * G * e[i];
    s[shear_component[i]] += 2 * G * state.shear_share[i] * e[shear_component[i]];
  }
  return state.fixed == 1 ? turn_about_first(state.normals, s) : s;
}

bool OrientedCracks::widen(State& state) const {
  bool opens = false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (state.opening[i] <= state.largest[i]) continue;
    opens = true;
    state.largest[i] = state.opening[i];
    if (model == CrackModel::fixed) state.touch[i] = std::max(state.touch[i], kept * state.largest[i]);
  }
  if (opens && model == CrackModel::rotating) {
    const double widest = *std::max_element(state.largest.begin(), state.largest.end());
    state.largest = {widest, widest, widest};
  }
  return opens;
}

double OrientedCracks::settle(State& state, Sym3& s, double pressure, double G) const {
  if (model != CrackModel::fixed || !state.cracked()) return 0;
  if (state.fixed < 3) {
    const auto starts = [&](std::size_t i) { return state.largest[i] > 0; };
    const int count = starts(0) + starts(1) + starts(2);
    if (state.fixed == 0 && count == 1) put_first(state, s, starts(0) ? 0 : starts(1) ? 1 : 2);
    state.fixed = count == 1 ? 1 : 3;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double share = 1 / (1 + G * (state.compliance(i) + state.compliance((i + 1) % 3)));
    if (share < state.shear_share[i]) s[shear_component[i]] *= share / state.shear_share[i];
    state.shear_share[i] = share;
  }
  double slip = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(state.largest[i] > 0)) continue;
    double &along = s[shear_component[i]], &across = s[shear_component[(i + 2) % 3]];
    const double shear = std::sqrt(along * along + across * across),
                 holds = state.limit[i] + friction * std::max(0., pressure - s[i]);
    if (!(shear > holds)) continue;
    along *= holds / shear, across *= holds / shear;
    slip += (shear - holds) / (std::sqrt(3.) * G);
  }
  return slip;
}

void OrientedCracks::keep_open(State& state, const Sym3& strain) const {
  if (model != CrackModel::fixed) return;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!state.open(i) || state.limit[i] > 0) continue;
    const double along = strain[shear_component[i]], across = strain[shear_component[(i + 2) % 3]];
    const double slip = 2 * std::sqrt(along * along + across * across);
    state.touch[i] = std::min(state.opening[i], state.touch[i] + dilatancy * slip);
  }
}

double OrientedCracks::energy(const State& state, const Sym3& stress, double G) {
  if (!state.cracked()) return 0;
  const Sym3 s = rotate(state.normals, stress);
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double gap = state.opening[i] - state.touch[i], range = state.largest[i] - state.touch[i];
    if (gap > 0 && range > 0) sum += state.limit[i] * gap * gap / (2 * range);
    const double share = state.shear_share[i], shear = s[shear_component[i]];
    if (share > 0) sum += shear * shear * (1 / share - 1) / (2 * G);
  }
  return sum;
}

} // namespace spall
