#pragma once

#include "shared/hdf5_file.h"

#include <filesystem>
#include <string>
#include <vector>

namespace spall::test {

/// The fields of a run: paths are those of `fields.h5`, whose links lead to the files of the folder `fields`.
/// The programs follow no links, so they are resolved here.
class Fields {
public:
  /// @param folder of the results
  explicit Fields(std::filesystem::path folder_) : folder(std::move(folder_)), index(opened("fields.h5")) {}

  template<class T> std::vector<T> read(const std::string& path, std::size_t columns = 1) const {
    const auto [file, object] = place_of(path);
    return opened(file).template read<T>(object, columns);
  }
  double real_attribute(const std::string& path, const std::string& name) const {
    const auto [file, object] = place_of(path);
    return opened(file).real_attribute(object, name);
  }
  std::string text_attribute(const std::string& path, const std::string& name) const {
    const auto [file, object] = place_of(path);
    return opened(file).text_attribute(object, name);
  }
  std::vector<std::string> list(const std::string& group) const {
    if (!group.starts_with(frames)) return index.list(group);
    const auto [file, object] = place_of(group);
    return opened(file).list(object);
  }
  bool exists(const std::string& path) const {
    const auto [file, object] = place_of(path);
    return std::filesystem::exists(folder / file) && opened(file).exists(object);
  }

private:
  static inline const std::string frames = "/frames/";

  Hdf5File opened(const std::string& file) const { return {folder / file, Hdf5File::Mode::read}; }

  /// File and object of a path.
  std::pair<std::string, std::string> place_of(const std::string& path) const {
    if (path == "/") return {"fields.h5", path};
    if (!path.starts_with(frames)) return {"fields/initial.h5", path};
    const std::size_t end = std::min(path.find('/', frames.size()), path.size());
    const std::string object = path.substr(end);
    return {"fields/" + path.substr(frames.size(), end - frames.size()) + ".h5",
            object.empty() ? "/" : object};
  }

  std::filesystem::path folder;
  Hdf5File index;
};

} // namespace spall::test
