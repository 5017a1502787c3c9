#include "macro/restart/checkpoint.h"

#include "macro/restart/byte_archives.h"
#include "shared/error.h"
#include "shared/hdf5_file.h"
#include "shared/output_directory.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <numeric>
#include <sstream>

namespace spall {
namespace fs = std::filesystem;
namespace {

/// Raised whenever a `transfer` or the layout of the file changes.
constexpr int format_version = 8;
const char* const format_name = "spall penetrate checkpoint";

/// Pieces are written together, about so many bytes at a time.
constexpr std::size_t buffer_size = 8 << 20;

/// HDF5's own needs for the file, generously, and what is kept of each piece besides its bytes.
constexpr std::size_t overhead = 1 << 16, per_piece = 16;

// Layout: a group per list of pieces with `bytes`, one piece after the other, their `ends` and `checksums`.
// The list `common` has one piece, what is the same on all ranks; the list `ranks` one of each rank.
const char* const common_list = "common";
const char* const ranks_list = "ranks";
std::string path_of(const std::string& list, const char* array) { return "/lists/" + list + "/" + array; }

/// What a state takes in the file.
class RoomCounter final : public Archive {
public:
  bool loading() const override { return false; }
  void pieces(const std::string&, std::size_t count, const Piece& piece) override {
    kept += count * per_piece;
    for (std::size_t k = 0; k < count; ++k) piece(k, counter);
  }
  void item(const char* name, void* value, std::size_t count) override { counter.item(name, value, count); }
  void array(const char* name, Sequence& values) override { counter.array(name, values); }
  std::size_t bytes() const { return kept + counter.bytes; }

private:
  ByteCounter counter;
  std::size_t kept = 0;
};

class Saver final : public Archive {
public:
  Saver(Hdf5File& file_, const Ranks& ranks_) : file(file_), ranks(ranks_) {}
  bool loading() const override { return false; }
  void pieces(const std::string& name, std::size_t count, const Piece& piece) override {
    std::vector<std::size_t> sizes(count);
    for (std::size_t k = 0; k < count; ++k) {
      ByteCounter counter;
      piece(k, counter);
      sizes[k] = counter.bytes;
    }
    write(name, sizes, piece);
  }
  bool of_rank(const std::function<void(Archive&)>& part) override {
    part(own);
    return true;
  }
  void item(const char* name, void* value, std::size_t count) override { common.item(name, value, count); }
  void array(const char* name, Sequence& values) override { common.array(name, values); }
  /// Call after the last part.
  void finish() {
    using Sizes = std::vector<std::size_t>;
    write(common_list, ranks.first() ? Sizes{common.bytes.size()} : Sizes{},
          [this](std::size_t, ByteWriter& to) { to.bytes.swap(common.bytes); });
    write(ranks_list, {own.bytes.size()}, [this](std::size_t, ByteWriter& to) { to.bytes.swap(own.bytes); });
  }

private:
  /// All ranks write their pieces of a list, as many times together as the one with most of them needs.
  template<class Fill>
  void write(const std::string& name, const std::vector<std::size_t>& sizes, const Fill& fill) {
    const Share share = ranks.share(std::accumulate(sizes.begin(), sizes.end(), std::size_t{0}));
    file.allocate_bytes(path_of(name, "bytes"), share.all);
    std::vector<std::int64_t> ends, sums;
    std::vector<std::byte> buffer;
    std::uint64_t at = share.first;
    for (std::size_t k = 0; ranks.any(k < sizes.size());) {
      buffer.clear();
      for (; k < sizes.size() && (buffer.empty() || buffer.size() + sizes[k] <= buffer_size); ++k) {
        ByteWriter piece;
        piece.bytes.reserve(sizes[k]);
        fill(k, piece);
        buffer.insert(buffer.end(), piece.bytes.begin(), piece.bytes.end());
        ends.push_back(static_cast<std::int64_t>(at + buffer.size()));
        sums.push_back(std::bit_cast<std::int64_t>(checksum(piece.bytes)));
      }
      file.write_bytes(path_of(name, "bytes"), at, buffer.data(), buffer.size());
      at += buffer.size();
    }
    const Share pieces = ranks.share(sizes.size());
    file.write_part(path_of(name, "ends"), pieces, ends);
    file.write_part(path_of(name, "checksums"), pieces, sums);
  }

  Hdf5File& file;
  const Ranks& ranks;
  ByteWriter common, own;
};

/// A list of pieces in a file.
class PieceList {
public:
  PieceList(const Hdf5File& file_, const std::string& name)
      : file(file_), path(path_of(name, "bytes")), ends(file.read<std::int64_t>(path_of(name, "ends"))) {
    if (!std::is_sorted(ends.begin(), ends.end()) || (!ends.empty() && ends.front() < 0)) refuse_part(name);
  }

  std::size_t count() const { return ends.size(); }
  std::vector<std::byte> read(std::size_t k) const {
    if (k >= ends.size()) refuse_part(path);
    const std::int64_t begin = k > 0 ? ends[k - 1] : 0;
    if (static_cast<std::uint64_t>(ends[k]) > file.count(path)) refuse_part(path);
    std::vector<std::byte> bytes(static_cast<std::size_t>(ends[k] - begin));
    if (!bytes.empty()) file.read_bytes(path, static_cast<std::size_t>(begin), bytes.data(), bytes.size());
    return bytes;
  }

private:
  const Hdf5File& file;
  std::string path;
  std::vector<std::int64_t> ends;
};

class Loader final : public Archive {
public:
  Loader(const Hdf5File& file_, const Ranks& ranks_)
      : file(file_), ranks(ranks_), common(PieceList(file, common_list).read(0)), own({}) {
    const PieceList writers(file, ranks_list);
    as_many_ranks = writers.count() == static_cast<std::size_t>(ranks.count());
    if (as_many_ranks) own = ByteReader(writers.read(static_cast<std::size_t>(ranks.rank())));
  }
  bool loading() const override { return true; }
  std::uint64_t left() const override { return common.left(); }
  void pieces(const std::string& name, std::size_t count, const Piece& piece) override {
    const Share share = ranks.share(count);
    std::string problem;
    try {
      const PieceList list(file, name);
      if (list.count() != share.all) refuse_part(name);
      for (std::size_t k = 0; k < count; ++k) {
        ByteReader reader(list.read(share.first + k));
        piece(k, reader);
        reader.finish();
      }
    } catch (const std::runtime_error& error) {
      problem = error.what();
    }
    if (ranks.any(!problem.empty()))
      throw std::runtime_error(problem.empty() ? "a rank cannot load its pieces of '" + name + "'" : problem);
  }
  bool of_rank(const std::function<void(Archive&)>& part) override {
    if (as_many_ranks) part(own);
    return as_many_ranks;
  }
  void item(const char* name, void* value, std::size_t count) override { common.item(name, value, count); }
  void array(const char* name, Sequence& values) override { common.array(name, values); }
  /// Call after the last part. @throws std::runtime_error if something is left
  void finish() const {
    common.finish();
    if (as_many_ranks) own.finish();
  }

private:
  const Hdf5File& file;
  const Ranks& ranks;
  ByteReader common, own;
  bool as_many_ranks;
};

/// True if this rank's part of all pieces is as it was written.
bool is_sound(const fs::path& path, const Ranks& ranks) {
  try {
    const Hdf5File file(path, Hdf5File::Mode::read);
    const auto rank = static_cast<std::size_t>(ranks.rank()), parts = static_cast<std::size_t>(ranks.count());
    for (const std::string& name : file.list("/lists")) {
      const PieceList list(file, name);
      const auto sums = file.read<std::int64_t>(path_of(name, "checksums"));
      for (std::size_t k = list.count() * rank / parts; k < list.count() * (rank + 1) / parts; ++k)
        if (std::bit_cast<std::int64_t>(checksum(list.read(k))) != sums.at(k)) return false;
    }
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

/// First line in which two texts differ, as it is in `ours`; empty if they agree.
std::string first_difference(const std::string& ours, const std::string& theirs) {
  std::istringstream a(ours), b(theirs);
  std::string line, other;
  while (std::getline(a, line))
    if (!std::getline(b, other) || line != other)
      return line.substr(std::min(line.size(), line.find_first_not_of(' ')));
  return std::getline(b, other) ? other : "";
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

Checkpoints::Checkpoints(fs::path directory, Provenance provenance_, const std::vector<fs::path>& inputs,
                         const Ranks& ranks_)
    : newest(directory / "checkpoint.h5"), previous(directory / "checkpoint_previous.h5"),
      provenance(std::move(provenance_)), files(checksums_of(inputs)), ranks(ranks_) {}

void Checkpoints::write(const std::function<void(Archive&)>& transfer) const {
  RoomCounter counter;
  transfer(counter);
  const double bytes = static_cast<double>(overhead + provenance.input.size()) +
                       ranks.sum(static_cast<double>(counter.bytes()));
  try {
    Temporary part(newest, ranks);
    ranks.on_first([&] { check_room(part.path(), static_cast<std::size_t>(bytes) + room_of_seal); });
    Hdf5File file(part.path(), Hdf5File::Mode::create, ranks);
    describe(file);
    Saver saver(file, ranks);
    transfer(saver);
    saver.finish();
    file.close();
    ranks.on_first([&] { keep_previous(); });
    part.take_place_of(newest);
  } catch (const std::exception& error) {
    throw OutputError("cannot write '" + newest.string() + "': " + error.what());
  }
}

void Checkpoints::describe(Hdf5File& file) const {
  file.set_attribute("/", "format", std::string(format_name));
  file.set_attribute("/", "format_version", format_version);
  file.set_attribute("/", "ranks", ranks.count());
  file.set_attribute("/", "program", provenance.program);
  file.set_attribute("/", "input_file", provenance.input_file);
  file.set_attribute("/", "created", provenance.created);
  file.set_attribute("/", "input", provenance.input);
  file.set_attribute("/", "files", files);
}

void Checkpoints::keep_previous() const {
  if (!fs::exists(newest)) return;
  fs::remove(previous);
  std::error_code no_links;
  fs::create_hard_link(newest, previous, no_links);
  if (no_links) fs::rename(newest, previous);
}

std::string Checkpoints::foreign(const fs::path& path) const {
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
    if (const std::string other = first_difference(files, file.text_attribute("/", "files")); !other.empty())
      return path.string() + ": was computed with another content of the file " + other;
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

bool Checkpoints::find() {
  std::string faults;
  for (const fs::path& file : {newest, previous}) {
    std::vector<std::string> seen; // by the first rank: what is wrong
    ranks.on_first([&] {
      if (fs::exists(file)) seen = {foreign(file)};
    });
    seen = ranks.gather(seen);
    if (seen.empty()) continue;
    std::string wrong = seen.front();
    if (wrong.empty() && ranks.any(!is_sound(file, ranks)))
      wrong = file.string() + ": is damaged, a checksum is wrong";
    if (wrong.empty()) {
      chosen = file;
      if (!faults.empty() && ranks.first()) std::fprintf(stderr, "refused: %s\n", faults.c_str());
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
    Loader loader(file, ranks);
    transfer(loader);
    loader.finish();
  } catch (const std::runtime_error& error) {
    throw InputError("--restart: " + chosen.string() + ": " + error.what());
  }
}

} // namespace spall
