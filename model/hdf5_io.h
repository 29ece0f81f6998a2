#pragma once

#include <hdf5.h>

#include <cstdint>
#include <string>
#include <vector>

/// A thin layer over libhdf5's C interface for model/dataset.cpp: handles that close themselves,
/// and reads and writes that throw DataError naming the file. Not part of the room's public
/// interface.
namespace prospect::model::hdf5 {

/// Owns one libhdf5 identifier. Movable, not copyable.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  /// Takes `id`; throws DataError("FILE: WHAT ...") if it is negative.
  Handle(hid_t id, Close close, const std::string& file, const std::string& what);
  Handle(Handle&& other) noexcept;
  Handle& operator=(Handle&& other) noexcept;
  ~Handle();
  operator hid_t() const { return id_; }  // NOLINT: used where libhdf5 wants an identifier

 private:
  hid_t id_;
  Close close_;
};

/// Stops libhdf5 from printing its error stack; our exceptions say it instead.
void Quiet();
/// Throws DataError naming `file` and `what` if a libhdf5 call returned an error.
void Check(herr_t status, const std::string& file, const std::string& what);

Handle OpenFile(const std::string& path);
/// Unlocked: for files that their writer has locked. Throws DiskError.
Handle CreateFile(const std::string& path);
/// A file that is built in memory: libhdf5 crashes at exit when it could not write what it holds.
Handle CreateInMemory(const std::string& name);
/// The bytes of a file of CreateInMemory().
std::vector<std::uint8_t> ImageOf(hid_t file, const std::string& name);
Handle CreateGroup(hid_t parent, const std::string& name, const std::string& file);
/// Properties for a new data set: without the time of its making, so that the same trials give the
/// same bytes.
Handle TimelessSet(const std::string& file);
Handle OpenGroup(hid_t parent, const std::string& name, const std::string& file);
/// Names of the links in a group, in the order of names.
std::vector<std::string> LinkNames(hid_t group, const std::string& file);

/// Whole data sets of a native type. Reads check that the number of dimensions is `dims.size()`
/// and, where dims[i] > 0, that extent i equals it; the others are at most 2^22, so that a damaged
/// extent takes no gigabytes.
template <typename T>
void Write(hid_t group, const std::string& name, const std::vector<T>& values,
           const std::vector<hsize_t>& dims, const std::string& file);
template <typename T>
std::vector<T> Read(hid_t group, const std::string& name, const std::vector<hsize_t>& dims,
                    const std::string& file);

void WriteStrings(hid_t group, const std::string& name, const std::vector<std::string>& values,
                  const std::string& file);
/// What WriteStrings() wrote.
std::vector<std::string> ReadStrings(hid_t group, const std::string& name, const std::string& file);

void SetText(hid_t object, const std::string& name, const std::string& value,
             const std::string& file);
void SetNumber(hid_t object, const std::string& name, double value, const std::string& file);
void SetInteger(hid_t object, const std::string& name, std::int64_t value, const std::string& file);
std::string GetText(hid_t object, const std::string& name, const std::string& file);
double GetNumber(hid_t object, const std::string& name, const std::string& file);
std::int64_t GetInteger(hid_t object, const std::string& name, const std::string& file);

}  // namespace prospect::model::hdf5
