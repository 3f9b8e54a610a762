// The HDF5 C library with owned handles and errors as exceptions.
// All functions throw Error naming the file and HDF5's own reason.
#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace slagflow::hdf5 {

// Owns one HDF5 identifier. A failed close in the destructor is ignored: use close() where it matters.
class Handle {
 public:
  using Closer = herr_t (*)(hid_t);

  Handle() = default;
  Handle(hid_t id, Closer closer) : id_(id), closer_(closer) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), closer_(other.closer_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(closer_, other.closer_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0) closer_(id_);
  }

  operator hid_t() const { return id_; }
  // Closes now; returns whether HDF5 could.
  bool close() { return id_ < 0 || closer_(std::exchange(id_, H5I_INVALID_HID)) >= 0; }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Closer closer_ = nullptr;
};

// Keeps HDF5 from printing its errors to stderr while it lives (the setting belongs to the thread).
class QuietErrors {
 public:
  QuietErrors();
  ~QuietErrors();
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

// An open file and the name that its errors carry.
class File {
 public:
  enum class Access { read, change };

  static File create(const std::string& path);  // replaces an existing file
  static File open(const std::string& path, Access access);
  // In memory alone; `path` is for its errors.
  static File create_in_memory(const std::string& path);

  hid_t id() const { return file_; }
  const std::string& path() const { return path_; }

  // Throws Error "cannot <action> <path>: <reason of HDF5>".
  [[noreturn]] void fail(const std::string& action) const;
  // Passes a result of HDF5 on, or fails when it is negative.
  template <class T>
  T check(T result, const char* action) const {
    if (result < 0) fail(action);
    return result;
  }

  // All that changed so far; also on closing. Where the file ends is noted in it before anything else, so
  // that at no moment it refers to places beyond.
  void flush() const;
  // After a crash the file may refer to places beyond the end that it knows of, and would fill them a second
  // time: from now on it ends where it ends on disk.
  void claim_all_bytes() const;
  // The bytes of the file as it is now; the vector has room for `spare` more.
  std::vector<std::byte> image(std::size_t spare) const;
  void close();

 private:
  File(Handle file, std::string path) : file_(std::move(file)), path_(std::move(path)) {}
  void note_end() const;

  Handle file_;
  std::string path_;
  int on_disk_ = -1;  // HDF5's own descriptor of a file that may change
};

Handle create_group(const File& file, const std::string& path);
Handle open_group(const File& file, const std::string& path);
Handle open_dataset(const File& file, const std::string& path);
std::vector<std::string> members(const File& file, const std::string& path);  // names in a group

// Attributes. Text is of variable length, so a long one needs no more than a reference in the header; it
// replaces an earlier one of the same name.
void write_text(const File& file, hid_t object, const char* name, const std::string& text);
void write_fixed_text(const File& file, hid_t object, const char* name, const std::string& text);
void write_integers(const File& file, hid_t object, const char* name, const std::vector<std::int64_t>& v);
// Attributes that hold one text each, in order of name; others are left out.
std::vector<std::pair<std::string, std::string>> read_texts(const File& file, hid_t object);
std::int64_t read_integer(const File& file, hid_t object, const char* name);

enum class Storage { plain, compressed };

// What a data set holds: rows of `components` elements of `type`, without limit on their number.
struct TableLayout {
  hid_t type = H5T_NATIVE_FLOAT;
  int components = 0;  // 0: one-dimensional
  hsize_t chunk_rows = 1;
  Storage storage = Storage::plain;
};

// Creates an empty data set; the groups above it must be there.
Handle create_table(const File& file, const std::string& path, const TableLayout& layout);
hsize_t rows(const File& file, hid_t dataset);     // that there are now
hsize_t columns(const File& file, hid_t dataset);  // 1 for a one-dimensional data set
hsize_t chunk_rows(const File& file, hid_t dataset);

struct RowRange {
  hsize_t first = 0, count = 0;
};
// Writes rows and makes the data set end after them, whatever it held from there on.
void write_rows(const File& file, hid_t dataset, RowRange range, hid_t memory_type, const void* data);
// The same for a data set that is opened for it and closed again: only then are all bytes handed to the
// system.
void write_table(const File& file, const std::string& path, RowRange range, hid_t memory_type,
                 const void* data);
void read_rows(const File& file, hid_t dataset, RowRange range, hid_t memory_type, void* data);

}  // namespace slagflow::hdf5
