#include "model/foreign_file.h"

#include <algorithm>
#include <vector>

#include "model/hdf5_io.h"

namespace prospect::model {
namespace {

constexpr std::size_t kMostNames = 5;
constexpr std::size_t kMostLetters = 40;  // of a name

bool Has(hid_t group, const char* name) { return H5Lexists(group, name, H5P_DEFAULT) > 0; }

// Names of other people's files may hold anything.
std::string Shown(const std::string& name) {
  std::string text = name.substr(0, kMostLetters);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

std::string Listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i)
    text += (text.empty() ? "" : ", ") + names[i];
  if (names.size() > kMostNames)
    text += " and " + std::to_string(names.size() - kMostNames) + " more";
  return text.empty() ? "nothing" : text;
}

struct Camera {
  std::string name;
  hsize_t width = 0, height = 0;
};

std::vector<Camera> CamerasOf(hid_t demo, const std::string& path) {
  std::vector<Camera> cameras;
  if (!Has(demo, "obs")) return cameras;
  const hdf5::Handle obs = hdf5::OpenGroup(demo, "obs", path);
  for (const std::string& name : hdf5::LinkNames(obs, path)) {
    const hid_t set = H5Dopen2(obs, name.c_str(), H5P_DEFAULT);
    if (set < 0) continue;  // a group, or a link to nothing
    const hdf5::Handle opened(set, H5Dclose, path, name);
    const hdf5::Handle space(H5Dget_space(opened), H5Sclose, path, name);
    hsize_t dims[4] = {0, 0, 0, 0};
    if (H5Sget_simple_extent_ndims(space) != 4) continue;
    H5Sget_simple_extent_dims(space, dims, nullptr);
    if (dims[3] != 1 && dims[3] != 3 && dims[3] != 4) continue;
    cameras.push_back({name, dims[2], dims[1]});
  }
  return cameras;
}

// "agentview_image 84x84" of each.
std::vector<std::string> CameraWords(hid_t demo, const std::string& path) {
  std::vector<std::string> words;
  for (const Camera& camera : CamerasOf(demo, path))
    words.push_back(Shown(camera.name) + " " + std::to_string(camera.width) + "x" +
                    std::to_string(camera.height));
  return words;
}

bool IsOurs(hid_t demo) {
  return H5Aexists(demo, "seed") > 0 || H5Aexists(demo, "task") > 0 ||
         H5Aexists(demo, "outcome") > 0;
}

std::string Demonstrations(std::size_t count, hid_t demo, const std::string& path) {
  const std::vector<std::string> cameras = CameraWords(demo, path);
  return std::to_string(count) + (count == 1 ? " demonstration" : " demonstrations") +
         " in robomimic's layout, " +
         (cameras.empty() ? "without pictures of a camera" : "with the camera " + Listed(cameras)) +
         ", but not what we need beside them: which action each picture belongs to, and how each "
         "trial ended. ./prospect dataset from-robomimic makes a data set of them and of a table "
         "that "
         "says it";
}

}  // namespace

std::vector<std::string> CameraNames(hid_t demo, const std::string& path) {
  std::vector<std::string> names;
  for (const Camera& camera : CamerasOf(demo, path)) names.push_back(camera.name);
  return names;
}

std::string ForeignWords(hid_t file, const std::string& path) {
  if (!Has(file, "data")) {
    std::vector<std::string> names;
    for (const std::string& name : hdf5::LinkNames(file, path))
      names.push_back("'" + Shown(name) + "'");
    return "is an HDF5 file, but no data set of ours: it holds " + Listed(names) +
           ", and no group 'data'; ./prospect collect and ./prospect dataset from-log make data "
           "sets";
  }
  const hdf5::Handle data = hdf5::OpenGroup(file, "data", path);
  const std::vector<std::string> trials = hdf5::LinkNames(data, path);
  if (trials.empty()) return "";
  const hid_t first = H5Gopen2(data, trials.front().c_str(), H5P_DEFAULT);
  if (first < 0) return "";
  const hdf5::Handle demo(first, H5Gclose, path, trials.front());
  if (IsOurs(demo) || (!Has(demo, "obs") && !Has(demo, "actions"))) return "";
  return "holds " + Demonstrations(trials.size(), demo, path);
}

}  // namespace prospect::model
