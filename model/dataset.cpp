#include "model/dataset.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "model/hash.h"
#include "model/hdf5_io.h"

namespace prospect::model {
namespace {

namespace fs = std::filesystem;

constexpr const char* kImageName = "agentview_image";
constexpr const char* kLandmarksName = "landmarks";
constexpr unsigned kDeflateLevel = 4;

hsize_t Size(int n) { return static_cast<hsize_t>(n); }

/// A file under a temporary name that takes its real one in Commit(), or is removed.
class AtomicFile {
 public:
  explicit AtomicFile(std::string path)
      : path_(std::move(path)), temporary_(TemporaryName(path_, ::getpid())) {}
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile() { std::remove(temporary_.c_str()); }
  const std::string& temporary() const { return temporary_; }
  void Commit() const {
    if (std::rename(temporary_.c_str(), path_.c_str()) != 0) {
      throw DiskError(path_ +
                      ": cannot be written (rename failed); check the folder's permissions");
    }
  }

  void Write(const std::vector<std::uint8_t>& bytes) const {
    std::ofstream file(temporary_, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file)
      throw DiskError(path_ + ": cannot be written; check the folder and the space on the disk");
  }

  // Takes the disk space of a file that libhdf5 has just created there, because libhdf5 crashes
  // when it gives out under its hands.
  void Reserve(std::uintmax_t bytes) const {
    const int file = ::open(temporary_.c_str(), O_WRONLY | O_CLOEXEC);
    const int taken =
        file < 0 ? -1 : ::fallocate(file, FALLOC_FL_KEEP_SIZE, 0, static_cast<off_t>(bytes));
    const bool full = file < 0 || (taken != 0 && (errno == ENOSPC || errno == EDQUOT));
    if (file >= 0) ::close(file);
    if (!full) return;  // or a file system that cannot reserve
    throw DiskError(path_ + ": needs up to " + std::to_string((bytes >> 20) + 1) +
                    " MB, and the disk is full; make room or choose another disk");
  }

  // Gives back what Reserve() took too much.
  void Trim() const {
    [[maybe_unused]] const int cut =
        ::truncate(temporary_.c_str(), static_cast<off_t>(fs::file_size(temporary_)));
  }

 private:
  std::string path_;
  std::string temporary_;
};

void WriteImages(hid_t demo, const Trial& trial, const std::string& file) {
  hdf5::Handle obs = hdf5::CreateGroup(demo, "obs", file);
  const hsize_t dims[4] = {Size(trial.frames()), Size(trial.height), Size(trial.width), 3};
  const hsize_t chunk[4] = {1, dims[1], dims[2], 3};
  hdf5::Handle plist(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, file, "property list");
  hdf5::Check(H5Pset_chunk(plist, 4, chunk), file, "chunks");
  hdf5::Check(H5Pset_deflate(plist, kDeflateLevel), file,
              "deflate is not available in this libhdf5");
  hdf5::Handle space(H5Screate_simple(4, dims, nullptr), H5Sclose, file, "image space");
  hdf5::Handle set(
      H5Dcreate2(obs, kImageName, H5T_NATIVE_UINT8, space, H5P_DEFAULT, plist, H5P_DEFAULT),
      H5Dclose, file, "cannot create the images");
  hdf5::Check(H5Dwrite(set, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, trial.images.data()),
              file, "cannot write the images; is the disk full?");
}

void WriteLandmarks(hid_t demo, const Trial& trial, const std::string& file) {
  if (trial.num_landmarks == 0) return;
  hdf5::Handle obs = hdf5::OpenGroup(demo, "obs", file);
  hdf5::Write(obs, kLandmarksName, trial.landmarks,
              {Size(trial.frames()), Size(trial.num_landmarks), 2}, file);
}

void WriteAttributes(hid_t demo, const Trial& trial, const std::string& file) {
  hdf5::SetInteger(demo, "num_samples", trial.frames(), file);
  hdf5::SetInteger(demo, "seed", static_cast<std::int64_t>(trial.seed), file);
  hdf5::SetText(demo, "task", trial.task, file);
  hdf5::SetText(demo, "outcome", trial.outcome, file);
  hdf5::SetText(demo, "reason", trial.reason, file);
  hdf5::SetNumber(demo, "tick_seconds", trial.tick_seconds, file);
  hdf5::SetNumber(demo, "image_noise", trial.image_noise, file);
  hdf5::SetNumber(demo, "light", trial.light, file);
  hdf5::SetInteger(demo, "width", trial.width, file);
  hdf5::SetInteger(demo, "height", trial.height, file);
  hdf5::SetInteger(demo, "num_actions", trial.num_actions, file);
  hdf5::SetInteger(demo, "plan_length", trial.plan_length, file);
  hdf5::SetInteger(demo, "num_landmarks", trial.num_landmarks, file);
  hdf5::SetText(demo, "world_version", trial.world_version, file);
  hdf5::SetText(demo, "task_hash", trial.task_hash, file);
}

std::string DemoName(std::uint64_t seed) { return "demo_" + std::to_string(seed); }

void WriteDemo(hid_t data, const Trial& trial, const std::string& file) {
  hdf5::Handle demo = hdf5::CreateGroup(data, DemoName(trial.seed), file);
  const hsize_t n = Size(trial.frames());
  WriteAttributes(demo, trial, file);
  hdf5::Write(demo, "actions", trial.actions, {n, 1}, file);
  hdf5::Write(demo, "prev_action", trial.prev_action, {n}, file);
  hdf5::Write(demo, "segment", trial.segment, {n}, file);
  hdf5::Write(demo, "rewards", trial.rewards, {n}, file);
  hdf5::Write(demo, "dones", trial.dones, {n}, file);
  hdf5::Write(demo, "present", trial.present, {trial.present.size()}, file);
  hdf5::Write(demo, "segment_succeeded", trial.segment_succeeded, {trial.segment_succeeded.size()},
              file);
  WriteImages(demo, trial, file);
  WriteLandmarks(demo, trial, file);
}

void WriteDataAttributes(hid_t data, const Trial& sample, std::int64_t frames,
                         const std::string& file) {
  hdf5::SetInteger(data, "total", frames, file);
  const nlohmann::json env = {
      {"env_name", sample.task},
      {"type", "prospect"},
      {"env_kwargs", {{"world_version", sample.world_version}, {"successors", sample.successors}}}};
  hdf5::SetText(data, "env_args", env.dump(), file);
}

void WriteMasks(hid_t root, const std::vector<std::uint64_t>& seeds, const std::string& file) {
  hdf5::Handle mask = hdf5::CreateGroup(root, "mask", file);
  for (const Split split : {Split::kTrain, Split::kValid, Split::kTest}) {
    std::vector<std::string> names;
    for (const std::uint64_t seed : seeds) {
      if (SplitOf(seed) == split) names.push_back(DemoName(seed));
    }
    hdf5::WriteStrings(mask, SplitName(split), names, file);
  }
}

std::uint64_t SeedOfName(const std::string& name, const std::string& file) {
  const std::string prefix = "demo_";
  const std::string digits =
      name.substr(0, prefix.size()) == prefix ? name.substr(prefix.size()) : "";
  if (digits.empty() || digits.size() > 9 ||
      digits.find_first_not_of("0123456789") != std::string::npos) {
    throw DataError(file + ": 'data/" + name + "' is not named demo_SEED; not a data set of ours");
  }
  return std::stoull(digits);
}

void ReadAttributes(hid_t demo, const std::string& file, Trial* trial) {
  trial->seed = static_cast<std::uint64_t>(hdf5::GetInteger(demo, "seed", file));
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

std::map<std::uint64_t, std::string> PartsBySeed(const std::vector<std::string>& parts) {
  std::map<std::uint64_t, std::string> by_seed;
  for (const std::string& part : parts) {
    const TrialFile file(part);
    for (const std::uint64_t seed : file.seeds()) {
      if (seed > kLastCollectionSeed) {
        throw DataError(part + ": seed " + std::to_string(seed) +
                        " is kept for tuning or evaluation; data sets take 0 to 999,999");
      }
      if (!by_seed.emplace(seed, part).second) {
        throw DataError(part + ": seed " + std::to_string(seed) + " is also in " + by_seed[seed] +
                        "; give each trial once");
      }
    }
  }
  return by_seed;
}

std::map<std::uint64_t, std::string> Chosen(const std::map<std::uint64_t, std::string>& by_seed,
                                            const PackChoice& choice) {
  std::map<std::uint64_t, std::string> chosen;
  for (const auto& trial : by_seed) {
    if (chosen.size() == choice.most) break;
    if (!choice.split || SplitOf(trial.first) == *choice.split) chosen.insert(trial);
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

struct TrialFile::Impl {
  std::string path;
  hdf5::Handle file;
  hdf5::Handle data;
  std::vector<std::uint64_t> seeds;

  explicit Impl(const std::string& name)
      : path(name), file(hdf5::OpenFile(name)), data(hdf5::OpenGroup(file, "data", name)) {
    for (const std::string& link : hdf5::LinkNames(data, path)) {
      seeds.push_back(SeedOfName(link, path));
    }
    std::sort(seeds.begin(), seeds.end());
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

Trial TrialFile::ReadLabels(std::size_t i) const {
  return ReadDemoLabels(impl_->data, impl_->seeds.at(i), impl_->path);
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
  std::uint64_t hash = HashText("prospect-data-1");
  const auto add = [&hash](const auto& values) {
    hash = HashBytes(values.data(), values.size() * sizeof(values[0]), hash);
  };
  for (std::size_t i = 0; i < size(); ++i) {
    const Trial trial = ReadLabels(i);
    const std::string text = std::to_string(trial.seed) + "/" + trial.task + "/" + trial.outcome +
                             "/" + trial.world_version + "/" + trial.task_hash + "/" +
                             std::to_string(trial.width) + "x" + std::to_string(trial.height);
    add(text);
    add(trial.actions);
    add(trial.segment);
    add(trial.present);
    add(trial.segment_succeeded);
  }
  return HexText(hash);
}

void WriteTrialFile(const std::string& path, const Trial& trial) {
  ValidateTrial(trial);
  const AtomicFile target(path);
  {
    hdf5::Handle file = hdf5::CreateInMemory(path);
    hdf5::Handle data = hdf5::CreateGroup(file, "data", path);
    WriteDemo(data, trial, path);
    WriteDataAttributes(data, trial, trial.frames(), path);
    WriteMasks(file, {trial.seed}, path);
    target.Write(hdf5::ImageOf(file, path));
  }
  target.Commit();
}

namespace {

// About what a data set of these trials needs, and no less if they are all of their files.
std::uintmax_t PackedBytes(const std::map<std::uint64_t, std::string>& by_seed) {
  constexpr std::uintmax_t kOnce = 1 << 20, kEach = 256;  // masks, and names in the tree
  std::map<std::string, std::size_t> trials;
  for (const auto& [seed, part] : by_seed) ++trials[part];
  std::uintmax_t bytes = kOnce + kEach * by_seed.size();
  for (const auto& [part, count] : trials) {
    bytes += fs::file_size(part) * count / TrialFile(part).size();
  }
  return bytes;
}

}  // namespace

std::string TemporaryName(const std::string& path, int pid) {
  return path + ".tmp" + std::to_string(pid);
}

std::size_t PackTrialFiles(const std::vector<std::string>& parts, const std::string& out,
                           const PackChoice& choice) {
  const std::map<std::uint64_t, std::string> by_seed = Chosen(PartsBySeed(parts), choice);
  const AtomicFile target(out);
  {
    hdf5::Handle file = hdf5::CreateFile(target.temporary());
    target.Reserve(PackedBytes(by_seed));
    hdf5::Handle data = hdf5::CreateGroup(file, "data", out);
    Packer packer(data, out);
    std::vector<std::uint64_t> seeds;
    for (const auto& [seed, part] : by_seed) {
      packer.Copy(seed, part);
      seeds.push_back(seed);
    }
    const auto& [first_seed, first_part] = *by_seed.begin();
    hdf5::Handle source = hdf5::OpenFile(first_part);
    hdf5::Handle source_data = hdf5::OpenGroup(source, "data", first_part);
    WriteDataAttributes(data, ReadDemoLabels(source_data, first_seed, first_part), packer.frames(),
                        out);
    WriteMasks(file, seeds, out);
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
  switch (SplitOf(trial.seed)) {
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
