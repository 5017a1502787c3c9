#include "macro/output/checkpoint.h"

#include "shared/error.h"
#include "shared/hdf5_file.h"
#include "shared/output_directory.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <sstream>

namespace spall {
namespace fs = std::filesystem;
namespace {

/// Raised whenever a `transfer` or the layout of the file changes.
constexpr int format_version = 3;
const char* const format_name = "spall penetrate checkpoint";

/// Small parts of a stream are moved together, so many bytes at a time.
constexpr std::size_t buffer_size = 1 << 20;

/// HDF5's own needs per stream and for the file, generously, bytes.
constexpr std::size_t overhead = 4096;

std::string group_of(int rank) { return "/state/" + std::to_string(rank); }

/// FNV-1a (Fowler, Noll and Vo), 64 bits: finds damaged bytes, no forgery.
class Checksum {
public:
  void add(const void* data, std::size_t count) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < count; ++i) value = (value ^ bytes[i]) * 0x100000001b3;
  }
  std::string text() const {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(value));
    return digits;
  }

private:
  std::uint64_t value = 0xcbf29ce484222325;
};

/// Bytes of each stream, by name. All archives here keep the lengths of arrays in a stream of their own.
class Counter final : public Archive {
public:
  bool loading() const override { return false; }
  std::map<std::string, std::size_t> streams;

protected:
  void item(const char* name, void*, std::size_t count) override { streams[name] += count; }
  void array(const char* name, Sequence& values) override {
    streams["lengths"] += sizeof(std::uint64_t);
    streams[name] += values.bytes();
  }
};

class Saver final : public Archive {
public:
  /// @param group of the file that the streams go to
  Saver(Hdf5File& file_, const std::string& group_, const std::map<std::string, std::size_t>& sizes)
      : file(file_), group(group_) {
    for (const auto& [name, size] : sizes) file.allocate_bytes(path_of(name), size);
  }
  bool loading() const override { return false; }
  /// Call after the last part.
  void finish() {
    for (auto& [name, stream] : streams) {
      flush(name, stream);
      file.set_attribute(path_of(name), "checksum", stream.checksum.text());
    }
  }

protected:
  void item(const char* name, void* value, std::size_t count) override { put(name, value, count); }
  void array(const char* name, Sequence& values) override {
    const std::uint64_t length = values.count();
    put("lengths", &length, sizeof length);
    put(name, values.data(), values.bytes());
  }

private:
  struct Stream {
    std::size_t written = 0;
    std::vector<std::byte> buffer;
    Checksum checksum;
  };
  void put(const std::string& name, const void* data, std::size_t count) {
    Stream& stream = streams[name];
    stream.checksum.add(data, count);
    if (stream.buffer.size() + count > buffer_size) flush(name, stream);
    const auto* bytes = static_cast<const std::byte*>(data);
    if (count < buffer_size)
      stream.buffer.insert(stream.buffer.end(), bytes, bytes + count);
    else
      write(name, stream, data, count);
  }
  void flush(const std::string& name, Stream& stream) {
    if (!stream.buffer.empty()) write(name, stream, stream.buffer.data(), stream.buffer.size());
    stream.buffer.clear();
  }
  void write(const std::string& name, Stream& stream, const void* data, std::size_t count) {
    file.write_bytes(path_of(name), stream.written, data, count);
    stream.written += count;
  }

  std::string path_of(const std::string& name) const { return group + "/" + name; }

  Hdf5File& file;
  std::string group;
  std::map<std::string, Stream> streams;
};

class Loader final : public Archive {
public:
  Loader(const Hdf5File& file_, const std::string& group_) : file(file_), group(group_) {
    for (const std::string& name : file.list(group)) streams[name].left = file.count_bytes(path_of(name));
  }
  bool loading() const override { return true; }
  /// Call after the last part. @throws std::runtime_error if something is left.
  void finish() const {
    for (const auto& [name, stream] : streams)
      if (stream.left + stream.buffer.size() - stream.next > 0) refuse(name);
  }

protected:
  void item(const char* name, void* value, std::size_t count) override { get(name, value, count); }
  void array(const char* name, Sequence& values) override {
    std::uint64_t length = 0;
    get("lengths", &length, sizeof length);
    const Stream& stream = streams[name];
    if (length > (stream.left + stream.buffer.size() - stream.next) / values.item_bytes) refuse(name);
    values.resize(length);
    get(name, values.data(), values.bytes());
  }

private:
  struct Stream {
    std::size_t read = 0, left = 0; ///< of the array in the file
    std::vector<std::byte> buffer;
    std::size_t next = 0; ///< in the buffer
  };
  void get(const std::string& name, void* data, std::size_t count) {
    Stream& stream = streams[name];
    auto* bytes = static_cast<std::byte*>(data);
    while (count > 0) {
      if (stream.next == stream.buffer.size()) fill(name, stream);
      const std::size_t part = std::min(count, stream.buffer.size() - stream.next);
      std::copy_n(stream.buffer.begin() + static_cast<std::ptrdiff_t>(stream.next), part, bytes);
      stream.next += part, bytes += part, count -= part;
    }
  }
  void fill(const std::string& name, Stream& stream) {
    if (stream.left == 0) refuse(name);
    stream.buffer.resize(std::min(buffer_size, stream.left));
    file.read_bytes(path_of(name), stream.read, stream.buffer.data(), stream.buffer.size());
    stream.read += stream.buffer.size(), stream.left -= stream.buffer.size();
    stream.next = 0;
  }
  [[noreturn]] static void refuse(const std::string& name) {
    throw std::runtime_error("'" + name + "' does not fit this program and input");
  }

  std::string path_of(const std::string& name) const { return group + "/" + name; }

  const Hdf5File& file;
  std::string group;
  std::map<std::string, Stream> streams;
};

/// True if all streams of a group are as they were written.
bool is_sound(const Hdf5File& file, const std::string& group) {
  std::vector<std::byte> buffer;
  for (const std::string& name : file.list(group)) {
    const std::string path = group + "/" + name;
    const std::size_t size = file.count_bytes(path);
    Checksum checksum;
    for (std::size_t first = 0; first < size; first += buffer.size()) {
      buffer.resize(std::min(buffer_size, size - first));
      file.read_bytes(path, first, buffer.data(), buffer.size());
      checksum.add(buffer.data(), buffer.size());
    }
    if (checksum.text() != file.text_attribute(path, "checksum")) return false;
  }
  return true;
}

/// First line in which two texts differ, as it is in `ours`.
std::string first_difference(const std::string& ours, const std::string& theirs) {
  std::istringstream a(ours), b(theirs);
  std::string line, other;
  while (std::getline(a, line))
    if (!std::getline(b, other) || line != other) break;
  return line.substr(std::min(line.size(), line.find_first_not_of(' ')));
}

/// Waits until the disk has the file: a machine that loses its power keeps what was renamed.
void sync(const fs::path& file) {
  const int handle = open(file.c_str(), O_RDONLY);
  if (handle < 0) return;
  fsync(handle);
  close(handle);
}

} // namespace

std::string deciding_input(const std::string& resolved) {
  std::istringstream stream(resolved);
  std::string line, text, section;
  while (std::getline(stream, line)) {
    if (line.starts_with("subsection ")) section = line.substr(11);
    const bool end_time = section == "Time" && line.find("set End time ") != std::string::npos;
    if (section != "Output" && section != "Run" && !end_time) text += line + "\n";
  }
  return text;
}

Checkpoints::Checkpoints(fs::path directory, Provenance provenance_, const Ranks& ranks_)
    : newest(directory / "checkpoint.h5"), previous(directory / "checkpoint_previous.h5"),
      provenance(std::move(provenance_)), ranks(ranks_) {}

void Checkpoints::write(const std::function<void(Archive&)>& transfer) const {
  Counter counter;
  transfer(counter);
  double bytes = static_cast<double>(overhead * (counter.streams.size() + 1));
  for (const auto& [name, size] : counter.streams) bytes += static_cast<double>(size);
  bytes = ranks.sum(bytes);
  const fs::path part = newest.string() + ".part";
  try {
    ranks.on_first([&] { begin(part, bytes); });
    for (int turn = 0; turn < ranks.count(); ++turn)
      ranks.on_one(turn, [&] {
        Hdf5File file(part, Hdf5File::Mode::append);
        Saver saver(file, group_of(turn), counter.streams);
        transfer(saver);
        saver.finish();
        file.close();
      });
    ranks.on_first([&] { finish(part); });
  } catch (const std::exception& error) {
    std::error_code ignored;
    if (ranks.first()) fs::remove(part, ignored);
    throw ComputationError("cannot write '" + newest.string() + "': " + error.what());
  }
}

void Checkpoints::begin(const fs::path& part, double bytes) const {
  check_room(part, static_cast<std::size_t>(bytes) + overhead + provenance.input.size());
  Hdf5File file(part, Hdf5File::Mode::create);
  file.set_attribute("/", "format", std::string(format_name));
  file.set_attribute("/", "format_version", format_version);
  file.set_attribute("/", "ranks", ranks.count());
  file.set_attribute("/", "program", provenance.program);
  file.set_attribute("/", "input_file", provenance.input_file);
  file.set_attribute("/", "created", provenance.created);
  file.set_attribute("/", "input", provenance.input);
  file.close();
}

void Checkpoints::finish(const fs::path& part) const {
  sync(part);
  if (fs::exists(newest)) {
    fs::remove(previous);
    std::error_code no_links;
    fs::create_hard_link(newest, previous, no_links);
    if (no_links) fs::rename(newest, previous);
  }
  fs::rename(part, newest);
}

std::string Checkpoints::fault(const fs::path& path) const {
  try {
    const Hdf5File file(path, Hdf5File::Mode::read);
    if (file.text_attribute("/", "format") != format_name) return path.string() + ": is no checkpoint";
    const int version = file.integer_attribute("/", "format_version");
    if (version != format_version)
      return path.string() + ": has format version " + std::to_string(version) + ", this program reads " +
             std::to_string(format_version);
    const std::string ours = deciding_input(provenance.input),
                      theirs = deciding_input(file.text_attribute("/", "input"));
    if (ours != theirs)
      return path.string() + ": belongs to another input, which has no '" + first_difference(ours, theirs) +
             "'";
    if (const int writers = file.integer_attribute("/", "ranks"); writers != ranks.count())
      return path.string() + ": was written by " + std::to_string(writers) + " ranks, not " +
             std::to_string(ranks.count());
    for (int rank = 0; rank < ranks.count(); ++rank)
      if (!is_sound(file, group_of(rank))) return path.string() + ": is damaged, a checksum is wrong";
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

bool Checkpoints::find() {
  std::vector<std::string> found;
  ranks.on_first([&] {
    if (find_on_first()) found = {chosen.string()};
  });
  found = ranks.gather(found);
  if (!found.empty()) chosen = found.front();
  return !found.empty();
}

bool Checkpoints::find_on_first() {
  std::string faults;
  for (const fs::path& file : {newest, previous}) {
    if (!fs::exists(file)) continue;
    const std::string wrong = fault(file);
    if (wrong.empty()) {
      chosen = file;
      if (!faults.empty()) std::fprintf(stderr, "refused: %s\n", faults.c_str());
      return true;
    }
    faults += (faults.empty() ? "" : "; ") + wrong;
  }
  if (!faults.empty()) throw InputError("--restart: no checkpoint can be used: " + faults);
  return false;
}

void Checkpoints::load(const std::function<void(Archive&)>& transfer) const {
  try {
    const Hdf5File file(chosen, Hdf5File::Mode::read);
    Loader loader(file, group_of(ranks.rank()));
    transfer(loader);
    loader.finish();
  } catch (const std::runtime_error& error) {
    throw InputError("--restart: " + chosen.string() + ": " + error.what());
  }
}

void Checkpoints::remove() const {
  ranks.on_first([this] {
    fs::remove(newest);
    fs::remove(previous);
  });
}

} // namespace spall
