#include "macro/shape/shape.h"

namespace spall {
namespace {

int steps(double length, double spacing) {
  return std::max(1, static_cast<int>(std::ceil(length / spacing)));
}

/// The outline divided into steps of at most the spacing, turned about the axis.
std::vector<Vec3> turned(const std::vector<ContourPoint>& outline, double spacing) {
  std::vector<Vec3> samples;
  const auto add_ring = [&](double z, double r) {
    const int around = r > 0 ? 4 * steps(0.5 * std::numbers::pi * r, spacing) : 1;
    for (int j = 0; j < around; ++j) {
      const double angle = 2 * std::numbers::pi * j / around;
      samples.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
  };
  for (std::size_t k = 0; k + 1 < outline.size(); ++k) {
    const ContourPoint a = outline[k], b = outline[k + 1];
    const int n = steps(std::hypot(b.z - a.z, b.r - a.r), spacing);
    for (int i = 0; i < n; ++i) add_ring(a.z + (b.z - a.z) * i / n, a.r + (b.r - a.r) * i / n);
  }
  if (!outline.empty()) add_ring(outline.back().z, outline.back().r);
  return samples;
}

std::vector<Vec3> samples_of(const Revolution& body, double spacing) {
  return turned(body.outer.outline(spacing), spacing);
}
std::vector<Vec3> samples_of(const Cylinder& body, double spacing) { return turned(body.outline(), spacing); }
std::vector<Vec3> samples_of(const Block& block, double spacing) {
  const Vec3 size = {block.width, block.depth, block.height};
  std::array<int, 3> n;
  for (int c = 0; c < 3; ++c) n[c] = steps(size[c], spacing);
  std::vector<Vec3> samples;
  for (int i = 0; i <= n[0]; ++i)
    for (int j = 0; j <= n[1]; ++j)
      for (int k = 0; k <= n[2]; ++k) {
        const bool on_surface = i == 0 || i == n[0] || j == 0 || j == n[1] || k == 0 || k == n[2];
        if (on_surface)
          samples.push_back(
              {size[0] * i / n[0] - 0.5 * size[0], size[1] * j / n[1] - 0.5 * size[1], size[2] * k / n[2]});
      }
  return samples;
}
std::vector<Vec3> samples_of(const PlaneWall&, double) { return {}; }
std::vector<Vec3> samples_of(const Nothing&, double) { return {}; }

} // namespace

std::vector<Vec3> surface_samples(const Shape& shape, double spacing) {
  return std::visit([&](const auto& s) { return samples_of(s, spacing); }, shape);
}

} // namespace spall
