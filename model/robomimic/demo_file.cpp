#include "model/robomimic/demo_file.h"

#include <algorithm>
#include <map>

#include "model/dataset.h"
#include "model/foreign_file.h"
#include "model/hdf5_io.h"

namespace prospect::model::robomimic {
namespace {

constexpr int kMostPixels = 4096;  // a side

bool Has(hid_t group, const std::string& name) {
  return H5Lexists(group, name.c_str(), H5P_DEFAULT) > 0;
}

// "demo_2" comes before "demo_10".
bool ComesBefore(const std::string& a, const std::string& b) {
  return a.size() != b.size() ? a.size() < b.size() : a < b;
}

std::map<std::string, Split> ReadParts(hid_t file, const std::string& path) {
  std::map<std::string, Split> parts;
  if (!Has(file, "mask")) return parts;
  const hdf5::Handle mask = hdf5::OpenGroup(file, "mask", path);
  for (const Split split : {Split::kTrain, Split::kValid, Split::kTest}) {
    if (!Has(mask, SplitName(split))) continue;
    for (const std::string& demo : hdf5::ReadStrings(mask, SplitName(split), path))
      parts[demo] = split;
  }
  return parts;
}

}  // namespace

struct DemoFile::Impl {
  std::string path, camera;
  hdf5::Handle file, data;
  std::vector<std::string> demos;
  std::map<std::string, Split> parts;

  Impl(const std::string& name, const std::string& wanted)
      : path(name),
        camera(wanted),
        file(hdf5::OpenFile(name)),
        data(hdf5::OpenGroup(file, "data", name)),
        demos(hdf5::LinkNames(data, name)),
        parts(ReadParts(file, name)) {
    if (demos.empty()) throw DataError(path + ": holds no demonstrations");
    std::sort(demos.begin(), demos.end(), ComesBefore);
  }

  hdf5::Handle Pictures(const std::string& demo) const {
    const std::string at = demo + "/obs/" + camera;
    if (!Has(data, demo) || !Has(data, demo + "/obs") || !Has(data, at))
      throw DataError(path + ": " + demo + ": has no pictures '" + camera + "'");
    return hdf5::Handle(H5Dopen2(data, at.c_str(), H5P_DEFAULT), H5Dclose, path,
                        "'" + at + "' is no array of pictures");
  }
};

DemoFile::DemoFile(const std::string& path, const std::string& camera)
    : impl_(std::make_unique<Impl>(path, camera)) {
  Impl& f = *impl_;
  const hdf5::Handle demo = hdf5::OpenGroup(f.data, f.demos.front(), path);
  const std::vector<std::string> cameras = CameraNames(demo, path);
  const bool chosen = std::find(cameras.begin(), cameras.end(), camera) != cameras.end();
  if (chosen) return;
  if (camera.empty() && cameras.size() == 1) {
    f.camera = cameras.front();
    return;
  }
  std::string known;
  for (const std::string& name : cameras) known += (known.empty() ? "" : ", ") + name;
  throw DataError(path + ": " +
                  (cameras.empty() ? "holds no pictures of a camera"
                   : camera.empty()
                       ? "holds several cameras; choose one with --camera: " + known
                       : "has no camera '" + camera + "'; choose one with --camera: " + known));
}

DemoFile::~DemoFile() = default;

const std::vector<std::string>& DemoFile::demos() const { return impl_->demos; }
const std::string& DemoFile::camera() const { return impl_->camera; }

std::optional<Split> DemoFile::part(const std::string& demo) const {
  const auto found = impl_->parts.find(demo);
  return found == impl_->parts.end() ? std::nullopt : std::optional(found->second);
}

DemoFile::Size DemoFile::SizeOf(const std::string& demo) const {
  const Impl& f = *impl_;
  const hdf5::Handle set = f.Pictures(demo);
  const hdf5::Handle space(H5Dget_space(set), H5Sclose, f.path, "image space");
  const hdf5::Handle type(H5Dget_type(set), H5Tclose, f.path, "image type");
  hsize_t dims[4] = {0, 0, 0, 0};
  const bool rank = H5Sget_simple_extent_ndims(space) == 4;
  if (rank) H5Sget_simple_extent_dims(space, dims, nullptr);
  const bool bytes = H5Tget_class(type) == H5T_INTEGER && H5Tget_size(type) == 1;
  if (!rank || !bytes || dims[3] != 3 || dims[1] < 1 || dims[2] < 1 || dims[1] > kMostPixels ||
      dims[2] > kMostPixels || dims[0] > 1 << 22) {
    throw DataError(f.path + ": " + demo + ": '" + f.camera +
                    "' are no pictures of height x width x 3 bytes");
  }
  return {static_cast<int>(dims[0]), static_cast<int>(dims[2]), static_cast<int>(dims[1])};
}

void DemoFile::Read(const std::string& demo, int frame, std::vector<std::uint8_t>* rgb) const {
  const Impl& f = *impl_;
  const Size size = SizeOf(demo);
  const std::string name = f.path + ": " + demo + ": frame " + std::to_string(frame);
  if (frame < 0 || frame >= size.frames) throw DataError(name + " is out of range");
  const hdf5::Handle set = f.Pictures(demo);
  const hdf5::Handle space(H5Dget_space(set), H5Sclose, f.path, "image space");
  const hsize_t start[4] = {static_cast<hsize_t>(frame), 0, 0, 0};
  const hsize_t count[4] = {1, static_cast<hsize_t>(size.height), static_cast<hsize_t>(size.width),
                            3};
  hdf5::Check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr), f.path,
              "cannot select a frame");
  const hdf5::Handle memory(H5Screate_simple(4, count, nullptr), H5Sclose, f.path, "memory space");
  rgb->resize(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) * 3);
  hdf5::Check(H5Dread(set, H5T_NATIVE_UINT8, memory, space, H5P_DEFAULT, rgb->data()), name,
              "cannot be read; damaged");
}

}  // namespace prospect::model::robomimic
