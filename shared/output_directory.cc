#include "shared/output_directory.h"

#include "shared/error.h"

#include <unistd.h>

#include <fstream>

namespace spall {
namespace fs = std::filesystem;

void make_output_directory(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error || !fs::is_directory(directory))
    throw InputError("output folder '" + directory.string() + "' cannot be created: " + error.message());
  if (access(directory.c_str(), W_OK) != 0)
    throw InputError("output folder '" + directory.string() + "' cannot be written");
}

void write_atomically(const fs::path& file, const std::function<void(const fs::path&)>& writer) {
  fs::path temporary = file;
  temporary += ".part";
  try {
    writer(temporary);
    fs::rename(temporary, file);
  } catch (const std::exception& error) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw ComputationError("cannot write '" + file.string() + "': " + error.what());
  }
}

void write_atomically(const fs::path& file, const std::string& text) {
  write_atomically(file, [&text](const fs::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) throw std::runtime_error("disk full or not writable");
  });
}

} // namespace spall
