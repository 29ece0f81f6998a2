// For builds without OpenCV: the episode's figures are all in result.json.

#include <spdlog/spdlog.h>

#include "services/executive/episode_video.h"
#include "services/executive/explanation_pictures.h"
#include "services/executive/plan_picture.h"

namespace prospect::services {

using namespace agent;

void WritePlanPicture(const EpisodeRecord&, const std::string& path) {
  spdlog::info("{} is not drawn: this build was made without OpenCV", path);
}

std::string PngOf(const Picture&) { return ""; }

void WriteExplanationPictures(const Explanation&, const std::string& folder) {
  spdlog::info("{}/chosen.png is not drawn: this build was made without OpenCV", folder);
}

void WriteEpisodeVideo(const EpisodeRecord&, const std::string& path) {
  spdlog::info("{} is not written: this build was made without OpenCV", path);
}

}  // namespace prospect::services
