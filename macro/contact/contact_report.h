#pragma once

#include "macro/points/tensor.h"
#include "shared/archive.h"
#include "shared/ranks.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace spall {

/// Impulses that bodies have given to each other, N s, for all pairs of bodies. Of the modelled part:
/// symmetry planes take up what crosses them, so given(a, b) and -given(b, a) may differ along their normals.
class ImpulseMatrix {
public:
  ImpulseMatrix() = default;
  explicit ImpulseMatrix(std::size_t bodies) : count(bodies), entries(bodies * bodies) {}

  std::size_t bodies() const { return count; }
  /// Impulse that body a has given to body b, N s.
  const Vec3& given(std::size_t a, std::size_t b) const { return entries[a * count + b]; }
  Vec3& given(std::size_t a, std::size_t b) { return entries[a * count + b]; }
  /// Impulse that body b has received from all others, N s.
  Vec3 received(std::size_t b) const {
    Vec3 sum{};
    for (std::size_t a = 0; a < count; ++a) sum += given(a, b);
    return sum;
  }
  /// Adds another matrix, whose bodies are the first ones of this.
  void add(const ImpulseMatrix& part) {
    for (std::size_t a = 0; a < part.count; ++a)
      for (std::size_t b = 0; b < part.count; ++b) given(a, b) += part.given(a, b);
  }
  void transfer(Archive& archive) { archive("impulse_matrix", entries); }

private:
  std::size_t count = 0;
  std::vector<Vec3> entries; ///< entries row by row: all impulses that body 0 has given, then body 1, ...
};

/// Results of the contact in one step. The losses are minus the work of the impulses on all bodies together.
struct ContactReport {
  double normal_loss = 0;          ///< energy lost by normal impulses (points are stopped without rebound), J
  double friction_loss = 0;        ///< energy lost by friction, J
  std::size_t touching = 0;        ///< points that got an impulse
  double deepest = 0;              ///< deepest overlap at the start of the step, m
  double gap_sum = 0, gap_max = 0; ///< |gap| of touching points at the start of the step, m
  double largest_drift = 0; ///< largest distance of bonded points from the places where they are held, m

  void count_gap(double gap) {
    ++touching;
    gap_sum += std::abs(gap);
    gap_max = std::max(gap_max, std::abs(gap));
  }
  ContactReport& operator+=(const ContactReport& other) {
    normal_loss += other.normal_loss;
    friction_loss += other.friction_loss;
    touching += other.touching;
    deepest = std::max(deepest, other.deepest);
    gap_sum += other.gap_sum;
    gap_max = std::max(gap_max, other.gap_max);
    largest_drift = std::max(largest_drift, other.largest_drift);
    return *this;
  }
  void list(Reduction& of_ranks) {
    for (double* sum : {&normal_loss, &friction_loss, &gap_sum}) of_ranks.sums.push_back(sum);
    of_ranks.counts.push_back(&touching);
    for (double* extreme : {&deepest, &gap_max, &largest_drift}) of_ranks.largest.push_back(extreme);
  }
};

/// Results of the contact between deformable bodies, with the impulses between them.
struct SolidContactReport : ContactReport {
  ImpulseMatrix exchange;

  SolidContactReport() = default;
  explicit SolidContactReport(std::size_t bodies) : exchange(bodies) {}
  SolidContactReport& operator+=(const SolidContactReport& other) {
    ContactReport::operator+=(other);
    exchange.add(other.exchange);
    return *this;
  }
};

} // namespace spall
