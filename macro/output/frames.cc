#include "macro/output/frames.h"

#include "shared/error.h"
#include "shared/hdf5_file.h"
#include "shared/output_directory.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <numeric>
#include <type_traits>

namespace spall {
namespace {

/// Returns n values in single precision, the components of vectors one after the other.
template<class ValueOf> std::vector<float> floats(std::size_t n, const ValueOf& value_of) {
  std::vector<float> values;
  for (std::size_t i = 0; i < n; ++i)
    if constexpr (std::is_convertible_v<decltype(value_of(i)), double>)
      values.push_back(static_cast<float>(value_of(i)));
    else
      for (const double component : value_of(i)) values.push_back(static_cast<float>(component));
  return values;
}

/// Writes an array and its unit. Every rank has a share of its rows.
template<class T>
void put(Hdf5File& out, const std::string& path, const std::string& unit, const Share& share,
         const std::vector<T>& values, std::size_t columns = 1) {
  out.write_part(path, share, values, columns);
  out.set_attribute(path, "unit", unit);
}
/// Writes an array that all ranks have.
template<class T>
void put_whole(Hdf5File& out, const std::string& path, const std::string& unit, const Ranks& ranks,
               const std::vector<T>& values, std::size_t columns) {
  const std::vector<T> mine = ranks.first() ? values : std::vector<T>{};
  put(out, path, unit, ranks.share(mine.size() / columns), mine, columns);
}

std::string name_of_frame(std::size_t number) {
  char name[32];
  std::snprintf(name, sizeof name, "%03zu", number);
  return name;
}
std::string file_of_frame(std::size_t number) { return name_of_frame(number) + ".h5"; }

constexpr const char* folder_name = "fields";
constexpr const char* initial_file = "initial.h5";

/// Returns where fields.xdmf finds the arrays of a body.
std::string place_of(const std::string& file, const std::string& body) {
  return std::string(folder_name) + "/" + file + ":/" + body + "/";
}
/// Upper estimate of HDF5's overhead per array and its unit, bytes.
constexpr std::size_t overhead = 4096;

} // namespace

FrameDescription describe_frames(const Simulation& run, const std::string& main_body,
                                 const Provenance& provenance) {
  const Solid& solid = *run.bodies.solid(main_body);
  const SymmetryPlanes& planes = solid.ghosts.symmetry();
  std::string names;
  for (int c = 0; c < 3; ++c)
    if (planes.normal[c]) names += std::string(names.empty() ? "" : " ") + "xyz"[c];
  if (planes.axis) names = "axis";
  return {.words = {{"main_body", main_body},
                    {"units", "SI"},
                    {"symmetry_planes", names},
                    {"program", provenance.program},
                    {"input_file", provenance.input_file},
                    {"created", provenance.created},
                    {"input", provenance.input}},
          .numbers = {{"spacing", spacings_of(solid).first}}};
}

std::vector<Frames::Field> Frames::fields_of_motion() {
  return {{"position", "m", 3}, {"displacement", "m", 3}, {"velocity", "m/s", 3}};
}

std::vector<Frames::Field> Frames::fields_of(const Solid& solid, bool fragmented) {
  std::vector<Field> fields = fields_of_motion();
  for (const auto& [name, unit] :
       {std::pair("pressure", "Pa"), {"equivalent_stress", "Pa"}, {"volume_ratio", "1"}})
    fields.push_back({name, unit});
  const std::vector<std::string> names = solid.field_names(), units = solid.field_units();
  for (std::size_t k = 0; k < names.size(); ++k) fields.push_back({names[k], units[k]});
  if (fragmented) fields.push_back({"fragment", "1"});
  return fields;
}

Frames::Frames(const std::filesystem::path& directory_, const Simulation& run, FrameDescription description_,
               const std::vector<std::string>& fragmented, const FragmentInputs& fragments_, bool go_on)
    : directory(directory_), folder(directory / folder_name), ranks(run.ranks()),
      description(std::move(description_)), fragments(fragments_) {
  for (const auto& solid : run.bodies.solids) {
    const bool pieces = std::find(fragmented.begin(), fragmented.end(), solid->label) != fragmented.end();
    clouds.push_back({solid->label, fields_of(*solid, pieces), pieces});
  }
  for (std::size_t b = 0; b < run.bodies.rigids.size(); ++b) {
    const RigidBody& body = run.bodies.rigids[b];
    Triangles triangles = triangles_of(body.shape);
    if (triangles.points.empty()) continue;
    std::vector<Vec3> start;
    for (const Vec3& x : triangles.points) start.push_back(body.in_space(x));
    surfaces.push_back({b, body.name, std::move(triangles), std::move(start)});
  }
  for (const Reinforcement& bars : run.bodies.reinforcements)
    reinforcements.push_back({bars.name, bars.bars().segments().size()});
  find_shares(run);
  if (go_on) return;
  ranks.on_first([this] {
    make_output_directory(folder);
    remove_from(0);
  });
  write_initial(run);
}

void Frames::find_shares(const Simulation& run) {
  for (std::size_t b = 0; b < clouds.size(); ++b)
    clouds[b].share = ranks.share(run.bodies.solids[b]->points.owned);
}

void Frames::write_initial(const Simulation& run) const {
  std::size_t bytes = 4 * overhead * (clouds.size() + surfaces.size()) + 28 * run.point_count();
  for (const Surface& surface : surfaces) bytes += 32 * surface.triangles.corners.size();
  for (const Bars& bars : reinforcements) bytes += overhead + 16 * bars.segments;
  write_hdf5_atomically(
      folder / initial_file, bytes,
      [&](Hdf5File& out) {
        for (std::size_t b = 0; b < clouds.size(); ++b)
          write_initial(out, clouds[b], run.bodies.solids[b]->points);
        for (const Surface& surface : surfaces)
          write_initial(out, surface, outline(run.bodies.rigids[surface.body].shape));
        for (const Bars& bars : reinforcements) {
          std::vector<std::int64_t> ends(2 * bars.segments);
          std::iota(ends.begin(), ends.end(), std::int64_t{0});
          put_whole(out, "/" + bars.name + "/segments", "1", ranks, ends, 2);
        }
      },
      ranks);
}

void Frames::write_initial(Hdf5File& out, const Cloud& cloud, const Points& points) const {
  const std::string group = "/" + cloud.name + "/";
  const auto at_points = [&](const auto& value_of) { return floats(points.owned, value_of); };
  put(out, group + "initial_position", "m", cloud.share,
      at_points([&](std::size_t i) { return points.initial_position[i]; }), 3);
  put(out, group + "volume", "m3", cloud.share, at_points([&](std::size_t i) { return points.volume[i]; }));
  put(out, group + "spacing", "m", cloud.share, at_points([&](std::size_t i) { return points.spacing[i]; }));
  std::vector<std::int64_t> numbers(points.owned);
  std::iota(numbers.begin(), numbers.end(), static_cast<std::int64_t>(cloud.share.first));
  put(out, group + "vertices", "1", cloud.share, numbers);
}

void Frames::write_initial(Hdf5File& out, const Surface& surface,
                           const std::vector<ContourPoint>& contour) const {
  const std::string group = "/" + surface.name + "/";
  put_whole(out, group + "outline", "m", ranks,
            floats(contour.size(),
                   [&](std::size_t i) {
                     return std::array{contour[i].z, contour[i].r};
                   }),
            2);
  std::vector<std::int64_t> corners;
  for (const auto& triangle : surface.triangles.corners)
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  put_whole(out, group + "triangles", "1", ranks, corners, 3);
}

void Frames::transfer(Archive& archive) {
  archive("frame_times", times);
  if (!archive.loading()) return;
  ranks.on_first([this] {
    for (std::size_t f = 0; f < times.size(); ++f)
      if (!std::filesystem::exists(folder / file_of_frame(f)))
        throw InputError((folder / file_of_frame(f)).string() + " is gone");
  });
}

void Frames::go_on() const {
  ranks.on_first([this] {
    remove_from(times.size());
    write_index();
  });
}

void Frames::remove_from(std::size_t n) const {
  while (std::filesystem::remove(folder / file_of_frame(n))) ++n;
}

void Frames::write(const Simulation& run) {
  if (!times.empty() && times.back() == run.time) return; // the end of a run may be the time of a frame
  find_shares(run);                                       // points may have moved to other ranks
  std::size_t bytes = overhead;
  for (const Cloud& cloud : clouds)
    for (const Field& field : cloud.fields) bytes += overhead + 4 * field.columns * cloud.share.all;
  for (const Surface& surface : surfaces) bytes += 3 * (overhead + 12 * surface.start.size());
  for (const Bars& bars : reinforcements) bytes += 7 * overhead + 2 * 4 * 13 * bars.segments;
  write_hdf5_atomically(
      folder / file_of_frame(times.size()), bytes,
      [&](Hdf5File& out) {
        out.set_attribute("/", "time", run.time);
        for (const RigidBody& body : run.bodies.rigids) {
          const Quaternion& q = body.orientation;
          for (int c = 0; c < 3; ++c) out.set_attribute("/", body.name + "_" + "xyz"[c], body.position[c]);
          for (const auto& [axis, value] : {std::pair("w", q.w), {"x", q.x}, {"y", q.y}, {"z", q.z}})
            out.set_attribute("/", body.name + "_q" + axis, value);
        }
        for (std::size_t b = 0; b < clouds.size(); ++b)
          for (const Field& field : clouds[b].fields)
            put(out, "/" + clouds[b].name + "/" + field.name, field.unit, clouds[b].share,
                values_of(*run.bodies.solids[b], field.name), field.columns);
        for (const Surface& surface : surfaces) write_surface(out, surface, run.bodies.rigids[surface.body]);
        for (const Reinforcement& bars : run.bodies.reinforcements) write_bars(out, bars);
      },
      ranks);
  times.push_back(run.time);
  ranks.on_first([this] { write_index(); });
}

std::vector<float> Frames::values_of(const Solid& solid, const std::string& field) const {
  const Points& points = solid.points;
  const auto at_points = [&](const auto& value_of) { return floats(points.owned, value_of); };
  if (field == "position") return at_points([&](std::size_t i) { return points.position[i]; });
  if (field == "displacement")
    return at_points([&](std::size_t i) { return points.position[i] - points.initial_position[i]; });
  if (field == "velocity") return at_points([&](std::size_t i) { return points.velocity[i]; });
  if (field == "pressure") return at_points([&](std::size_t i) { return -trace(points.cauchy(i)) / 3; });
  if (field == "equivalent_stress")
    return at_points([&](std::size_t i) { return equivalent_stress(deviator(points.cauchy(i))); });
  if (field == "volume_ratio")
    return at_points([&](std::size_t i) { return determinant(points.deformation(i)); });
  if (field == "fragment") { // the destination of the fragments is not needed here
    const std::vector<std::uint32_t> of_point = find_fragments(solid, fragments, 0, 0).of_point;
    return at_points([&](std::size_t i) { return of_point[i]; });
  }
  const std::vector<double> history = solid.field(field);
  return at_points([&](std::size_t i) { return history[i]; });
}

void Frames::write_surface(Hdf5File& out, const Surface& surface, const RigidBody& body) const {
  const std::vector<Vec3>& points = surface.triangles.points;
  const auto at_points = [&](const auto& value_of) {
    return floats(points.size(), [&](std::size_t i) { return value_of(i, body.in_space(points[i])); });
  };
  const std::vector<float> values[] = {
      at_points([](std::size_t, const Vec3& x) { return x; }),
      at_points([&](std::size_t i, const Vec3& x) { return x - surface.start[i]; }),
      at_points([&](std::size_t, const Vec3& x) { return body.velocity_at(x); })};
  const std::vector<Field> fields = fields_of_motion();
  for (std::size_t k = 0; k < fields.size(); ++k)
    put_whole(out, "/" + surface.name + "/" + fields[k].name, fields[k].unit, ranks, values[k], 3);
}

std::vector<Frames::Field> Frames::fields_of_bars() {
  std::vector<Field> fields = fields_of_motion();
  for (const auto& [name, unit] :
       {std::pair("axial_stress", "Pa"), {"plastic_strain", "1"}, {"ruptured", "1"}, {"slip", "m"}})
    fields.push_back({name, unit});
  return fields;
}

void Frames::write_bars(Hdf5File& out, const Reinforcement& bars) const {
  const std::vector<BarChain::Segment>& segments = bars.bars().segments();
  const Points& nodes = bars.nodes();
  // The n-th point is an end of segment n / 2.
  const auto at_ends = [&](const auto& value_of) {
    return floats(2 * segments.size(), [&](std::size_t n) {
      const BarChain::Segment& segment = segments[n / 2];
      return value_of(segment, n % 2 == 0 ? segment.a : segment.b);
    });
  };
  using Segment = BarChain::Segment;
  const std::vector<float> values[] = {
      at_ends([&](const Segment&, std::uint32_t i) { return nodes.position[i]; }),
      at_ends([&](const Segment&, std::uint32_t i) { return nodes.position[i] - nodes.initial_position[i]; }),
      at_ends([&](const Segment&, std::uint32_t i) { return nodes.velocity[i]; }),
      at_ends([](const Segment& s, std::uint32_t) { return s.steel.stress; }),
      at_ends([](const Segment& s, std::uint32_t) { return s.steel.accumulated; }),
      at_ends([&](const Segment& s, std::uint32_t) { return bars.bars().ruptured(s) ? 1.0 : 0.0; }),
      at_ends([&](const Segment&, std::uint32_t i) { return bars.bonds()[i].slip; })};
  const std::vector<Field> fields = fields_of_bars();
  for (std::size_t k = 0; k < fields.size(); ++k)
    put_whole(out, "/" + bars.name + "/" + fields[k].name, fields[k].unit, ranks, values[k],
              fields[k].columns);
}

void Frames::write_index() const {
  const std::string here = std::string(folder_name) + "/";
  write_hdf5_atomically(directory / "fields.h5", overhead * (times.size() + 16), [&](Hdf5File& out) {
    for (const auto& [name, value] : description.words) out.set_attribute("/", name, value);
    for (const auto& [name, value] : description.numbers) out.set_attribute("/", name, value);
    const auto link = [&](const std::string& body, const char* array) {
      out.link("/" + body + "/" + array, here + initial_file, "/" + body + "/" + array);
    };
    for (const Cloud& cloud : clouds)
      for (const char* array : {"initial_position", "volume", "spacing"}) link(cloud.name, array);
    for (const Surface& surface : surfaces)
      for (const char* array : {"outline", "triangles"}) link(surface.name, array);
    for (const Bars& bars : reinforcements) link(bars.name, "segments");
    for (std::size_t f = 0; f < times.size(); ++f)
      out.link("/frames/" + name_of_frame(f), here + file_of_frame(f), "/");
  });
  std::vector<XdmfFrame> frames;
  for (std::size_t f = 0; f < times.size(); ++f) {
    XdmfFrame& frame = frames.emplace_back(XdmfFrame{times[f], {}});
    for (const Cloud& cloud : clouds) frame.grids.push_back(grid_of(cloud, f));
    for (const Surface& surface : surfaces) frame.grids.push_back(grid_of(surface, f));
    for (const Bars& bars : reinforcements) frame.grids.push_back(grid_of(bars, f));
  }
  write_atomically(directory / "fields.xdmf", xdmf_of(frames));
}

XdmfGrid Frames::grid_of(const Cloud& cloud, std::size_t frame) const {
  const std::size_t n = cloud.share.all;
  XdmfGrid grid = grid_of(cloud.name, cloud.fields, n, frame);
  const std::string group = place_of(initial_file, cloud.name);
  grid.cell = "Polyvertex";
  grid.cells = {"vertices", "1", group + "vertices", n, 1};
  grid.fields.push_back({"volume", "m3", group + "volume", n, 1});
  grid.fields.push_back({"spacing", "m", group + "spacing", n, 1});
  return grid;
}

XdmfGrid Frames::grid_of(const Surface& surface, std::size_t frame) const {
  const Triangles& triangles = surface.triangles;
  XdmfGrid grid = grid_of(surface.name, fields_of_motion(), triangles.points.size(), frame);
  grid.cell = "Triangle";
  grid.cells = {"triangles", "1", place_of(initial_file, surface.name) + "triangles",
                triangles.corners.size(), 3};
  return grid;
}

XdmfGrid Frames::grid_of(const Bars& bars, std::size_t frame) {
  XdmfGrid grid = grid_of(bars.name, fields_of_bars(), 2 * bars.segments, frame);
  grid.cell = "Polyline";
  grid.cells = {"segments", "1", place_of(initial_file, bars.name) + "segments", bars.segments, 2};
  return grid;
}

XdmfGrid Frames::grid_of(const std::string& body, const std::vector<Field>& fields, std::size_t points,
                         std::size_t frame) {
  XdmfGrid grid{.name = body, .cells = {}, .points = {}, .fields = {}};
  for (const Field& field : fields) {
    const XdmfArray array{field.name, field.unit, place_of(file_of_frame(frame), body) + field.name, points,
                          field.columns};
    if (field.name == "position")
      grid.points = array;
    else
      grid.fields.push_back(array);
  }
  return grid;
}

} // namespace spall
