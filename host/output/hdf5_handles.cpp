#include "host/output/hdf5_handles.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "backend/error.hpp"

namespace slagflow::hdf5 {
namespace {

// HDF5 lists the innermost cause first; it is the one that tells a user what to do.
herr_t keep_first(unsigned n, const H5E_error2_t* error, void* out) {
  if (n == 0) *static_cast<std::string*>(out) = error->desc;
  return 0;
}

std::string reason_of_hdf5() {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &reason);
  if (reason.empty()) return "unknown reason";
  // Of "unable to open file: name = ..., errno = 2, error message = 'No such file or directory', ..."
  static const std::string before = "error message = '";
  const auto from = reason.find(before);
  if (from == std::string::npos) return reason;
  const auto start = from + before.size();
  return reason.substr(start, reason.find('\'', start) - start);
}

Handle text_type(std::size_t size) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, size);
  return type;
}

// Files are closed one by one here. The library's own closing at exit would fall over a file whose last
// write failed. Must come before any other call of the library.
void keep_library_out_of_exit() {
  static const herr_t once = H5dont_atexit();
  static_cast<void>(once);
}

// Without locks, so that a run can append while a viewer has the file open.
Handle unlocked_access() {
  keep_library_out_of_exit();
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access, false, true);
  // Space ahead of need would be given back on closing: the file is cut first and its size noted after that,
  // and a kill between the two leaves a file that nobody opens.
  H5Pset_meta_block_size(access, 0);
  H5Pset_small_data_block_size(access, 0);
  return access;
}

Handle scalar_space() { return Handle(H5Screate(H5S_SCALAR), H5Sclose); }

Handle create_attribute(const File& file, hid_t object, const char* name, hid_t type, hid_t space) {
  return Handle(file.check(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), "write to"),
                H5Aclose);
}

// Rows and columns; one column where there is no second dimension.
std::array<hsize_t, 2> shape(const File& file, hid_t dataset) {
  const Handle space(file.check(H5Dget_space(dataset), "read"), H5Sclose);
  if (H5Sget_simple_extent_ndims(space) > 2)
    throw Error(file.path() + ": a data set has more than 2 dimensions");
  std::array<hsize_t, 2> extent{0, 1};
  file.check(H5Sget_simple_extent_dims(space, extent.data(), nullptr), "read");
  return extent;
}

// The memory and file shapes of a range of rows.
struct Selection {
  Handle memory, file;
};

Selection select(const File& file, hid_t dataset, RowRange range) {
  Handle space(file.check(H5Dget_space(dataset), "read"), H5Sclose);
  std::array<hsize_t, 2> extent{};
  const int rank = file.check(H5Sget_simple_extent_dims(space, extent.data(), nullptr), "read");
  const std::array<hsize_t, 2> start{range.first, 0}, count{range.count, extent[1]};
  file.check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
             "select rows of");
  Handle memory(H5Screate_simple(rank, count.data(), nullptr), H5Sclose);
  return {std::move(memory), std::move(space)};
}

std::string read_text(const File& file, hid_t attribute, hid_t type) {
  const Handle memory = text_type(H5T_VARIABLE);
  if (H5Tis_variable_str(type) <= 0) {
    std::string text(H5Tget_size(type), '\0');
    file.check(H5Aread(attribute, type, text.data()), "read");
    text.erase(std::find(text.begin(), text.end(), '\0'), text.end());
    return text;
  }
  char* raw = nullptr;
  H5Tset_cset(memory, H5Tget_cset(type));
  file.check(H5Aread(attribute, memory, &raw), "read");
  std::string text = raw != nullptr ? raw : "";
  H5free_memory(raw);
  return text;
}

}  // namespace

QuietErrors::QuietErrors() {
  keep_library_out_of_exit();
  H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

QuietErrors::~QuietErrors() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }

// The access list must outlive the test of the result: closing it would clear HDF5's reason.
File File::create(const std::string& path) {
  const Handle unlocked = unlocked_access();
  File file(Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, unlocked), H5Fclose), path);
  if (file.id() < 0) file.fail("create");
  return file;
}

File File::open(const std::string& path, Access access) {
  const Handle unlocked = unlocked_access();
  const unsigned flags = access == Access::change ? H5F_ACC_RDWR : H5F_ACC_RDONLY;
  File file(Handle(H5Fopen(path.c_str(), flags, unlocked), H5Fclose), path);
  if (file.id() < 0) {
    // HDF5 has no reason of the system for a file that vanished while it was opening it.
    if (::access(path.c_str(), F_OK) != 0) throw Error("cannot open " + path + ": " + std::strerror(errno));
    file.fail("open");
  }
  if (access == Access::change) {
    void* descriptor = nullptr;
    file.check(H5Fget_vfd_handle(file.id(), H5P_DEFAULT, &descriptor), "open");
    file.on_disk_ = *static_cast<const int*>(descriptor);
  }
  return file;
}

File File::create_in_memory(const std::string& path) {
  keep_library_out_of_exit();
  constexpr std::size_t growth = std::size_t{1} << 22;  // [bytes]
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, growth, false);
  File file(Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose), path);
  if (file.id() < 0) file.fail("create");
  return file;
}

void File::fail(const std::string& action) const {
  throw Error("cannot " + action + " " + path_ + ": " + reason_of_hdf5());
}

// The superblock of version 0, which HDF5 writes unless it is asked for another, holds the end of the file in
// the bytes from 40 on (HDF5 File Format Specification 3.0, II.A). HDF5 itself writes it last.
void File::note_end() const {
  constexpr off_t place = 40;
  constexpr std::array<unsigned char, 9> beginning{0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n', 0};
  std::array<unsigned char, 9> present{};
  if (on_disk_ < 0 || ::pread(on_disk_, present.data(), present.size(), 0) < 0 || present != beginning)
    return;
  haddr_t end = 0;
  check(H5Fget_eoa(file_, &end), "write to");
  if (::pwrite(on_disk_, &end, sizeof end, place) != sizeof end)
    throw Error("cannot write to " + path_ + ": " + std::strerror(errno));
}

void File::flush() const {
  note_end();
  check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "write to");
}

void File::claim_all_bytes() const { check(H5Fincrement_filesize(file_, 0), "extend"); }

std::vector<std::byte> File::image(std::size_t spare) const {
  flush();
  const auto size = check(H5Fget_file_image(file_, nullptr, 0), "take the bytes of");
  std::vector<std::byte> bytes;
  bytes.reserve(static_cast<std::size_t>(size) + spare);
  bytes.resize(static_cast<std::size_t>(size));
  check(H5Fget_file_image(file_, bytes.data(), bytes.size()), "take the bytes of");
  return bytes;
}

void File::close() {
  note_end();
  if (!file_.close()) fail("write to");
}

Handle create_group(const File& file, const std::string& path) {
  return Handle(
      file.check(H5Gcreate2(file.id(), path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), "write to"),
      H5Gclose);
}

Handle open_group(const File& file, const std::string& path) {
  return Handle(file.check(H5Gopen2(file.id(), path.c_str(), H5P_DEFAULT), "read"), H5Gclose);
}

Handle open_dataset(const File& file, const std::string& path) {
  return Handle(file.check(H5Dopen2(file.id(), path.c_str(), H5P_DEFAULT), "read"), H5Dclose);
}

std::vector<std::string> members(const File& file, const std::string& path) {
  std::vector<std::string> names;
  const Handle group = open_group(file, path);
  H5G_info_t info{};
  file.check(H5Gget_info(group, &info), "read");
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    std::array<char, 256> name{};
    file.check(
        H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i, name.data(), name.size(), H5P_DEFAULT),
        "read");
    names.emplace_back(name.data());
  }
  return names;
}

void write_text(const File& file, hid_t object, const char* name, const std::string& text) {
  const Handle type = text_type(H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  const Handle attribute = H5Aexists(object, name) > 0
                               ? Handle(file.check(H5Aopen(object, name, H5P_DEFAULT), "read"), H5Aclose)
                               : create_attribute(file, object, name, type, scalar_space());
  const char* data = text.c_str();
  file.check(H5Awrite(attribute, type, &data), "write to");
}

void write_fixed_text(const File& file, hid_t object, const char* name, const std::string& text) {
  const Handle type = text_type(text.size());
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  const Handle attribute = create_attribute(file, object, name, type, scalar_space());
  file.check(H5Awrite(attribute, type, text.data()), "write to");
}

void write_integers(const File& file, hid_t object, const char* name, const std::vector<std::int64_t>& v) {
  const hsize_t size = v.size();
  const Handle space = size == 1 ? scalar_space() : Handle(H5Screate_simple(1, &size, nullptr), H5Sclose);
  const Handle attribute = H5Aexists(object, name) > 0
                               ? Handle(file.check(H5Aopen(object, name, H5P_DEFAULT), "read"), H5Aclose)
                               : create_attribute(file, object, name, H5T_NATIVE_INT64, space);
  file.check(H5Awrite(attribute, H5T_NATIVE_INT64, v.data()), "write to");
}

std::vector<std::pair<std::string, std::string>> read_texts(const File& file, hid_t object) {
  std::vector<std::pair<std::string, std::string>> texts;
  H5O_info_t info;
  file.check(H5Oget_info2(object, &info, H5O_INFO_NUM_ATTRS), "read");
  for (hsize_t i = 0; i < info.num_attrs; ++i) {
    const Handle attribute(
        file.check(H5Aopen_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_INC, i, H5P_DEFAULT, H5P_DEFAULT),
                   "read"),
        H5Aclose);
    const Handle type(H5Aget_type(attribute), H5Tclose);
    if (H5Tget_class(type) != H5T_STRING) continue;
    std::array<char, 256> name{};
    H5Aget_name(attribute, name.size(), name.data());
    texts.emplace_back(name.data(), read_text(file, attribute, type));
  }
  return texts;
}

std::int64_t read_integer(const File& file, hid_t object, const char* name) {
  const Handle attribute(file.check(H5Aopen(object, name, H5P_DEFAULT), "read"), H5Aclose);
  std::int64_t value = 0;
  file.check(H5Aread(attribute, H5T_NATIVE_INT64, &value), "read");
  return value;
}

Handle create_table(const File& file, const std::string& path, const TableLayout& layout) {
  const hsize_t components = layout.components == 0 ? 1 : static_cast<hsize_t>(layout.components);
  const int rank = layout.components == 0 ? 1 : 2;
  const std::array<hsize_t, 2> extent{0, components}, limit{H5S_UNLIMITED, components};
  const std::array<hsize_t, 2> chunk{layout.chunk_rows, components};
  const Handle space(H5Screate_simple(rank, extent.data(), limit.data()), H5Sclose);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_chunk(properties, rank, chunk.data());
  if (layout.storage == Storage::compressed) {
    H5Pset_shuffle(properties);
    H5Pset_deflate(properties, 1);
  }
  return Handle(file.check(H5Dcreate2(file.id(), path.c_str(), layout.type, space, H5P_DEFAULT, properties,
                                      H5P_DEFAULT),
                           "write to"),
                H5Dclose);
}

hsize_t rows(const File& file, hid_t dataset) { return shape(file, dataset)[0]; }

hsize_t columns(const File& file, hid_t dataset) { return shape(file, dataset)[1]; }

hsize_t chunk_rows(const File& file, hid_t dataset) {
  const Handle properties(file.check(H5Dget_create_plist(dataset), "read"), H5Pclose);
  std::array<hsize_t, 8> chunk{};
  file.check(H5Pget_chunk(properties, static_cast<int>(chunk.size()), chunk.data()), "read");
  return chunk[0];
}

void write_rows(const File& file, hid_t dataset, RowRange range, hid_t memory_type, const void* data) {
  std::array<hsize_t, 2> extent = shape(file, dataset);
  if (extent[0] > range.first) {  // what a failed write has left cannot be changed, only dropped
    extent[0] = range.first;
    file.check(H5Dset_extent(dataset, extent.data()), "write to");
  }
  extent[0] = range.first + range.count;
  file.check(H5Dset_extent(dataset, extent.data()), "write to");
  if (range.count == 0) return;
  const Selection s = select(file, dataset, range);
  file.check(H5Dwrite(dataset, memory_type, s.memory, s.file, H5P_DEFAULT, data), "write to");
}

void write_table(const File& file, const std::string& path, RowRange range, hid_t memory_type,
                 const void* data) {
  Handle dataset = open_dataset(file, path);
  write_rows(file, dataset, range, memory_type, data);
  if (!dataset.close()) file.fail("write to");
}

void read_rows(const File& file, hid_t dataset, RowRange range, hid_t memory_type, void* data) {
  if (range.count == 0) return;
  const Selection s = select(file, dataset, range);
  file.check(H5Dread(dataset, memory_type, s.memory, s.file, H5P_DEFAULT, data), "read");
}

}  // namespace slagflow::hdf5
