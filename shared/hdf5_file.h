#pragma once

#include "shared/ranks.h"
#include "shared/seal.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace spall {

/// An HDF5 file with arrays and attributes. A thin owner of HDF5's C handles: every call is checked and
/// failures are exceptions (std::runtime_error naming file and object), which deal.II's HDF5 classes do only
/// in debug mode. Paths inside the file are absolute ("/curves/0/strain"); missing groups are created on
/// writing. A file may be written by several ranks: all then make the same calls with the same values, except
/// for the parts of arrays, which are written collectively; what fails on one of them fails on all.
///
/// A file that is written gets a seal (seal.h), and one without a whole seal is refused before HDF5 sees it.
/// Reading never leaves the file: links to other files, arrays whose values are elsewhere, and arrays that
/// are larger than the file are refused.
class Hdf5File {
public:
  enum class Mode { create, append, read };
  /// @param ranks that write it together
  Hdf5File(const std::filesystem::path& file, Mode mode, const Ranks& ranks = {});
  ~Hdf5File();
  /// Writes what is still in memory, closes and seals the file. It must be called after writing, because a
  /// full disk may be reported only now.
  void close();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  /// Writes an array of `columns` values per row (1: one-dimensional), as double, float, int32, int64 or
  /// bytes.
  template<class T>
  void write(const std::string& path, const T* values, std::size_t rows, std::size_t columns = 1);
  template<class T>
  void write(const std::string& path, const std::vector<T>& values, std::size_t columns = 1) {
    write(path, values.data(), values.size() / columns, columns);
  }
  /// Writes an array whose rows are distributed over the ranks; `values` are those of this rank.
  template<class T>
  void write_part(const std::string& path, const Share& rows, const std::vector<T>& values,
                  std::size_t columns = 1);
  /// Reads a whole array; `columns` must agree with the file.
  template<class T> std::vector<T> read(const std::string& path, std::size_t columns = 1) const;

  /// Functions for a one-dimensional array of bytes. It is created at its full size and then written part by
  /// part, collectively (a rank may have no part). Each rank reads on its own. Such an array can be larger
  /// than what one process may read again, so that the seal leaves it out: its parts need checksums of their
  /// own.
  std::size_t count(const std::string& path) const; ///< bytes in it
  void allocate_bytes(const std::string& path, std::size_t count);
  void write_bytes(const std::string& path, std::size_t first, const void* values, std::size_t count);
  void read_bytes(const std::string& path, std::size_t first, void* values, std::size_t count) const;

  /// Makes `path` a link to an object of another file, whose name is relative to the folder of this one.
  void link(const std::string& path, const std::string& other_file, const std::string& object);

  /// Sets and reads attributes of a group or array ("/" for the file itself).
  void set_attribute(const std::string& path, const std::string& name, double value);
  void set_attribute(const std::string& path, const std::string& name, int value);
  void set_attribute(const std::string& path, const std::string& name, const std::string& value);
  double real_attribute(const std::string& path, const std::string& name) const;
  int integer_attribute(const std::string& path, const std::string& name) const;
  std::string text_attribute(const std::string& path, const std::string& name) const;

  bool exists(const std::string& path) const;
  /// Returns the names of the links in a group, sorted.
  std::vector<std::string> list(const std::string& group) const;
  void make_group(const std::string& path);

private:
  [[noreturn]] void fail(const std::string& what) const;
  /// Throws on all ranks unless all ranks have succeeded.
  void check(bool good, const std::string& what) const {
    if (ranks.any(!good)) fail(what);
  }
  /// Throws unless `path` is an object of this file, its links included, and no link to another one.
  void require_own(const std::string& path) const;
  /// Parts of the file that the seal leaves out.
  std::vector<ByteRange> parts_apart() const;

  std::string name;
  Mode mode;
  Ranks ranks;
  std::int64_t file;
  std::size_t bytes = SIZE_MAX;            ///< of a file that is read
  std::vector<std::string> arrays_apart{}; ///< arrays of bytes that were written
};

/// Creates an HDF5 file as write_atomically() does: room for it is made sure of first, `fill` writes it, then
/// it is closed, and only if the disk has all of it does it take the place of an older file.
/// @param bytes that it will have at most. @throws OutputError; an older file is then untouched
void write_hdf5_atomically(const std::filesystem::path& file, std::size_t bytes,
                           const std::function<void(Hdf5File&)>& fill, const Ranks& ranks = {});

} // namespace spall
