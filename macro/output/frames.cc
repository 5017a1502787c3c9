#include "macro/output/frames.h"

#include "shared/error.h"
#include "shared/hdf5_file.h"
#include "shared/output_directory.h"

#include <algorithm>
#include <cstdio>

namespace spall {
namespace {

std::vector<float> rows_of(const VectorField& field, std::size_t n) {
  std::vector<float> rows(3 * n);
  for (std::size_t i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) rows[3 * i + c] = static_cast<float>(field.component[c][i]);
  return rows;
}

template<class T> std::vector<float> floats(const std::vector<T>& values) {
  return {values.begin(), values.end()};
}

std::string name_of_frame(std::size_t number) {
  char name[32];
  std::snprintf(name, sizeof name, "%03zu", number);
  return name;
}
std::string file_of_frame(std::size_t number) { return name_of_frame(number) + ".h5"; }

constexpr const char* folder_name = "fields";
constexpr const char* initial_file = "initial.h5";

/// Upper estimate of HDF5's overhead per array, bytes.
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
          .numbers = {{"spacing", spacings_of(solid).first}},
          .outlines = {}};
}

Frames::Frames(const std::filesystem::path& directory_, const Simulation& run, FrameDescription description_,
               const std::vector<std::string>& fragmented, const FragmentInputs& fragments_, bool go_on)
    : directory(directory_), folder(directory / folder_name), ranks(run.ranks()),
      description(std::move(description_)), fragments(fragments_) {
  for (const auto& solid : run.bodies.solids) {
    Block block{.name = solid->label, .scalars = {"pressure", "volume_ratio"}};
    for (const std::string& name : solid->field_names()) block.scalars.push_back(name);
    block.fragmented = std::find(fragmented.begin(), fragmented.end(), solid->label) != fragmented.end();
    if (block.fragmented) block.scalars.push_back("fragment");
    blocks.push_back(std::move(block));
  }
  find_shares(run);
  if (go_on) return;
  ranks.on_first([this] {
    make_output_directory(folder);
    remove_from(0);
  });
  write_initial(run);
}

void Frames::find_shares(const Simulation& run) {
  for (std::size_t b = 0; b < blocks.size(); ++b)
    blocks[b].share = ranks.share(run.bodies.solids[b]->points.owned);
}

void Frames::write_initial(const Simulation& run) const {
  write_hdf5_atomically(
      folder / initial_file, overhead + 16 * run.point_count(),
      [&](Hdf5File& out) {
        for (std::size_t b = 0; b < blocks.size(); ++b) {
          const Points& points = run.bodies.solids[b]->points;
          const std::string group = "/" + blocks[b].name + "/";
          out.write_part(group + "initial_position", blocks[b].share,
                         rows_of(points.initial_position, points.owned), 3);
          out.write_part(group + "volume", blocks[b].share, floats(points.volume));
        }
      },
      ranks);
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
  std::size_t bytes = 0;
  for (const Block& block : blocks)
    bytes += (block.scalars.size() + 2) * overhead + block.share.all * 4 * (block.scalars.size() + 6);
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
        for (std::size_t b = 0; b < blocks.size(); ++b) write_block(out, blocks[b], *run.bodies.solids[b]);
      },
      ranks);
  times.push_back(run.time);
  ranks.on_first([this] { write_index(); });
}

void Frames::write_block(Hdf5File& out, const Block& block, const Solid& solid) const {
  const Points& points = solid.points;
  const std::string group = "/" + block.name + "/";
  out.write_part(group + "position", block.share, rows_of(points.position, points.owned), 3);
  out.write_part(group + "velocity", block.share, rows_of(points.velocity, points.owned), 3);
  std::vector<float> pressure(points.owned), ratio(points.owned);
  for (std::size_t i = 0; i < points.owned; ++i) {
    pressure[i] = static_cast<float>(-trace(points.cauchy(i)) / 3);
    ratio[i] = static_cast<float>(determinant(points.deformation(i)));
  }
  out.write_part(group + "pressure", block.share, pressure);
  out.write_part(group + "volume_ratio", block.share, ratio);
  for (const std::string& name : solid.field_names())
    out.write_part(group + name, block.share, floats(solid.field(name)));
  if (block.fragmented) // the destination of the fragments is not needed here
    out.write_part(group + "fragment", block.share, floats(find_fragments(solid, fragments, 0, 0).of_point));
}

void Frames::write_index() const {
  const std::string here = std::string(folder_name) + "/";
  write_hdf5_atomically(directory / "fields.h5", overhead * (times.size() + 16), [&](Hdf5File& out) {
    for (const auto& [name, value] : description.words) out.set_attribute("/", name, value);
    for (const auto& [name, value] : description.numbers) out.set_attribute("/", name, value);
    for (const Block& block : blocks)
      for (const char* array : {"initial_position", "volume"})
        out.link("/" + block.name + "/" + array, here + initial_file, "/" + block.name + "/" + array);
    for (const auto& [body, outline] : description.outlines) out.write("/" + body + "/outline", outline, 2);
    for (std::size_t f = 0; f < times.size(); ++f)
      out.link("/frames/" + name_of_frame(f), here + file_of_frame(f), "/");
  });
  write_xdmf();
}

void Frames::write_xdmf() const {
  const auto array = [](const std::string& size, const std::string& path) {
    return "<DataItem Dimensions=\"" + size + "\" NumberType=\"Float\" Precision=\"4\" Format=\"HDF\">" +
           path + "</DataItem>";
  };
  std::string text = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\"><Domain>\n"
                     "<Grid Name=\"points\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::size_t f = 0; f < times.size(); ++f) {
    char time[32];
    std::snprintf(time, sizeof time, "%.9g", times[f]);
    text += "<Grid Name=\"frame " + std::to_string(f) +
            "\" GridType=\"Collection\" CollectionType=\"Spatial\"><Time Value=\"" + time + "\"/>\n";
    for (const Block& block : blocks) {
      const std::string group = std::string(folder_name) + "/" + file_of_frame(f) + ":/" + block.name + "/",
                        n = std::to_string(block.share.all);
      text += "<Grid Name=\"" + block.name + "\">\n";
      text += "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"" + n + "\"/>\n";
      text += "<Geometry GeometryType=\"XYZ\">" + array(n + " 3", group + "position") + "</Geometry>\n";
      text += "<Attribute Name=\"velocity\" AttributeType=\"Vector\" Center=\"Node\">" +
              array(n + " 3", group + "velocity") + "</Attribute>\n";
      for (const std::string& name : block.scalars)
        text += "<Attribute Name=\"" + name + "\" AttributeType=\"Scalar\" Center=\"Node\">" +
                array(n, group + name) + "</Attribute>\n";
      text += "</Grid>\n";
    }
    text += "</Grid>\n";
  }
  write_atomically(directory / "fields.xdmf", text + "</Grid>\n</Domain></Xdmf>\n");
}

} // namespace spall
