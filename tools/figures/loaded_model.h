#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "model/engine.h"
#include "sim/image.h"

namespace prospect::figures {

/// Decoded states in the light of a picture that was seen, whose hidden state is `start`
/// (model/networks/light.h: hidden states do not hold how bright a scene is). This is what the
/// networks imagine, and what the tables measure; for a person who is to act on a plan, an engine
/// paints it onto the picture that was seen (Engine::DecodeOnto).
using Painter = std::function<std::vector<sim::Image>(
    const sim::Image& seen, const model::Hidden& start, const std::vector<model::Hidden>& states)>;

/// f(h0, h, a) of a state that was really seen; an engine asks f of imagined states only.
using DoneHead = std::function<float(const model::Hidden& h0, const model::Hidden& h, int action)>;

/// One set of weights. Copies share it.
struct LoadedModel {
  std::shared_ptr<model::Engine> engine;
  Painter paint;
  DoneHead done;  ///< empty where the engine does not judge
};

/// Throws model::WeightsError.
LoadedModel LoadWeights(const std::string& path, int threads);

}  // namespace prospect::figures
