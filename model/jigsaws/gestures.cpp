#include "model/jigsaws/gestures.h"

#include <algorithm>
#include <array>

#include "base/hash.h"

namespace prospect::model::jigsaws {
namespace {

constexpr std::array<const char*, kGestures> kWords = {
    "reach for the needle with the right hand",
    "position the needle",
    "push the needle through the tissue",
    "hand the needle from left to right",
    "move to the centre with the needle",
    "pull the suture with the left hand",
    "pull the suture with the right hand",
    "orient the needle",
    "tighten the suture with the help of the right hand",
    "loosen more suture",
    "drop the suture and move to the end points",
    "reach for the needle with the left hand",
    "make a C loop around the right hand",
    "reach for the suture with the right hand",
    "pull the suture with both hands",
};

}  // namespace

const char* GestureWords(int action) { return kWords.at(static_cast<std::size_t>(action)); }

std::string GestureName(int action) { return "G" + std::to_string(action + 1); }

const std::vector<std::string>& TaskFolders() {
  static const std::vector<std::string> folders = {"Suturing", "Knot_Tying", "Needle_Passing"};
  return folders;
}

std::string TaskOfFolder(const std::string& folder) {
  std::string task = folder;
  std::transform(task.begin(), task.end(), task.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return task;
}

bool IsGestureTask(const std::string& task) {
  const auto& folders = TaskFolders();
  return std::any_of(folders.begin(), folders.end(),
                     [&](const std::string& folder) { return TaskOfFolder(folder) == task; });
}

std::string GestureTableHash() {
  std::uint64_t hash = base::HashText("gestures-1");
  for (int action = 0; action < kGestures; ++action)
    hash = base::HashText(GestureName(action), hash);
  return base::HexText(hash);
}

}  // namespace prospect::model::jigsaws
