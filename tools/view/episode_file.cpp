#include "tools/view/episode_file.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/strict_json.h"

namespace prospect::tools {

CarriedOut ReadEpisodeResult(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw EpisodeFileError("cannot read " + path + ": give the result.json of an episode");
  try {
    const nlohmann::json result = base::ParseStrictJson(in);
    CarriedOut episode;
    result.at("task").get_to(episode.task);
    episode.world_version = result.value("world_version", std::string());
    if (result.at("seed").is_null())
      throw EpisodeFileError(path +
                             " tells of no simulated scene: there is no seed to make it from");
    result.at("seed").get_to(episode.seed);
    result.at("objects").get_to(episode.objects);
    result.at("plan_length").get_to(episode.plan_length);
    for (const auto& act : result.at("acts")) episode.actions.push_back(act.at("action"));
    return episode;
  } catch (const base::KeyTwiceError& error) {
    throw EpisodeFileError(path + ": " + error.what());
  } catch (const nlohmann::json::exception&) {
    throw EpisodeFileError(path + " is not the result.json of an episode");
  }
}

}  // namespace prospect::tools
