#include "macro/points/ghosts.h"

namespace spall {

void Ghosts::rebuild(Points& points, const Vec3& reach, bool keep) {
  if (!keep) images.clear(), present.clear();
  present.resize(points.owned);
  for (int mask = 1; mask < 8; ++mask) {
    std::array<std::int8_t, 3> sign = {1, 1, 1};
    bool used = true;
    for (int c = 0; c < 3; ++c)
      if (mask >> c & 1) sign[c] = -1, used = used && planes.normal[c];
    if (!used) continue;
    for (std::size_t i = 0; i < points.owned; ++i) {
      bool near = true;
      for (int c = 0; c < 3; ++c) near = near && (sign[c] > 0 || points.position.component[c][i] < reach[c]);
      if (!near || present[i] >> mask & 1) continue;
      images.push_back({static_cast<std::uint32_t>(i), sign});
      present[i] |= static_cast<std::uint8_t>(1 << mask);
    }
  }
  for (VectorField* field : {&points.position, &points.velocity, &points.force})
    field->resize(points.owned + images.size());
  refresh(points);
}

void Ghosts::refresh(Points& points) const {
  for (int c = 0; c < 3; ++c) {
    double* x = points.position.component[c].data();
    double* v = points.velocity.component[c].data();
    for (std::size_t g = 0; g < images.size(); ++g) {
      x[points.owned + g] = images[g].sign[c] * x[images[g].owner];
      v[points.owned + g] = images[g].sign[c] * v[images[g].owner];
    }
  }
}

void Ghosts::add_back(Points& points) const {
  for (int c = 0; c < 3; ++c) {
    double* f = points.force.component[c].data();
    for (std::size_t g = 0; g < images.size(); ++g)
      f[images[g].owner] += images[g].sign[c] * f[points.owned + g];
  }
}

} // namespace spall
