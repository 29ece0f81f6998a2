#include "model/demo_io.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "model/dataset.h"

namespace prospect::model {
namespace {

constexpr unsigned kDeflateLevel = 4;

hsize_t Size(int n) { return static_cast<hsize_t>(n); }

void WriteLandmarks(hid_t demo, const Trial& trial, const std::string& file) {
  if (trial.num_landmarks == 0) return;
  hdf5::Handle obs = hdf5::OpenGroup(demo, "obs", file);
  hdf5::Write(obs, kLandmarksName, trial.landmarks,
              {Size(trial.frames()), Size(trial.num_landmarks), 2}, file);
}

void WriteAttributes(hid_t demo, const Trial& trial, const std::string& file) {
  hdf5::SetInteger(demo, "num_samples", trial.frames(), file);
  hdf5::SetInteger(demo, "seed", static_cast<std::int64_t>(trial.seed), file);
  if (!trial.name.empty()) hdf5::SetText(demo, "name", trial.name, file);
  if (!trial.simulated) hdf5::SetInteger(demo, "simulated", 0, file);
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

}  // namespace

std::string DemoName(std::uint64_t seed) { return "demo_" + std::to_string(seed); }

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

hdf5::Handle CreateImages(hid_t demo, const char* group, const Trial& shape, hsize_t frames,
                          hsize_t most, const std::string& file) {
  hdf5::Handle obs = hdf5::CreateGroup(demo, group, file);
  const hsize_t dims[4] = {frames, Size(shape.height), Size(shape.width), 3};
  const hsize_t limits[4] = {most, dims[1], dims[2], 3};
  const hsize_t chunk[4] = {1, dims[1], dims[2], 3};
  hdf5::Handle plist = hdf5::TimelessSet(file);
  hdf5::Check(H5Pset_chunk(plist, 4, chunk), file, "chunks");
  hdf5::Check(H5Pset_deflate(plist, kDeflateLevel), file,
              "deflate is not available in this libhdf5");
  hdf5::Handle space(H5Screate_simple(4, dims, limits), H5Sclose, file, "image space");
  return hdf5::Handle(
      H5Dcreate2(obs, kImageName, H5T_NATIVE_UINT8, space, H5P_DEFAULT, plist, H5P_DEFAULT),
      H5Dclose, file, "cannot create the images");
}

void WriteDemoLabels(hid_t demo, const Trial& trial, const std::string& file) {
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
  WriteLandmarks(demo, trial, file);
}

void WriteDemo(hid_t data, const Trial& trial, const std::string& file) {
  hdf5::Handle demo = hdf5::CreateGroup(data, DemoName(trial.seed), file);
  const hsize_t n = Size(trial.frames());
  hdf5::Handle set = CreateImages(demo, "obs", trial, n, n, file);
  hdf5::Check(H5Dwrite(set, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, trial.images.data()),
              file, "cannot write the images; is the disk full?");
  WriteDemoLabels(demo, trial, file);
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

void WriteMasks(hid_t root, const Parts& parts, const std::string& file) {
  hdf5::Handle mask = hdf5::CreateGroup(root, "mask", file);
  for (const Split split : {Split::kTrain, Split::kValid, Split::kTest}) {
    std::vector<std::string> names;
    for (const auto& [seed, part] : parts) {
      if (part == split) names.push_back(DemoName(seed));
    }
    hdf5::WriteStrings(mask, SplitName(split), names, file);
  }
}

Parts ReadMasks(hid_t root, const std::string& file) {
  Parts parts;
  if (H5Lexists(root, "mask", H5P_DEFAULT) <= 0) return parts;
  hdf5::Handle mask = hdf5::OpenGroup(root, "mask", file);
  for (const Split split : {Split::kTrain, Split::kValid, Split::kTest}) {
    for (const std::string& name : hdf5::ReadStrings(mask, SplitName(split), file)) {
      if (!parts.emplace(SeedOfName(name, file), split).second) {
        throw DataError(file + ": " + name + " is in two masks; damaged");
      }
    }
  }
  return parts;
}

}  // namespace prospect::model
