#include "services/predict/picture_question.h"

#include <algorithm>

#include "cli/installation.h"
#include "services/common/ids.h"

namespace prospect::services {
namespace {

constexpr std::int64_t kReadyMs = 10000;
constexpr std::int64_t kFirstImage = 1, kPresentImage = 2;

search_root_t RootOf(Conversation& talk, const model_info_t& server,
                     const PictureQuestion& question) {
  const task_t& task = *talk.view().task();
  search_root_t root{};
  root.executive_id = talk.id();
  root.search_id = RandomId();
  root.weights_hash = server.weights_hash;
  root.task_hash = task.task_hash;
  root.task = task.name;
  root.episode_id = question.present.episode_id;
  root.image0_id = kFirstImage;
  root.image_id = kPresentImage;
  root.executed = question.executed;
  root.num_executed = static_cast<std::int32_t>(root.executed.size());
  root.plan_length = task.plan_length;
  root.time_left = -1;
  root.rule = "paper";
  root.depth = 1;
  for (const auto& path : question.paths) {
    root.depth = std::max(root.depth, static_cast<std::int32_t>(path.size()));
  }
  root.samples = 1;
  root.leaves = 1;
  root.budget_ms = 0;
  root.sharing = 1;
  return root;
}

search_image_t ImageOf(const search_root_t& root, const observation_t& seen, std::int64_t id) {
  search_image_t image{};
  image.executive_id = root.executive_id;
  image.search_id = root.search_id;
  image.image_id = id;
  image.encoding = seen.encoding;
  image.width = seen.width;
  image.height = seen.height;
  image.num_bytes = seen.num_bytes;
  image.data = seen.data;
  return image;
}

bool ServerReady(Conversation& talk, const search_root_t& root) {
  const auto live = talk.view().servers().Live(root.weights_hash, SteadyMs());
  return std::any_of(live.begin(), live.end(), [&](const model_info_t& info) {
    return info.search_id == root.search_id && info.epoch == root.epoch;
  });
}

void End(Conversation& talk, const search_root_t& root) {
  search_stop_t stop{};
  stop.executive_id = root.executive_id;
  stop.search_id = root.search_id;
  stop.epoch = root.epoch;
  stop.reason = "pictures fetched";
  talk.Say(stop);
}

/// Goes on as long as pictures come: a server on a busy machine paints one in half a second.
std::map<planner::Path, agent::Picture> FetchAll(PredictionInbox* inbox, const search_root_t& root,
                                                 const std::vector<planner::Path>& paths) {
  std::map<planner::Path, agent::Picture> pictures;
  std::vector<planner::Path> missing = paths;
  for (bool some = true; some && !missing.empty();) {
    auto come = inbox->Fetch(root, missing);
    some = !come.empty();
    pictures.merge(come);
    std::erase_if(missing, [&](const planner::Path& path) { return pictures.contains(path); });
  }
  return pictures;
}

}  // namespace

std::map<planner::Path, agent::Picture> AskForPictures(Conversation& talk, PredictionInbox* inbox,
                                                       const model_info_t& server,
                                                       const PictureQuestion& question) {
  const search_root_t root = RootOf(talk, server, question);
  const auto announce = [&] {
    talk.Say(root);
    talk.Say(ImageOf(root, question.first, kFirstImage));
    talk.Say(ImageOf(root, question.present, kPresentImage));
  };
  if (!talk.Until([&] { return ServerReady(talk, root); }, kReadyMs, announce)) {
    throw ExitError(
        kExitServiceLost,
        "no model server took the pictures within 10 s; see its log, or " + cli::Typed("up"));
  }
  auto pictures = FetchAll(inbox, root, question.paths);
  End(talk, root);
  return pictures;
}

}  // namespace prospect::services
