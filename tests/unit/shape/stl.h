#pragma once

#include "macro/shape/triangles.h"
#include "shared/error.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>

namespace spall::test {

/// A closed surface of triangles: an outline turned about z in `around` steps. Its corners lie on the body.
inline Triangles turned_surface(const std::vector<ContourPoint>& outline, int around) {
  Triangles surface;
  std::vector<std::int64_t> first;
  for (const ContourPoint& at : outline) {
    first.push_back(static_cast<std::int64_t>(surface.points.size()));
    for (int k = 0; k < (at.r > 0 ? around : 1); ++k) {
      const double angle = 2 * std::numbers::pi * k / around;
      surface.points.push_back({at.r * std::cos(angle), at.r * std::sin(angle), at.z});
    }
  }
  for (std::size_t i = 0; i + 1 < outline.size(); ++i)
    for (int k = 0; k < around; ++k) {
      const auto at = [&](std::size_t ring, int n) {
        return outline[ring].r > 0 ? first[ring] + n % around : first[ring];
      };
      if (outline[i + 1].r > 0) surface.corners.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      if (outline[i].r > 0) surface.corners.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  return surface;
}

/// Writes triangles as an STL file whose number 1 stands for `unit` (m): text, or binary with its single
/// precision.
inline void write_stl(const std::filesystem::path& file, const Triangles& surface, double unit,
                      bool binary = false) {
  std::ofstream out(file, std::ios::binary);
  out.precision(17);
  if (!binary) out << "solid body\n";
  if (binary) {
    const std::string header(80, ' ');
    const auto count = static_cast<std::uint32_t>(surface.corners.size());
    out.write(header.data(), 80).write(reinterpret_cast<const char*>(&count), 4);
  }
  for (std::size_t f = 0; f < surface.corners.size(); ++f) {
    std::array<float, 12> numbers{}; // the normal, which nobody reads, and the corners
    if (!binary) out << "facet normal 0 0 0\nouter loop\n";
    for (int k = 0; k < 3; ++k) {
      const Vec3 x = 1 / unit * surface.triangle(f)[k];
      if (!binary) out << "vertex " << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
      for (int c = 0; c < 3; ++c) numbers[3 + 3 * k + c] = static_cast<float>(x[c]);
    }
    if (!binary) out << "endloop\nendfacet\n";
    if (binary) out.write(reinterpret_cast<const char*>(numbers.data()), 48).write("\0\0", 2);
  }
  if (!binary) out << "endsolid body\n";
}

} // namespace spall::test
