// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The HDF5 library as this room uses it: objects that close themselves, failures as exceptions, one thread at a time.
// Files are put together in memory and written by atomic_file, since the library does not survive a disk that refuses.
#pragma once

#include <hdf5.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace lucy::files::hdf5 {

/// What the library says went wrong; whoever knows the path makes a sentence of it.
struct LibraryFailure {
  std::string reason;
};

/// The last description in the library's stack of errors: the cause.
std::string deepest_description();

template <class Result>
Result checked(Result result) {
  if (result < 0) throw LibraryFailure{deepest_description()};
  return result;
}

/// An object of the library, closed at the end of its scope.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) : id_(checked(id)), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

/// To be held while the library is used: it has one state for the whole process, and Debian's build of it is not meant
/// for two threads at once. It prints nothing by itself meanwhile: what went wrong is told in the exception.
class Turn {
 public:
  Turn();
  ~Turn();
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  std::unique_lock<std::mutex> lock_;
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// The types of numbers in memory and in files.
template <class T>
hid_t memory_type();
template <>
inline hid_t memory_type<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
inline hid_t memory_type<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
inline hid_t memory_type<int>() {
  return H5T_NATIVE_INT;
}

template <class T>
hid_t file_type();
template <>
inline hid_t file_type<double>() {
  return H5T_IEEE_F64LE;
}
template <>
inline hid_t file_type<std::int64_t>() {
  return H5T_STD_I64LE;
}
template <>
inline hid_t file_type<int>() {
  return H5T_STD_I32LE;
}

Handle create_group(hid_t parent, const std::string& name);

template <class T>
void add_attribute(hid_t object, const char* name, std::span<const T> values) {
  const hsize_t count = values.size();
  const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  const Handle attribute(H5Acreate2(object, name, file_type<T>(), space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  checked(H5Awrite(attribute, memory_type<T>(), values.data()));
}

template <class T>
requires std::is_arithmetic_v<T>
void add_attribute(hid_t object, const char* name, T value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(object, name, file_type<T>(), space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  checked(H5Awrite(attribute, memory_type<T>(), &value));
}

/// Text of `length` bytes, at least one.
Handle text_type(std::size_t length);

void add_attribute(hid_t object, const char* name, std::string_view text);

Handle create_dataset(hid_t parent, const char* name, hid_t type, std::span<const hsize_t> shape);

template <class T>
Handle write_dataset(hid_t parent, const char* name, std::span<const hsize_t> shape, const std::vector<T>& values) {
  Handle dataset = create_dataset(parent, name, file_type<T>(), shape);
  checked(H5Dwrite(dataset, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  return dataset;
}

/// Makes the file in memory with `write`, then puts it under `path` in one step. The same contents give the same bytes.
/// Throws RunFailed with path and reason.
void write_file(const std::filesystem::path& path, const std::function<void(hid_t file)>& write);

}  // namespace lucy::files::hdf5
