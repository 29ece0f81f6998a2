#include "model/trial_set_writer.h"

#include <filesystem>
#include <optional>

#include "base/atomic_file.h"
#include "model/dataset.h"
#include "model/demo_io.h"

namespace prospect::model {

struct TrialSetWriter::Impl {
  std::string path;
  base::AtomicFile target;
  std::optional<hdf5::Handle> file, data;  // closed before the file takes its name
  std::optional<hdf5::Handle> demo, images;
  Trial shape;
  int frames = 0, most_frames = 0;
  std::optional<Trial> first;  // without labels of frames
  std::int64_t all_frames = 0;
  Parts parts;

  explicit Impl(const std::string& name) : path(name), target(name, base::Rivals::kRefused) {
    file.emplace(hdf5::CreateFile(target.temporary()));
    data.emplace(hdf5::CreateGroup(*file, "data", path));
  }

  // Pictures that do not get smaller by packing, and what lies around them.
  void ReserveTrial() const {
    constexpr std::uintmax_t kAround = 1 << 20, kEachFrame = 256;
    hdf5::Check(H5Fflush(*file, H5F_SCOPE_GLOBAL), path, "cannot be written; is the disk full?");
    target.Reserve(std::filesystem::file_size(target.temporary()) + kAround +
                   static_cast<std::uintmax_t>(most_frames) * (shape.frame_bytes() + kEachFrame));
  }

  void RequireSameKind(const Trial& labels) {
    if (!first) {
      first = labels;
      first->actions.clear();
      return;
    }
    if (labels.task == first->task && labels.task_hash == first->task_hash &&
        labels.width == first->width && labels.height == first->height &&
        labels.num_actions == first->num_actions) {
      return;
    }
    throw DataError(path + ": trial of seed " + std::to_string(labels.seed) +
                    ": another task, action table or image size than the other trials");
  }
};

TrialSetWriter::TrialSetWriter(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}
TrialSetWriter::~TrialSetWriter() = default;

void TrialSetWriter::Begin(const Trial& shape, int most_frames) {
  Impl& w = *impl_;
  if (w.parts.contains(shape.seed)) {
    throw DataError(w.path + ": seed " + std::to_string(shape.seed) + " comes twice");
  }
  w.shape = Trial();
  w.shape.seed = shape.seed;
  w.shape.width = shape.width;
  w.shape.height = shape.height;
  w.frames = 0;
  w.most_frames = most_frames;
  w.ReserveTrial();
  w.demo.emplace(hdf5::CreateGroup(*w.data, DemoName(shape.seed), w.path));
  w.images.emplace(CreateImages(*w.demo, "obs", w.shape, 0, H5S_UNLIMITED, w.path));
}

void TrialSetWriter::AddFrame(const std::uint8_t* rgb) {
  Impl& w = *impl_;
  if (w.frames >= w.most_frames) {
    throw DataError(w.path + ": trial of seed " + std::to_string(w.shape.seed) +
                    " has more frames than it was begun for");
  }
  const auto at = static_cast<hsize_t>(w.frames++);
  const auto height = static_cast<hsize_t>(w.shape.height);
  const auto width = static_cast<hsize_t>(w.shape.width);
  const hsize_t extent[4] = {at + 1, height, width, 3};
  const hsize_t start[4] = {at, 0, 0, 0};
  const hsize_t count[4] = {1, height, width, 3};
  hdf5::Check(H5Dset_extent(*w.images, extent), w.path, "cannot be extended; is the disk full?");
  hdf5::Handle space(H5Dget_space(*w.images), H5Sclose, w.path, "image space");
  hdf5::Check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr), w.path,
              "cannot select a frame");
  hdf5::Handle memory(H5Screate_simple(4, count, nullptr), H5Sclose, w.path, "memory space");
  hdf5::Check(H5Dwrite(*w.images, H5T_NATIVE_UINT8, memory, space, H5P_DEFAULT, rgb), w.path,
              "cannot write a picture; is the disk full?");
}

void TrialSetWriter::End(const Trial& labels) {
  Impl& w = *impl_;
  ValidateTrial(labels, /*with_images=*/false);
  if (labels.frames() != w.frames || labels.seed != w.shape.seed) {
    throw DataError(w.path + ": trial of seed " + std::to_string(w.shape.seed) +
                    ": its labels are not of the pictures that were added");
  }
  w.RequireSameKind(labels);
  WriteDemoLabels(*w.demo, labels, w.path);
  w.images.reset();
  w.demo.reset();
  w.all_frames += w.frames;
  w.parts.emplace(labels.seed, labels.part());
}

void TrialSetWriter::Drop() {
  Impl& w = *impl_;
  if (!w.demo) return;
  w.images.reset();
  w.demo.reset();
  hdf5::Check(H5Ldelete(*w.data, DemoName(w.shape.seed).c_str(), H5P_DEFAULT), w.path,
              "cannot take a trial out again");
}

std::size_t TrialSetWriter::size() const { return impl_->parts.size(); }

void TrialSetWriter::Commit(const std::map<std::uint64_t, Split>& parts) {
  Impl& w = *impl_;
  Drop();
  if (!w.first) throw DataError(w.path + ": no trial to write");
  for (auto& [seed, part] : w.parts) {
    const auto said = parts.find(seed);
    if (said != parts.end()) part = said->second;
  }
  WriteDataAttributes(*w.data, *w.first, w.all_frames, w.path);
  WriteMasks(*w.file, w.parts, w.path);
  hdf5::Check(H5Fflush(*w.file, H5F_SCOPE_GLOBAL), w.path, "cannot be written; is the disk full?");
  w.data.reset();
  w.file.reset();
  w.target.Trim();
  w.target.Commit();
}

}  // namespace prospect::model
