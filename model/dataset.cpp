#include "model/dataset.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/atomic_file.h"
#include "base/hash.h"
#include "model/demo_io.h"
#include "model/foreign_file.h"
#include "model/hdf5_io.h"

namespace prospect::model {
namespace {

namespace fs = std::filesystem;

constexpr char kShardName[] = "shard";

hsize_t Size(int n) { return static_cast<hsize_t>(n); }

void ReadAttributes(hid_t demo, const std::string& file, Trial* trial) {
  trial->seed = static_cast<std::uint64_t>(hdf5::GetInteger(demo, "seed", file));
  if (H5Aexists(demo, "name") > 0) trial->name = hdf5::GetText(demo, "name", file);
  if (H5Aexists(demo, "simulated") > 0)
    trial->simulated = hdf5::GetInteger(demo, "simulated", file) != 0;
  trial->task = hdf5::GetText(demo, "task", file);
  trial->outcome = hdf5::GetText(demo, "outcome", file);
  trial->reason = hdf5::GetText(demo, "reason", file);
  trial->tick_seconds = hdf5::GetNumber(demo, "tick_seconds", file);
  trial->image_noise = hdf5::GetNumber(demo, "image_noise", file);
  trial->light = hdf5::GetNumber(demo, "light", file);
  trial->width = static_cast<int>(hdf5::GetInteger(demo, "width", file));
  trial->height = static_cast<int>(hdf5::GetInteger(demo, "height", file));
  trial->num_actions = static_cast<int>(hdf5::GetInteger(demo, "num_actions", file));
  trial->num_landmarks = static_cast<int>(hdf5::GetInteger(demo, "num_landmarks", file));
  trial->plan_length = static_cast<int>(hdf5::GetInteger(demo, "plan_length", file));
  trial->world_version = hdf5::GetText(demo, "world_version", file);
  trial->task_hash = hdf5::GetText(demo, "task_hash", file);
}

void ReadVectors(hid_t demo, const std::string& file, Trial* trial) {
  trial->actions = hdf5::Read<int>(demo, "actions", {0, 1}, file);
  trial->prev_action = hdf5::Read<int>(demo, "prev_action", {0}, file);
  trial->segment = hdf5::Read<int>(demo, "segment", {0}, file);
  trial->rewards = hdf5::Read<float>(demo, "rewards", {0}, file);
  trial->dones = hdf5::Read<std::uint8_t>(demo, "dones", {0}, file);
  trial->present = hdf5::Read<int>(demo, "present", {0}, file);
  trial->segment_succeeded = hdf5::Read<std::int8_t>(demo, "segment_succeeded", {0}, file);
  if (trial->num_landmarks > 0) {
    trial->landmarks =
        hdf5::Read<float>(demo, std::string("obs/") + kLandmarksName,
                          {Size(trial->frames()), Size(trial->num_landmarks), 2}, file);
  }
}

std::vector<std::vector<int>> ReadSuccessors(hid_t data, const std::string& file) {
  const auto env = nlohmann::json::parse(hdf5::GetText(data, "env_args", file), nullptr, false);
  try {
    const nlohmann::json kwargs = env.value("env_kwargs", nlohmann::json::object());
    return kwargs.value("successors", std::vector<std::vector<int>>());
  } catch (const nlohmann::json::exception&) {
    throw DataError(file + ": attribute 'env_args' is not what we write; damaged");
  }
}

Trial ReadDemoLabels(hid_t data, std::uint64_t seed, const std::string& file) {
  hdf5::Handle demo = hdf5::OpenGroup(data, DemoName(seed), file);
  Trial trial;
  ReadAttributes(demo, file, &trial);
  ReadVectors(demo, file, &trial);
  trial.successors = ReadSuccessors(data, file);
  try {
    ValidateTrial(trial, /*with_images=*/false);
  } catch (const DataError& error) {
    throw DataError(file + ": " + error.what());
  }
  if (trial.seed != seed) throw DataError(file + ": a trial's seed and name differ; damaged");
  return trial;
}

/// What all trials of one data set must share.
struct Kind {
  std::string task, task_hash;
  std::int64_t width = 0, height = 0, num_actions = 0;
  bool operator==(const Kind& o) const {
    return task == o.task && task_hash == o.task_hash && width == o.width && height == o.height &&
           num_actions == o.num_actions;
  }
};

Kind KindOf(hid_t demo, const std::string& file) {
  return {hdf5::GetText(demo, "task", file), hdf5::GetText(demo, "task_hash", file),
          hdf5::GetInteger(demo, "width", file), hdf5::GetInteger(demo, "height", file),
          hdf5::GetInteger(demo, "num_actions", file)};
}

/// Where a trial that is to be packed lies, and its part.
struct Source {
  std::string file;
  Split part = Split::kTrain;
};
using Sources = std::map<std::uint64_t, Source>;

Sources SourcesBySeed(const std::vector<std::string>& files) {
  Sources by_seed;
  for (const std::string& name : files) {
    const TrialFile file(name);
    for (std::size_t i = 0; i < file.size(); ++i) {
      const std::uint64_t seed = file.seeds()[i];
      if (seed > kLastCollectionSeed && file.ReadLabels(i).simulated) {
        throw DataError(name + ": seed " + std::to_string(seed) +
                        " is kept for tuning or evaluation; data sets take 0 to 999,999");
      }
      if (!by_seed.emplace(seed, Source{name, file.part(i)}).second) {
        throw DataError(name + ": seed " + std::to_string(seed) + " is also in " +
                        by_seed[seed].file + "; give each trial once");
      }
    }
  }
  return by_seed;
}

Sources Chosen(const Sources& by_seed, const PackChoice& choice) {
  Sources chosen;
  for (const auto& trial : by_seed) {
    if (chosen.size() == choice.most) break;
    if (!choice.split || trial.second.part == *choice.split) chosen.insert(trial);
  }
  if (chosen.empty()) {
    throw DataError(by_seed.empty() ? "nothing to pack: no trials were given"
                                    : "nothing to pack: none of the trials is of the chosen part");
  }
  return chosen;
}

/// Copies trials of parts into one open file, part files opened once in a row.
class Packer {
 public:
  Packer(hid_t data, std::string out) : data_(data), out_(std::move(out)) {}

  void Copy(std::uint64_t seed, const std::string& part) {
    hdf5::Handle file = hdf5::OpenFile(part);
    hdf5::Handle source = hdf5::OpenGroup(file, "data", part);
    const std::string name = DemoName(seed);
    hdf5::Handle demo = hdf5::OpenGroup(source, name, part);
    const Kind kind = KindOf(demo, part);
    if (copied_ == 0) kind_ = kind;
    if (!(kind == kind_)) {
      throw DataError(part + ": another task, action table or image size than the other trials");
    }
    ReadDemoLabels(source, seed, part);  // libhdf5 may crash when it copies what is damaged
    frames_ += hdf5::GetInteger(demo, "num_samples", part);
    hdf5::Check(H5Ocopy(source, name.c_str(), data_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT), part,
                "cannot be copied into " + out_ + "; damaged, or the disk is full");
    ++copied_;
  }
  std::int64_t frames() const { return frames_; }

 private:
  hid_t data_;
  std::string out_;
  Kind kind_;
  std::int64_t frames_ = 0;
  std::size_t copied_ = 0;
};

/// Throws unless images are [N,height,width,3] as the trial's attributes say; returns N.
hsize_t RequireImageShape(hid_t space, const Kind& kind, const std::string& trial) {
  hsize_t dims[4] = {0, 0, 0, 0};
  const bool rank = H5Sget_simple_extent_ndims(space) == 4;
  if (rank) H5Sget_simple_extent_dims(space, dims, nullptr);
  if (!rank || dims[1] != static_cast<hsize_t>(kind.height) ||
      dims[2] != static_cast<hsize_t>(kind.width) || dims[3] != 3) {
    throw DataError(trial + ": its images have another shape than its labels say; damaged");
  }
  return dims[0];
}

void SelectFrame(hid_t space, int frame, const Trial& trial, const std::string& file) {
  const hsize_t start[4] = {Size(frame), 0, 0, 0};
  const hsize_t count[4] = {1, Size(trial.height), Size(trial.width), 3};
  hdf5::Check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr), file,
              "cannot select a frame");
}

}  // namespace

namespace {

hdf5::Handle OpenOurs(const std::string& path) {
  hdf5::Handle file = hdf5::OpenFile(path);
  const std::string foreign = ForeignWords(file, path);
  if (!foreign.empty()) throw DataError(path + ": " + foreign);
  return file;
}

}  // namespace

struct TrialFile::Impl {
  std::string path;
  hdf5::Handle file;
  hdf5::Handle data;
  std::vector<std::uint64_t> seeds;
  Parts parts;  // what the masks say

  explicit Impl(const std::string& name)
      : path(name), file(OpenOurs(name)), data(hdf5::OpenGroup(file, "data", name)) {
    for (const std::string& link : hdf5::LinkNames(data, path)) {
      seeds.push_back(SeedOfName(link, path));
    }
    std::sort(seeds.begin(), seeds.end());
    parts = ReadMasks(file, path);
  }

  hdf5::Handle OpenImages(std::uint64_t seed) const {
    const std::string name = DemoName(seed) + "/obs/" + kImageName;
    return hdf5::Handle(H5Dopen2(data, name.c_str(), H5P_DEFAULT), H5Dclose, path,
                        "'" + name + "' is missing; not a data set of ours, or damaged");
  }
};

TrialFile::TrialFile(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}
TrialFile::~TrialFile() = default;
TrialFile::TrialFile(TrialFile&&) noexcept = default;
TrialFile& TrialFile::operator=(TrialFile&&) noexcept = default;
const std::string& TrialFile::path() const { return impl_->path; }
std::size_t TrialFile::size() const { return impl_->seeds.size(); }
const std::vector<std::uint64_t>& TrialFile::seeds() const { return impl_->seeds; }

std::string TrialFile::shard() const {
  if (H5Aexists(impl_->file, kShardName) <= 0) return "";
  return hdf5::GetText(impl_->file, kShardName, impl_->path);
}

Split TrialFile::part(std::size_t i) const {
  const std::uint64_t seed = impl_->seeds.at(i);
  const auto said = impl_->parts.find(seed);
  return said == impl_->parts.end() ? SplitOf(seed) : said->second;
}

Trial TrialFile::ReadLabels(std::size_t i) const {
  Trial trial = ReadDemoLabels(impl_->data, impl_->seeds.at(i), impl_->path);
  trial.split = part(i);
  return trial;
}

Trial TrialFile::Read(std::size_t i) const {
  Trial trial = ReadLabels(i);
  hdf5::Handle demo = hdf5::OpenGroup(impl_->data, DemoName(trial.seed), impl_->path);
  trial.images = hdf5::Read<std::uint8_t>(
      demo, std::string("obs/") + kImageName,
      {Size(trial.frames()), Size(trial.height), Size(trial.width), 3}, impl_->path);
  return trial;
}

void TrialFile::ReadFrames(std::size_t i, const std::vector<int>& frames, std::uint8_t* out) const {
  const std::uint64_t seed = impl_->seeds.at(i);
  const std::string trial = impl_->path + ": trial of seed " + std::to_string(seed);
  hdf5::Handle demo = hdf5::OpenGroup(impl_->data, DemoName(seed), impl_->path);
  const Kind kind = KindOf(demo, impl_->path);
  hdf5::Handle set = impl_->OpenImages(seed);
  hdf5::Handle space(H5Dget_space(set), H5Sclose, impl_->path, "image space");
  const hsize_t recorded = RequireImageShape(space, kind, trial);
  Trial shape;
  shape.height = static_cast<int>(kind.height);
  shape.width = static_cast<int>(kind.width);
  const hsize_t size = shape.frame_bytes();
  hdf5::Handle memory(H5Screate_simple(1, &size, nullptr), H5Sclose, impl_->path, "memory space");
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const std::string frame = "frame " + std::to_string(frames[k]);
    if (frames[k] < 0 || Size(frames[k]) >= recorded) {
      throw DataError(trial + ": " + frame + " is out of range");
    }
    SelectFrame(space, frames[k], shape, impl_->path);
    hdf5::Check(H5Dread(set, H5T_NATIVE_UINT8, memory, space, H5P_DEFAULT, out + k * size), trial,
                frame + " cannot be read; damaged: leave this trial out");
  }
}

std::string TrialFile::ContentHash() const {
  std::uint64_t hash = base::HashText("prospect-data-1");
  const auto add = [&hash](const auto& values) {
    hash = base::HashBytes(values.data(), values.size() * sizeof(values[0]), hash);
  };
  for (std::size_t i = 0; i < size(); ++i) {
    const Trial trial = ReadLabels(i);
    const std::string text = std::to_string(trial.seed) + "/" + trial.task + "/" + trial.outcome +
                             "/" + trial.world_version + "/" + trial.task_hash + "/" +
                             std::to_string(trial.width) + "x" + std::to_string(trial.height);
    add(text);
    if (trial.part() != SplitOf(trial.seed)) add(std::string(SplitName(trial.part())));
    add(trial.actions);
    add(trial.segment);
    add(trial.present);
    add(trial.segment_succeeded);
  }
  return base::HexText(hash);
}

std::string TrialFile::PicturesHash() const {
  constexpr std::size_t kTrials = 64;
  std::uint64_t hash = base::HashText("prospect-pictures-1");
  for (std::size_t i = 0; i < size(); i += 1 + size() / kTrials) {
    const Trial labels = ReadLabels(i);
    if (labels.segment.empty()) continue;
    std::vector<std::uint8_t> frame(static_cast<std::size_t>(labels.width * labels.height * 3));
    ReadFrames(i, {0}, frame.data());
    hash = base::HashBytes(frame.data(), frame.size(), hash);
  }
  return base::HexText(hash);
}

void WriteTrialFile(const std::string& path, const Trial& trial) {
  ValidateTrial(trial);
  base::AtomicFile target(path);
  {
    hdf5::Handle file = hdf5::CreateInMemory(path);
    hdf5::Handle data = hdf5::CreateGroup(file, "data", path);
    WriteDemo(data, trial, path);
    WriteDataAttributes(data, trial, trial.frames(), path);
    WriteMasks(file, {{trial.seed, trial.part()}}, path);
    const std::vector<std::uint8_t> image = hdf5::ImageOf(file, path);
    target.Write({reinterpret_cast<const char*>(image.data()), image.size()});
  }
  target.Commit();
}

namespace {

// About what a data set of these trials needs, and no less if they are all of their files.
std::uintmax_t PackedBytes(const Sources& by_seed) {
  constexpr std::uintmax_t kOnce = 1 << 20, kEach = 256;  // masks, and names in the tree
  std::map<std::string, std::size_t> trials;
  for (const auto& [seed, source] : by_seed) ++trials[source.file];
  std::uintmax_t bytes = kOnce + kEach * by_seed.size();
  for (const auto& [file, count] : trials) {
    bytes += fs::file_size(file) * count / TrialFile(file).size();
  }
  return bytes;
}

}  // namespace

std::size_t PackTrialFiles(const std::vector<std::string>& parts, const std::string& out,
                           const PackChoice& choice) {
  const Sources by_seed = Chosen(SourcesBySeed(parts), choice);
  base::AtomicFile target(out, base::Rivals::kRefused);
  {
    hdf5::Handle file = hdf5::CreateFile(target.temporary());
    target.Reserve(PackedBytes(by_seed));
    hdf5::Handle data = hdf5::CreateGroup(file, "data", out);
    Packer packer(data, out);
    Parts masks;
    for (const auto& [seed, source] : by_seed) {
      packer.Copy(seed, source.file);
      masks.emplace(seed, source.part);
    }
    const std::uint64_t first_seed = by_seed.begin()->first;
    const std::string& first_file = by_seed.begin()->second.file;
    hdf5::Handle source = hdf5::OpenFile(first_file);
    hdf5::Handle source_data = hdf5::OpenGroup(source, "data", first_file);
    WriteDataAttributes(data, ReadDemoLabels(source_data, first_seed, first_file), packer.frames(),
                        out);
    WriteMasks(file, masks, out);
    if (!choice.shard.empty()) hdf5::SetText(file, kShardName, choice.shard, out);
    hdf5::Check(H5Fflush(file, H5F_SCOPE_GLOBAL), out, "cannot be written; is the disk full?");
  }
  target.Trim();
  target.Commit();
  return by_seed.size();
}

bool IsWholeTrialFile(const std::string& path) {
  try {
    const TrialFile file(path);
    return file.size() > 0;
  } catch (const DataError&) {
    return false;
  }
}

namespace {

void Count(const Trial& trial, std::map<std::string, std::size_t>* causes,
           DataSetSummary* summary) {
  ++summary->trials;
  summary->frames += trial.actions.size();
  summary->segments += trial.segment_succeeded.size();
  for (const std::int8_t ok : trial.segment_succeeded) summary->segments_succeeded += ok > 0;
  if (trial.succeeded()) {
    ++summary->successes;
  } else {
    ++(*causes)[trial.reason];
  }
  switch (trial.part()) {
    case Split::kTrain:
      ++summary->train;
      break;
    case Split::kValid:
      ++summary->valid;
      break;
    case Split::kTest:
      ++summary->test;
      break;
  }
}

}  // namespace

DataSetSummary Summarize(const TrialFile& file) {
  DataSetSummary summary;
  summary.shard = file.shard();
  std::map<std::string, std::size_t> causes;
  for (std::size_t i = 0; i < file.size(); ++i) {
    const Trial trial = file.ReadLabels(i);
    Count(trial, &causes, &summary);
    summary.task = trial.task;
    summary.world_version = trial.world_version;
    summary.width = trial.width;
    summary.height = trial.height;
    summary.num_actions = trial.num_actions;
  }
  summary.failures.assign(causes.begin(), causes.end());
  std::stable_sort(summary.failures.begin(), summary.failures.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  return summary;
}

}  // namespace prospect::model
