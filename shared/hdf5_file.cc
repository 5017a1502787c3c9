#include "shared/hdf5_file.h"

#include "shared/output_directory.h"

#include <hdf5.h>

#include <algorithm>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace spall {
namespace {

/// Closes an HDF5 handle at the end of its scope.
class Handle {
public:
  Handle(hid_t id_, herr_t (*close_)(hid_t)) : id(id_), close(close_) {}
  ~Handle() {
    if (id >= 0) close(id);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id; }
  bool bad() const { return id < 0; }

private:
  hid_t id;
  herr_t (*close)(hid_t);
};

template<class T> hid_t native_type() {
  if constexpr (std::is_same_v<T, double>)
    return H5T_NATIVE_DOUBLE;
  else if constexpr (std::is_same_v<T, float>)
    return H5T_NATIVE_FLOAT;
  else if constexpr (std::is_same_v<T, std::int32_t>)
    return H5T_NATIVE_INT32;
  else if constexpr (std::is_same_v<T, std::int64_t>)
    return H5T_NATIVE_INT64;
  else
    return H5T_NATIVE_UINT8;
}

/// Returns a property list that creates the parent groups of a new object.
hid_t with_parents() {
  const hid_t list = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(list, 1);
  return list;
}

/// Returns the property list for opening a file, collectively if there are several ranks.
hid_t access_by(const Ranks& ranks) {
  const hid_t list = H5Pcreate(H5P_FILE_ACCESS);
  if (ranks.several()) H5Pset_fapl_mpio(list, MPI_COMM_WORLD, MPI_INFO_NULL);
  return list;
}

/// Returns the property list of a collective transfer.
hid_t together(const Ranks& ranks) {
  const hid_t list = H5Pcreate(H5P_DATASET_XFER);
  if (ranks.several()) H5Pset_dxpl_mpio(list, H5FD_MPIO_COLLECTIVE);
  return list;
}

/// Whether an array is stored as this program writes arrays: one after the other in the file itself.
bool is_plain(hid_t set) {
  const Handle made(H5Dget_create_plist(set), H5Pclose);
  return H5Pget_layout(made) == H5D_CONTIGUOUS && H5Pget_external_count(made) == 0;
}

/// Selects rows of an array and of memory, perhaps none. @return false on failure
bool select(hid_t space, hid_t memory, const hsize_t* first, const hsize_t* count) {
  if (count[0] == 0) return H5Sselect_none(space) >= 0 && H5Sselect_none(memory) >= 0;
  return H5Sselect_hyperslab(space, H5S_SELECT_SET, first, nullptr, count, nullptr) >= 0;
}

} // namespace

Hdf5File::Hdf5File(const std::filesystem::path& path, Mode mode_, const Ranks& ranks_)
    : name(path.string()), mode(mode_), ranks(ranks_), file(-1) {
  H5Eset_auto2(
      H5E_DEFAULT, nullptr,
      nullptr); // the messages thrown here name file and object, so HDF5's own output is switched off
  if (mode != Mode::create) {
    std::string fault;
    try {
      check_seal(path);
      if (mode == Mode::read) bytes = std::filesystem::file_size(path);
    } catch (const std::exception& error) {
      fault = error.what();
    }
    check(fault.empty(), fault.empty() ? "is refused by another process" : fault);
  }
  const Handle access(access_by(ranks), H5Pclose);
  file = mode == Mode::create
             ? H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access)
             : H5Fopen(name.c_str(), mode == Mode::append ? H5F_ACC_RDWR : H5F_ACC_RDONLY, access);
  check(file >= 0, mode == Mode::create ? "cannot be created" : "is no HDF5 file");
}

Hdf5File::~Hdf5File() {
  if (file >= 0) H5Fclose(file);
}

void Hdf5File::close() {
  const std::vector<ByteRange> apart = parts_apart();
  check(H5Fclose(std::exchange(file, -1)) >= 0, "cannot be written to its end");
  if (mode == Mode::read) return;
  std::string fault;
  try {
    if (ranks.first()) seal(name, apart);
  } catch (const std::exception& error) {
    fault = error.what();
  }
  check(fault.empty(), fault.empty() ? "cannot be sealed" : fault);
}

std::vector<ByteRange> Hdf5File::parts_apart() const {
  std::vector<ByteRange> parts;
  for (const std::string& path : arrays_apart) {
    const Handle set(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose);
    const haddr_t place = H5Dget_offset(set);
    if (place != HADDR_UNDEF) parts.push_back({place, H5Dget_storage_size(set)});
  }
  std::sort(parts.begin(), parts.end(),
            [](const ByteRange& a, const ByteRange& b) { return a.first < b.first; });
  return parts;
}

void Hdf5File::require_own(const std::string& path) const {
  for (std::size_t end = 0; end != std::string::npos && path != "/";) {
    end = path.find('/', end + 1);
    H5L_info_t link{};
    const std::string part = path.substr(0, end);
    if (H5Lget_info(file, part.c_str(), &link, H5P_DEFAULT) < 0) fail("'" + part + "' is missing");
    if (link.type != H5L_TYPE_HARD)
      fail("'" + part + "' is a link, which may lead elsewhere; allowed: an object of this file");
  }
}

void Hdf5File::fail(const std::string& what) const { throw std::runtime_error(name + ": " + what); }

template<class T>
void Hdf5File::write(const std::string& path, const T* values, std::size_t rows, std::size_t columns) {
  const hsize_t size[2] = {rows, columns};
  const Handle space(H5Screate_simple(columns == 1 ? 1 : 2, size, nullptr), H5Sclose);
  const Handle parents(with_parents(), H5Pclose);
  const Handle set(H5Dcreate2(file, path.c_str(), native_type<T>(), space, parents, H5P_DEFAULT, H5P_DEFAULT),
                   H5Dclose);
  if (set.bad() || H5Dwrite(set, native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
    fail("array '" + path + "' cannot be written");
}

template<class T>
void Hdf5File::write_part(const std::string& path, const Share& rows, const std::vector<T>& values,
                          std::size_t columns) {
  const hsize_t size[2] = {rows.all, columns}, first[2] = {rows.first, 0}, count[2] = {rows.count, columns};
  const int dimensions = columns == 1 ? 1 : 2;
  const Handle space(H5Screate_simple(dimensions, size, nullptr), H5Sclose),
      memory(H5Screate_simple(dimensions, count, nullptr), H5Sclose), parents(with_parents(), H5Pclose),
      transfer(together(ranks), H5Pclose);
  const Handle set(H5Dcreate2(file, path.c_str(), native_type<T>(), space, parents, H5P_DEFAULT, H5P_DEFAULT),
                   H5Dclose);
  check(!set.bad(), "array '" + path + "' cannot be made");
  check(select(space, memory, first, count) &&
            H5Dwrite(set, native_type<T>(), memory, space, transfer, values.data()) >= 0,
        "array '" + path + "' cannot be written");
}

template<class T> std::vector<T> Hdf5File::read(const std::string& path, std::size_t columns) const {
  require_own(path);
  const Handle set(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (set.bad()) fail("array '" + path + "' is missing");
  if (!is_plain(set))
    fail("array '" + path + "' has its values in another form or file than this program writes");
  if (H5Dget_storage_size(set) > bytes) fail("array '" + path + "' is larger than the file");
  const Handle space(H5Dget_space(set), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space);
  hsize_t size[2] = {0, 1};
  if (rank < 1 || rank > 2)
    fail("array '" + path + "' has " + std::to_string(rank) + " dimensions, expected " +
         (columns == 1 ? "1" : "2"));
  H5Sget_simple_extent_dims(space, size, nullptr);
  if (size[1] != columns || (columns == 1 && rank != 1))
    fail("array '" + path + "' has " + std::to_string(rank) + " dimensions and " + std::to_string(size[1]) +
         " columns, expected " + std::to_string(columns) + " columns");
  const Handle stored(H5Dget_type(set), H5Tclose);
  const bool is_number = H5Tget_class(stored) == H5T_INTEGER || H5Tget_class(stored) == H5T_FLOAT;
  if (!is_number) fail("array '" + path + "' does not hold numbers");
  if (size[0] > bytes / H5Tget_size(stored) / std::max<hsize_t>(1, size[1]))
    fail("array '" + path + "' is larger than the file");
  std::vector<T> values(size[0] * size[1]);
  if (H5Dread(set, native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail("array '" + path + "' cannot be read: the file is damaged");
  return values;
}

template void Hdf5File::write(const std::string&, const double*, std::size_t, std::size_t);
template void Hdf5File::write(const std::string&, const float*, std::size_t, std::size_t);
template void Hdf5File::write(const std::string&, const std::int32_t*, std::size_t, std::size_t);
template void Hdf5File::write(const std::string&, const std::int64_t*, std::size_t, std::size_t);
template void Hdf5File::write(const std::string&, const std::uint8_t*, std::size_t, std::size_t);
template void Hdf5File::write_part(const std::string&, const Share&, const std::vector<float>&, std::size_t);
template void Hdf5File::write_part(const std::string&, const Share&, const std::vector<std::int64_t>&,
                                   std::size_t);
template std::vector<double> Hdf5File::read(const std::string&, std::size_t) const;
template std::vector<float> Hdf5File::read(const std::string&, std::size_t) const;
template std::vector<std::int32_t> Hdf5File::read(const std::string&, std::size_t) const;
template std::vector<std::int64_t> Hdf5File::read(const std::string&, std::size_t) const;
template std::vector<std::uint8_t> Hdf5File::read(const std::string&, std::size_t) const;

void Hdf5File::allocate_bytes(const std::string& path, std::size_t count) {
  const hsize_t size = count;
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
  const Handle parents(with_parents(), H5Pclose);
  const Handle set(H5Dcreate2(file, path.c_str(), H5T_NATIVE_UINT8, space, parents, H5P_DEFAULT, H5P_DEFAULT),
                   H5Dclose);
  check(!set.bad(), "array '" + path + "' cannot be made");
  arrays_apart.push_back(path);
}

namespace {

/// Reads or writes a part of a one-dimensional array of bytes with H5Dread or H5Dwrite. @return false on
/// failure
template<class Move>
bool move_part(hid_t file, const std::string& path, std::size_t first, std::size_t count, const Move& move) {
  const Handle set(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (set.bad()) return false;
  const hsize_t begin = first, size = count;
  const Handle part(H5Dget_space(set), H5Sclose), memory(H5Screate_simple(1, &size, nullptr), H5Sclose);
  hsize_t whole = 0;
  if (!is_plain(set) || H5Sget_simple_extent_ndims(part) != 1 ||
      H5Sget_simple_extent_dims(part, &whole, nullptr) < 0 || begin > whole || size > whole - begin)
    return false;
  return select(part, memory, &begin, &size) && move(set, memory, part) >= 0;
}

} // namespace

std::size_t Hdf5File::count(const std::string& path) const {
  require_own(path);
  const Handle set(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (set.bad()) fail("array '" + path + "' is missing");
  const Handle space(H5Dget_space(set), H5Sclose);
  return static_cast<std::size_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space)));
}

void Hdf5File::write_bytes(const std::string& path, std::size_t first, const void* values,
                           std::size_t count) {
  const Handle transfer(together(ranks), H5Pclose);
  check(move_part(file, path, first, count,
                  [&](hid_t set, hid_t memory, hid_t part) {
                    return H5Dwrite(set, H5T_NATIVE_UINT8, memory, part, transfer, values);
                  }),
        "array '" + path + "' cannot be written");
}

void Hdf5File::read_bytes(const std::string& path, std::size_t first, void* values, std::size_t count) const {
  require_own(path);
  if (!move_part(file, path, first, count, [&](hid_t set, hid_t memory, hid_t part) {
        return H5Dread(set, H5T_NATIVE_UINT8, memory, part, H5P_DEFAULT, values);
      }))
    fail("array '" + path + "' cannot be read");
}

void Hdf5File::link(const std::string& path, const std::string& other_file, const std::string& object) {
  const Handle parents(with_parents(), H5Pclose);
  if (H5Lcreate_external(other_file.c_str(), object.c_str(), file, path.c_str(), parents, H5P_DEFAULT) < 0)
    fail("link '" + path + "' cannot be made");
}

namespace {

void write_attribute(hid_t file, const std::string& path, const std::string& attribute, hid_t type,
                     const void* value, const std::string& file_name) {
  const Handle object(H5Oopen(file, path.c_str(), H5P_DEFAULT), H5Oclose);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle made(
      object.bad() ? -1 : H5Acreate2(object, attribute.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  if (made.bad() || H5Awrite(made, type, value) < 0)
    throw std::runtime_error(file_name + ": attribute '" + attribute + "' of '" + path +
                             "' cannot be written");
}

/// An attribute that is open, of one value. @throws std::runtime_error
class OneValue {
public:
  OneValue(hid_t file, const std::string& path, const std::string& attribute, const std::string& file_name)
      : what(file_name + ": attribute '" + attribute + "' of '" + path + "' "),
        found(H5Aopen_by_name(file, path.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose),
        stored(found.bad() ? -1 : H5Aget_type(found), H5Tclose) {
    if (found.bad() || stored.bad()) fail("is missing");
    const Handle space(H5Aget_space(found), H5Sclose);
    if (H5Sget_simple_extent_npoints(space) != 1) fail("is a list, a single value is needed");
  }
  [[noreturn]] void fail(const std::string& why) const { throw std::runtime_error(what + why); }
  H5T_class_t kind() const { return H5Tget_class(stored); }

  const std::string what;
  const Handle found, stored;
};

template<class Value>
Value read_attribute(hid_t file, const std::string& path, const std::string& attribute, hid_t type,
                     H5T_class_t kind, const std::string& file_name) {
  const OneValue one(file, path, attribute, file_name);
  Value value{};
  if (one.kind() != kind || H5Aread(one.found, type, &value) < 0) one.fail("has the wrong type");
  return value;
}

} // namespace

void Hdf5File::set_attribute(const std::string& path, const std::string& attribute, double value) {
  write_attribute(file, path, attribute, H5T_NATIVE_DOUBLE, &value, name);
}
void Hdf5File::set_attribute(const std::string& path, const std::string& attribute, int value) {
  write_attribute(file, path, attribute, H5T_NATIVE_INT, &value, name);
}
void Hdf5File::set_attribute(const std::string& path, const std::string& attribute,
                             const std::string& value) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, std::max<std::size_t>(1, value.size()));
  H5Tset_cset(type, H5T_CSET_UTF8);
  write_attribute(file, path, attribute, type, value.empty() ? "\0" : value.data(), name);
}
double Hdf5File::real_attribute(const std::string& path, const std::string& attribute) const {
  require_own(path);
  return read_attribute<double>(file, path, attribute, H5T_NATIVE_DOUBLE, H5T_FLOAT, name);
}
int Hdf5File::integer_attribute(const std::string& path, const std::string& attribute) const {
  require_own(path);
  return read_attribute<int>(file, path, attribute, H5T_NATIVE_INT, H5T_INTEGER, name);
}
std::string Hdf5File::text_attribute(const std::string& path, const std::string& attribute) const {
  require_own(path);
  const OneValue one(file, path, attribute, name);
  if (one.kind() != H5T_STRING || H5Tis_variable_str(one.stored) > 0) one.fail("is not a text");
  const std::size_t size = H5Tget_size(one.stored);
  if (size > bytes) one.fail("is larger than the file");
  std::string value(size, '\0');
  if (H5Aread(one.found, one.stored, value.data()) < 0) one.fail("is damaged");
  value.erase(std::find(value.begin(), value.end(), '\0'), value.end());
  return value;
}

bool Hdf5File::exists(const std::string& path) const {
  if (path == "/") return true;
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    if (H5Lexists(file, path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

std::vector<std::string> Hdf5File::list(const std::string& group) const {
  require_own(group);
  const Handle opened(H5Gopen2(file, group.c_str(), H5P_DEFAULT), H5Gclose);
  if (opened.bad()) fail("group '" + group + "' is missing");
  std::vector<std::string> names;
  H5Literate(
      opened, H5_INDEX_NAME, H5_ITER_INC, nullptr,
      [](hid_t, const char* link, const H5L_info_t*, void* data) -> herr_t {
        static_cast<std::vector<std::string>*>(data)->emplace_back(link);
        return 0;
      },
      &names);
  return names;
}

void Hdf5File::make_group(const std::string& path) {
  const Handle parents(with_parents(), H5Pclose);
  const Handle made(H5Gcreate2(file, path.c_str(), parents, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  if (made.bad()) fail("group '" + path + "' cannot be created");
}

void write_hdf5_atomically(const std::filesystem::path& path, std::size_t bytes,
                           const std::function<void(Hdf5File&)>& fill, const Ranks& ranks) {
  write_atomically(
      path,
      [&](const std::filesystem::path& part) {
        ranks.on_first([&] { check_room(part, bytes + room_of_seal); });
        Hdf5File file(part, Hdf5File::Mode::create, ranks);
        fill(file);
        file.close();
      },
      ranks);
}

} // namespace spall
