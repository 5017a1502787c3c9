#include "macro/output/xdmf.h"

#include <cstdio>

namespace spall {
namespace {

/// Returns a name of the user's as XML holds it.
std::string escaped(const std::string& name) {
  std::string text;
  for (const char c : name)
    text += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  return text;
}

std::string size_of(const XdmfArray& array) {
  return std::to_string(array.rows) + (array.columns > 1 ? " " + std::to_string(array.columns) : "");
}

std::string item(const XdmfArray& array, const char* number) {
  return "<DataItem Dimensions=\"" + size_of(array) + "\" " + number + " Format=\"HDF\">" +
         escaped(array.place) + "</DataItem>";
}
std::string integers(const XdmfArray& array) { return item(array, "NumberType=\"Int\" Precision=\"8\""); }
std::string floats(const XdmfArray& array) { return item(array, "NumberType=\"Float\" Precision=\"4\""); }

std::string text_of(const XdmfGrid& grid) {
  std::string text = "<Grid Name=\"" + escaped(grid.name) + "\">\n<Topology TopologyType=\"" + grid.cell +
                     "\" NumberOfElements=\"" + std::to_string(grid.cells.rows) + "\" NodesPerElement=\"" +
                     std::to_string(grid.cells.columns) + "\">" + integers(grid.cells) + "</Topology>\n" +
                     "<Geometry GeometryType=\"XYZ\">" + floats(grid.points) + "</Geometry>\n";
  for (const XdmfArray& field : grid.fields)
    text += "<Attribute Name=\"" + field.name + "\" AttributeType=\"" +
            (field.columns == 3 ? "Vector" : "Scalar") +
            "\" Center=\"Node\"><Information Name=\"unit\" Value=\"" + field.unit + "\"/>" + floats(field) +
            "</Attribute>\n";
  return text + "</Grid>\n";
}

} // namespace

std::string xdmf_of(const std::vector<XdmfFrame>& frames) {
  std::string text = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\"><Domain>\n"
                     "<Grid Name=\"bodies\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::size_t f = 0; f < frames.size(); ++f) {
    char time[32];
    std::snprintf(time, sizeof time, "%.9g", frames[f].time);
    text += "<Grid Name=\"frame " + std::to_string(f) +
            "\" GridType=\"Collection\" CollectionType=\"Spatial\"><Time Value=\"" + time + "\"/>\n";
    for (const XdmfGrid& grid : frames[f].grids) text += text_of(grid);
    text += "</Grid>\n";
  }
  return text + "</Grid>\n</Domain></Xdmf>\n";
}

} // namespace spall
