#include "model/hdf5_io.h"

#include <utility>

#include "model/dataset.h"

namespace prospect::model::hdf5 {
namespace {

constexpr std::size_t kLongestText = 1 << 20;  // an attribute longer than this is damage
constexpr std::size_t kLongestName = 256;      // so is a name in a mask
constexpr hsize_t kLongestExtent = 1 << 22;    // and rows beyond this: no trial has so many frames

template <typename T>
hid_t NativeType();
template <>
hid_t NativeType<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}
template <>
hid_t NativeType<std::int8_t>() {
  return H5T_NATIVE_INT8;
}
template <>
hid_t NativeType<int>() {
  return H5T_NATIVE_INT32;
}
template <>
hid_t NativeType<float>() {
  return H5T_NATIVE_FLOAT;
}

[[noreturn]] void Fail(const std::string& file, const std::string& what) {
  throw DataError(file + ": " + what);
}

std::size_t CheckedCount(hid_t space, const std::vector<hsize_t>& dims, const std::string& name,
                         const std::string& file) {
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank != static_cast<int>(dims.size()))
    Fail(file, "'" + name + "' has the wrong rank; damaged");
  std::vector<hsize_t> found(dims.size());
  H5Sget_simple_extent_dims(space, found.data(), nullptr);
  std::size_t count = 1;
  for (std::size_t i = 0; i < dims.size(); ++i) {
    if (dims[i] > 0 && found[i] != dims[i])
      Fail(file, "'" + name + "' has the wrong size; damaged");
    if (dims[i] == 0 && found[i] > kLongestExtent)
      Fail(file, "'" + name + "' is too long for a trial; damaged");
    count *= found[i];
  }
  return count;
}

Handle TextType(std::size_t size, const std::string& file) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, file, "text type");
  Check(H5Tset_size(type, size), file, "text size");
  Check(H5Tset_cset(type, H5T_CSET_UTF8), file, "text encoding");
  return type;
}

void SetAttribute(hid_t object, const std::string& name, hid_t type, const void* value,
                  const std::string& file) {
  Handle space(H5Screate(H5S_SCALAR), H5Sclose, file, "scalar space");
  Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                   H5Aclose, file, "cannot create attribute '" + name + "'");
  Check(H5Awrite(attribute, type, value), file, "cannot write attribute '" + name + "'");
}

Handle OpenAttribute(hid_t object, const std::string& name, const std::string& file) {
  return Handle(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, file,
                "attribute '" + name + "' is missing; not a data set of ours, or damaged");
}

template <typename T>
T GetScalar(hid_t object, const std::string& name, hid_t type, const std::string& file) {
  Handle attribute = OpenAttribute(object, name, file);
  T value{};
  Check(H5Aread(attribute, type, &value), file, "cannot read attribute '" + name + "'");
  return value;
}

/// libhdf5 keeps what it read of groups and data sets, 55 kB a trial, by a measure of its own up to
/// 32 MB; in memory that was 330 MB for 6,000 trials, and nobody comes back to a trial soon.
void LimitCache(hid_t access, const std::string& file) {
  constexpr std::size_t kCacheBytes = 256 << 10;
  H5AC_cache_config_t config;
  config.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  Check(H5Pget_mdc_config(access, &config), file, "cache configuration");
  config.set_initial_size = 1;
  config.initial_size = config.min_size = config.max_size = kCacheBytes;
  config.incr_mode = H5C_incr__off;
  config.flash_incr_mode = H5C_flash_incr__off;
  config.decr_mode = H5C_decr__off;
  Check(H5Pset_mdc_config(access, &config), file, "cache configuration");
}

std::string ReadVariableText(hid_t attribute, hid_t type, const std::string& name,
                             const std::string& file) {
  char* text = nullptr;
  Check(H5Aread(attribute, type, &text), file, "cannot read attribute '" + name + "'");
  std::string value(text == nullptr ? "" : text);
  H5free_memory(text);
  return value;
}

}  // namespace

Handle::Handle(hid_t id, Close close, const std::string& file, const std::string& what)
    : id_(id), close_(close) {
  if (id_ < 0) Fail(file, what);
}
Handle::Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
Handle& Handle::operator=(Handle&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(close_, other.close_);
  return *this;
}
Handle::~Handle() {
  if (id_ >= 0) close_(id_);
}

void Quiet() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

void Check(herr_t status, const std::string& file, const std::string& what) {
  if (status < 0) Fail(file, what);
}

Handle OpenFile(const std::string& path) {
  Quiet();
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, path, "property list");
  LimitCache(access, path);
  return Handle(
      H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose, path,
      "does not open as an HDF5 file: it is missing, not ours, or was cut off while being "
      "written; collect or pack it again");
}

Handle CreateFile(const std::string& path) {
  Quiet();
  // Whoever writes a whole file holds its lock already (base/atomic_file.h).
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, path, "property list");
  Check(H5Pset_file_locking(access, /*use=*/false, /*ignore_when_disabled=*/true), path, "locks");
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  if (file < 0)
    throw DiskError(path + ": cannot be created; check the folder and the space on the disk");
  return Handle(file, H5Fclose, path, "");
}

Handle CreateInMemory(const std::string& name) {
  constexpr std::size_t kGrowBytes = 1 << 20;
  Quiet();
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, name, "property list");
  Check(H5Pset_fapl_core(access, kGrowBytes, /*backing_store=*/0), name, "memory file");
  return Handle(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, name,
                "cannot be built in memory");
}

std::vector<std::uint8_t> ImageOf(hid_t file, const std::string& name) {
  Check(H5Fflush(file, H5F_SCOPE_GLOBAL), name, "cannot be built in memory");
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  std::vector<std::uint8_t> image(size > 0 ? static_cast<std::size_t>(size) : 0);
  if (H5Fget_file_image(file, image.data(), image.size()) <= 0)
    Fail(name, "cannot be built in memory");
  return image;
}

Handle CreateGroup(hid_t parent, const std::string& name, const std::string& file) {
  return Handle(H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
                file, "cannot create group '" + name + "'");
}

Handle TimelessSet(const std::string& file) {
  Handle plist(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, file, "property list");
  Check(H5Pset_obj_track_times(plist, false), file, "times");
  return plist;
}

Handle OpenGroup(hid_t parent, const std::string& name, const std::string& file) {
  return Handle(H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose, file,
                "group '" + name + "' is missing; not a data set of ours, or damaged");
}

std::vector<std::string> LinkNames(hid_t group, const std::string& file) {
  std::vector<std::string> names;
  const auto append = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  Check(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, append, &names), file,
        "cannot list a group; damaged");
  return names;
}

template <typename T>
void Write(hid_t group, const std::string& name, const std::vector<T>& values,
           const std::vector<hsize_t>& dims, const std::string& file) {
  Handle space(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), H5Sclose,
               file, "space of '" + name + "'");
  Handle plist = TimelessSet(file);
  Handle set(
      H5Dcreate2(group, name.c_str(), NativeType<T>(), space, H5P_DEFAULT, plist, H5P_DEFAULT),
      H5Dclose, file, "cannot create '" + name + "'");
  if (values.empty()) return;
  Check(H5Dwrite(set, NativeType<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), file,
        "cannot write '" + name + "'");
}

template <typename T>
std::vector<T> Read(hid_t group, const std::string& name, const std::vector<hsize_t>& dims,
                    const std::string& file) {
  Handle set(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, file,
             "'" + name + "' is missing; not a data set of ours, or damaged");
  Handle space(H5Dget_space(set), H5Sclose, file, "space of '" + name + "'");
  std::vector<T> values(CheckedCount(space, dims, name, file));
  if (values.empty()) return values;
  Check(H5Dread(set, NativeType<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), file,
        "cannot read '" + name + "'; damaged");
  return values;
}

template void Write(hid_t, const std::string&, const std::vector<std::uint8_t>&,
                    const std::vector<hsize_t>&, const std::string&);
template void Write(hid_t, const std::string&, const std::vector<std::int8_t>&,
                    const std::vector<hsize_t>&, const std::string&);
template void Write(hid_t, const std::string&, const std::vector<int>&, const std::vector<hsize_t>&,
                    const std::string&);
template void Write(hid_t, const std::string&, const std::vector<float>&,
                    const std::vector<hsize_t>&, const std::string&);
template std::vector<std::uint8_t> Read(hid_t, const std::string&, const std::vector<hsize_t>&,
                                        const std::string&);
template std::vector<std::int8_t> Read(hid_t, const std::string&, const std::vector<hsize_t>&,
                                       const std::string&);
template std::vector<int> Read(hid_t, const std::string&, const std::vector<hsize_t>&,
                               const std::string&);
template std::vector<float> Read(hid_t, const std::string&, const std::vector<hsize_t>&,
                                 const std::string&);

void WriteStrings(hid_t group, const std::string& name, const std::vector<std::string>& values,
                  const std::string& file) {
  std::size_t longest = 1;
  for (const std::string& value : values) longest = std::max(longest, value.size());
  std::string flat(values.size() * longest, '\0');
  for (std::size_t i = 0; i < values.size(); ++i) values[i].copy(&flat[i * longest], longest);
  Handle type = TextType(longest, file);
  const hsize_t count = values.size();
  Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose, file, "space of '" + name + "'");
  Handle plist = TimelessSet(file);
  Handle set(H5Dcreate2(group, name.c_str(), type, space, H5P_DEFAULT, plist, H5P_DEFAULT),
             H5Dclose, file, "cannot create '" + name + "'");
  if (values.empty()) return;
  Check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, flat.data()), file,
        "cannot write '" + name + "'");
}

std::vector<std::string> ReadStrings(hid_t group, const std::string& name,
                                     const std::string& file) {
  Handle set(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, file,
             "'" + name + "' is missing; not a data set of ours, or damaged");
  Handle type(H5Dget_type(set), H5Tclose, file, "type of '" + name + "'");
  const std::size_t size = H5Tget_size(type);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 || size > kLongestName)
    Fail(file, "'" + name + "' does not hold short texts of one length; not ours, or damaged");
  Handle space(H5Dget_space(set), H5Sclose, file, "space of '" + name + "'");
  std::vector<std::string> values(CheckedCount(space, {0}, name, file));
  std::string flat(values.size() * size, '\0');
  if (values.empty()) return values;
  Check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, flat.data()), file,
        "cannot read '" + name + "'; damaged");
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string text = flat.substr(i * size, size);
    values[i] = text.substr(0, text.find('\0'));
  }
  return values;
}

void SetText(hid_t object, const std::string& name, const std::string& value,
             const std::string& file) {
  Handle type = TextType(std::max<std::size_t>(1, value.size()), file);
  SetAttribute(object, name, type, value.empty() ? "\0" : value.data(), file);
}

void SetNumber(hid_t object, const std::string& name, double value, const std::string& file) {
  SetAttribute(object, name, H5T_NATIVE_DOUBLE, &value, file);
}

void SetInteger(hid_t object, const std::string& name, std::int64_t value,
                const std::string& file) {
  SetAttribute(object, name, H5T_NATIVE_INT64, &value, file);
}

std::string GetText(hid_t object, const std::string& name, const std::string& file) {
  Handle attribute = OpenAttribute(object, name, file);
  Handle type(H5Aget_type(attribute), H5Tclose, file, "type of attribute '" + name + "'");
  if (H5Tget_class(type) != H5T_STRING) Fail(file, "attribute '" + name + "' is not text; damaged");
  if (H5Tis_variable_str(type) > 0) return ReadVariableText(attribute, type, name, file);
  const std::size_t size = H5Tget_size(type);
  if (size > kLongestText) Fail(file, "attribute '" + name + "' is too long; damaged");
  std::string value(size, '\0');
  Check(H5Aread(attribute, type, value.data()), file, "cannot read attribute '" + name + "'");
  return value.substr(0, value.find('\0'));
}

double GetNumber(hid_t object, const std::string& name, const std::string& file) {
  return GetScalar<double>(object, name, H5T_NATIVE_DOUBLE, file);
}

std::int64_t GetInteger(hid_t object, const std::string& name, const std::string& file) {
  return GetScalar<std::int64_t>(object, name, H5T_NATIVE_INT64, file);
}

}  // namespace prospect::model::hdf5
