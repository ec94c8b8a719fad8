// Lucy: smooth-particle and molecular dynamics on one set of kernels.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdf5_file.hpp"

#include <fmt/format.h>

#include "lucy/errors.hpp"
#include "lucy/files/atomic_file.hpp"

namespace lucy::files::hdf5 {

namespace {

/// The library describes a failure from the call that was made down to its cause; the last description is the cause.
herr_t keep_description(unsigned, const H5E_error2_t* error, void* text) {
  if (error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
  return 0;
}

std::mutex& library_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// The finished file as it would stand on disk, handed to `use` while the library holds it.
template <class Use>
void with_file_image(const std::function<void(hid_t)>& write, const Use& use) {
  constexpr std::size_t growth = std::size_t{1} << 20;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  checked(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG));
  checked(H5Pset_fapl_core(access, growth, false));
  const Handle file(H5Fcreate("in memory", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
  write(file);
  checked(H5Fflush(file, H5F_SCOPE_GLOBAL));
  const auto size = static_cast<std::size_t>(checked(H5Fget_file_image(file, nullptr, 0)));
  void* image = nullptr;
  checked(H5Fget_vfd_handle(file, H5P_DEFAULT, &image));
  use(std::span(*static_cast<const std::byte* const*>(image), size));
}

}  // namespace

std::string deepest_description() {
  std::string text = "unknown reason";
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep_description, &text);
  return text;
}

Turn::Turn() : lock_(library_mutex()) {
  H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Turn::~Turn() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }

Handle create_group(hid_t parent, const std::string& name) {
  return Handle(H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
}

Handle text_type(std::size_t length) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  checked(H5Tset_size(type, length));
  checked(H5Tset_strpad(type, H5T_STR_NULLPAD));
  checked(H5Tset_cset(type, H5T_CSET_UTF8));
  return type;
}

void add_attribute(hid_t object, const char* name, std::string_view text) {
  const std::string padded = text.empty() ? std::string(1, '\0') : std::string(text);
  const Handle type = text_type(padded.size());
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  checked(H5Awrite(attribute, type, padded.data()));
}

Handle create_dataset(hid_t parent, const char* name, hid_t type, std::span<const hsize_t> shape) {
  const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  checked(H5Pset_obj_track_times(properties, false));  // the same contents, the same bytes
  return Handle(H5Dcreate2(parent, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
}

void write_file(const std::filesystem::path& path, const std::function<void(hid_t file)>& write) {
  const Turn turn;
  try {
    with_file_image(write, [&path](std::span<const std::byte> image) {
      const std::array<std::span<const std::byte>, 1> pieces = {image};
      write_file_atomically(path, pieces);
    });
  } catch (const LibraryFailure& failure) {
    throw RunFailed(fmt::format("cannot write {}: {}", path.string(), failure.reason));
  }
}

}  // namespace lucy::files::hdf5
