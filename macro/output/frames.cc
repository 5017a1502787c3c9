#include "macro/output/frames.h"

#include "shared/hdf5_file.h"
#include "shared/output_directory.h"

#include <cstdio>

namespace spall {
namespace {

std::vector<float> rows_of(const VectorField& field, std::size_t n) {
  std::vector<float> rows(3 * n);
  for (std::size_t i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) rows[3 * i + c] = static_cast<float>(field.component[c][i]);
  return rows;
}

std::string frame_group(std::size_t number) {
  char name[32];
  std::snprintf(name, sizeof name, "/frames/%03zu", number);
  return name;
}

} // namespace

Frames::Frames(const std::filesystem::path& directory, const Simulation& run, const std::string& scene,
               double thickness, const Provenance& provenance)
    : file(directory / "fields.h5"), xdmf(directory / "fields.xdmf") {
  Hdf5File out(file, Hdf5File::Mode::create);
  const SymmetryPlanes& planes = run.solids[0]->ghosts.symmetry();
  std::string names;
  for (int c = 0; c < 3; ++c)
    if (planes.normal[c]) names += std::string(names.empty() ? "" : " ") + "xyz"[c];
  out.set_attribute("/", "scene", scene);
  out.set_attribute("/", "units", std::string("SI"));
  out.set_attribute("/", "symmetry_planes", names);
  out.set_attribute("/", "thickness", thickness);
  out.set_attribute("/", "spacing", run.solids[0]->points.spacing.front());
  out.set_attribute("/", "program", provenance.program);
  out.set_attribute("/", "input_file", provenance.input_file);
  out.set_attribute("/", "created", provenance.created);
  out.set_attribute("/", "input", provenance.input);
  if (const Ogive* ogive = std::get_if<Ogive>(&run.body.shape)) {
    out.set_attribute("/", "projectile_radius", ogive->radius);
    out.set_attribute("/", "projectile_length", ogive->length);
    out.set_attribute("/", "projectile_nose_length", ogive->nose_length());
    out.set_attribute("/", "projectile_ogive_radius", ogive->ogive_radius);
  }
  for (const auto& solid : run.solids) {
    Block block{.name = solid->label,
                .prefix = blocks.empty() ? "" : solid->label + "/",
                .scalars = {"pressure", "volume_ratio"},
                .count = solid->points.owned};
    for (const std::string& name : solid->field_names()) block.scalars.push_back(name);
    if (!blocks.empty()) out.make_group("/" + block.name);
    out.write("/" + block.prefix + "initial_position", rows_of(solid->points.initial_position, block.count),
              3);
    out.write("/" + block.prefix + "volume",
              std::vector<float>(solid->points.volume.begin(), solid->points.volume.end()));
    blocks.push_back(std::move(block));
  }
}

void Frames::write(const Simulation& run) {
  {
    Hdf5File out(file, Hdf5File::Mode::append);
    const std::string frame = frame_group(times.size());
    out.make_group(frame);
    out.set_attribute(frame, "time", run.time);
    out.set_attribute(frame, "projectile_position", run.body.position[2]);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const Points& points = run.solids[b]->points;
      const std::size_t count = blocks[b].count;
      if (b > 0) out.make_group(frame + "/" + blocks[b].name);
      const std::string group = frame + "/" + blocks[b].prefix;
      out.write(group + "position", rows_of(points.position, count), 3);
      out.write(group + "velocity", rows_of(points.velocity, count), 3);
      std::vector<float> pressure(count), ratio(count);
      for (std::size_t i = 0; i < count; ++i) {
        pressure[i] = static_cast<float>(-trace(points.cauchy(i)) / 3);
        ratio[i] = static_cast<float>(determinant(points.deformation(i)));
      }
      out.write(group + "pressure", pressure);
      out.write(group + "volume_ratio", ratio);
      for (const std::string& name : run.solids[b]->field_names()) {
        const std::vector<double> values = run.solids[b]->field(name);
        out.write(group + name, std::vector<float>(values.begin(), values.end()));
      }
    }
  }
  times.push_back(run.time);
  write_xdmf();
}

void Frames::write_xdmf() const {
  const auto array = [](const std::string& size, const std::string& path) {
    return "<DataItem Dimensions=\"" + size +
           "\" NumberType=\"Float\" Precision=\"4\" Format=\"HDF\">fields.h5:" + path + "</DataItem>";
  };
  std::string text = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\"><Domain>\n"
                     "<Grid Name=\"points\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::size_t f = 0; f < times.size(); ++f) {
    char time[32];
    std::snprintf(time, sizeof time, "%.9g", times[f]);
    text += "<Grid Name=\"frame " + std::to_string(f) +
            "\" GridType=\"Collection\" CollectionType=\"Spatial\"><Time Value=\"" + time + "\"/>\n";
    for (const Block& block : blocks) {
      const std::string group = frame_group(f) + "/" + block.prefix, n = std::to_string(block.count);
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
  write_atomically(xdmf, text + "</Grid>\n</Domain></Xdmf>\n");
}

} // namespace spall
