#include "tools/figures/loaded_model.h"

#include <memory>

#include "model/inference/networks.h"
#include "model/inference/painting.h"

namespace prospect::figures {

namespace {

using model::inference::Arena;
using NetworksPtr = std::shared_ptr<const model::inference::Networks>;

std::vector<float> Decoded(const NetworksPtr& networks, const model::Hidden& state, Arena& arena) {
  std::vector<float> picture(static_cast<std::size_t>(networks->config().image_bytes()));
  networks->Decode(state.data(), picture.data(), arena);
  return picture;
}

Painter MakePainter(const NetworksPtr& networks) {
  return [networks](const sim::Image& seen, const model::Hidden& start,
                    const std::vector<model::Hidden>& states) {
    Arena arena;
    model::inference::SeenPicture from{std::vector<float>(seen.rgb.size()),
                                       Decoded(networks, start, arena)};
    model::inference::ToFloats(seen.rgb.data(), seen.rgb.size(), from.seen.data());
    std::vector<sim::Image> pictures;
    for (const model::Hidden& state : states) {
      std::vector<float> painted = Decoded(networks, state, arena);
      PaintOnto(from, {seen.height, seen.width}, /*compose=*/false, painted.data());
      pictures.push_back({seen.width, seen.height, {}});
      pictures.back().rgb.resize(painted.size());
      model::inference::ToBytes(painted.data(), painted.size(), pictures.back().rgb.data());
    }
    return pictures;
  };
}

DoneHead MakeDoneHead(const NetworksPtr& networks) {
  return [networks](const model::Hidden& h0, const model::Hidden& h, int action) {
    Arena arena;
    const model::inference::RootPart root = networks->FoldRoot(h0.data(), arena);
    const model::inference::Networks::Question question{h.data(), &root, action};
    model::inference::Judgements judgements;
    networks->Judge({&question, 1}, &judgements, arena);
    return judgements.done.at(0);
  };
}

}  // namespace

LoadedModel LoadWeights(const std::string& path, int threads) {
  LoadedModel loaded;
  loaded.engine = model::LoadEngine(path, threads);
  const model::WeightsFile file = model::ReadWeights(path);
  const auto networks = std::make_shared<const model::inference::Networks>(
      model::inference::BestKernels(), file, path);
  loaded.paint = MakePainter(networks);
  if (networks->judges()) loaded.done = MakeDoneHead(networks);
  return loaded;
}

}  // namespace prospect::figures
