#include "model/robomimic/export.h"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/atomic_file.h"
#include "model/dataset.h"
#include "model/demo_io.h"
#include "model/hdf5_io.h"

namespace prospect::model::robomimic {
namespace {

// robomimic knows environments by numbers; 2 is Gym's interface. It asks only to run a policy.
constexpr int kGymInterface = 2;

// Of each frame the action from it to the next; the last has its own.
std::vector<float> OneHot(const Trial& trial) {
  const auto actions = static_cast<std::size_t>(trial.num_actions);
  std::vector<float> rows(trial.actions.size() * actions, 0.0F);
  for (std::size_t i = 0; i < trial.actions.size(); ++i) {
    const int action = trial.actions[std::min(i + 1, trial.actions.size() - 1)];
    if (action < trial.num_actions) rows[i * actions + static_cast<std::size_t>(action)] = 1.0F;
  }
  return rows;
}

// The pictures of a trial, each a frame later.
std::vector<std::uint8_t> Later(const Trial& trial) {
  std::vector<std::uint8_t> images(
      trial.images.begin() + static_cast<std::ptrdiff_t>(trial.frame_bytes()), trial.images.end());
  const std::uint8_t* last = trial.frame(trial.frames() - 1);
  images.insert(images.end(), last, last + trial.frame_bytes());
  return images;
}

void WriteImages(hid_t demo, const char* group, const Trial& trial,
                 const std::vector<std::uint8_t>& images, const std::string& out) {
  const auto frames = static_cast<hsize_t>(trial.frames());
  const hdf5::Handle set = CreateImages(demo, group, trial, frames, frames, out);
  hdf5::Check(H5Dwrite(set, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, images.data()), out,
              "cannot write the images; is the disk full?");
}

void WriteDemonstration(hid_t data, const Trial& trial, bool next_obs, const std::string& out) {
  const hdf5::Handle demo = hdf5::CreateGroup(data, DemoName(trial.seed), out);
  const auto frames = static_cast<hsize_t>(trial.frames());
  hdf5::SetInteger(demo, "num_samples", trial.frames(), out);
  WriteImages(demo, "obs", trial, trial.images, out);
  if (next_obs) WriteImages(demo, "next_obs", trial, Later(trial), out);
  hdf5::Write(demo, "actions", OneHot(trial), {frames, static_cast<hsize_t>(trial.num_actions)},
              out);
  hdf5::Write(demo, "rewards", trial.rewards, {frames}, out);
  hdf5::Write(demo, "dones", trial.dones, {frames}, out);
}

// Pictures that do not get smaller by packing, and what lies around them.
std::uintmax_t MostBytes(const Trial& trial, bool next_obs) {
  constexpr std::uintmax_t kAround = 64 << 10, kEachFrame = 512;
  const auto frames = static_cast<std::uintmax_t>(trial.frames());
  return kAround + frames * (kEachFrame + 4 * static_cast<std::uintmax_t>(trial.num_actions) +
                             trial.frame_bytes() * (next_obs ? 2 : 1));
}

std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

}  // namespace

void Export(const TrialFile& trials, const std::string& out, bool next_obs) {
  if (trials.size() == 0) throw DataError(trials.path() + ": holds no trials");
  base::AtomicFile target(out, base::Rivals::kRefused);
  {
    const hdf5::Handle file = hdf5::CreateFile(target.temporary());
    const hdf5::Handle data = hdf5::CreateGroup(file, "data", out);
    Parts parts;
    std::int64_t frames = 0;
    std::uintmax_t reserved = 1 << 20;
    for (std::size_t i = 0; i < trials.size(); ++i) {
      const Trial trial = trials.Read(i);
      target.Reserve(reserved += MostBytes(trial, next_obs));
      WriteDemonstration(data, trial, next_obs, out);
      parts.emplace(trial.seed, trial.part());
      frames += trial.frames();
    }
    const Trial first = trials.ReadLabels(0);
    const nlohmann::json env = {{"env_name", first.task},
                                {"type", kGymInterface},
                                {"env_kwargs", {{"world_version", first.world_version}}}};
    hdf5::SetInteger(data, "total", frames, out);
    hdf5::SetText(data, "env_args", env.dump(), out);
    WriteMasks(file, parts, out);
    hdf5::Check(H5Fflush(file, H5F_SCOPE_GLOBAL), out, "cannot be written; is the disk full?");
  }
  target.Trim();
  target.Commit();
}

std::string SegmentTable(const TrialFile& trials) {
  std::string table = "demo,start,end,action,succeeded,cause\n";
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const Trial trial = trials.ReadLabels(i);
    const auto& segment = trial.segment;
    for (int s = 0; s < trial.segments(); ++s) {
      const auto first = std::lower_bound(segment.begin(), segment.end(), s);
      const auto next = std::upper_bound(segment.begin(), segment.end(), s);
      const bool succeeded = trial.segment_succeeded[static_cast<std::size_t>(s)] != 0;
      const bool last = s + 1 == trial.segments();
      table += DemoName(trial.seed) + "," + std::to_string(first - segment.begin()) + "," +
               std::to_string(next - segment.begin() - 1) + "," +
               std::to_string(trial.actions[static_cast<std::size_t>(first - segment.begin())]) +
               (succeeded ? ",1," : ",0,") + (last && !succeeded ? Quoted(trial.reason) : "") +
               "\n";
    }
  }
  return table;
}

}  // namespace prospect::model::robomimic
