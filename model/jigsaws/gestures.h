#pragma once

#include <string>
#include <vector>

namespace prospect::model::jigsaws {

/// The gestures of the JIGSAWS data set (Gao et al. 2014; paper §IV-C): G1 to G15. In data sets and
/// networks, gesture Gk is action k - 1, and kGestures itself is "none yet".
inline constexpr int kGestures = 15;

/// Pictures as the paper makes them of the left camera's 640x480.
inline constexpr int kWidth = 128, kHeight = 96;

/// What gesture `action` (0..14) is in words, such as "push the needle through the tissue".
const char* GestureWords(int action);
/// "G1" to "G15" of actions 0 to 14.
std::string GestureName(int action);

/// The tasks as their folders are called: Suturing, Knot_Tying, Needle_Passing.
const std::vector<std::string>& TaskFolders();
/// How a task is called everywhere else: "suturing", "knot_tying", "needle_passing".
std::string TaskOfFolder(const std::string& folder);
/// Whether `task` is one of those: its actions are gestures and its pictures a video's.
bool IsGestureTask(const std::string& task);

/// Hash of the table of gestures, as data sets and weights hold it.
std::string GestureTableHash();

}  // namespace prospect::model::jigsaws
