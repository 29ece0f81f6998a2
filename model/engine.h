#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/refusal/sample.h"

namespace prospect::model {

/// A hidden state, EngineInfo::hidden_size floats. Only engines know what is in it.
using Hidden = std::vector<float>;

/// One question: what would `action` do from `h`? The states are not owned and must live through
/// the call.
struct ExpandInput {
  std::span<const float> h0;  ///< hidden_size floats: the problem's first picture, encoded
  std::span<const float> h;   ///< hidden_size floats: the state the action starts from
  int action = 0;             ///< 0..num_actions-1
};

/// What the networks say about one state. All numbers are probabilities in [0,1].
struct Prediction {
  Hidden h;              ///< the state itself (empty for a root, whose state the caller has)
  float value = 0;       ///< V(h): the task will succeed from here
  float done = 0;        ///< f(h0, h, a): the action that led here has succeeded; 1 at a root
  std::vector<float> q;  ///< Q(h0, h, a, a') of every action a'
  std::vector<float> p;  ///< p(a' | h0, h, a) of every action a'
};

/// What an engine was made for.
struct EngineInfo {
  std::string engine;     ///< "native avx512", "torch", "scripted", ...
  std::string task;       ///< e.g. "navigation"
  std::string task_hash;  ///< hash of the action table it was trained with, as text; may be empty
  int num_actions = 0;    ///< num_actions itself stands for "no action yet"
  int image_width = 0, image_height = 0;
  int hidden_size = 0;
  /// Of the eight turns and mirrorings of a picture those that are looked at
  /// (model/turning_engine.h). A state is as many, of equal size; the first is the picture's own.
  int turns = 1;
  double refusal_threshold =
      0;  ///< of the first calibration, or training's own where there is none
  /// One for each kind of scenes that was calibrated on, with a threshold of its own; may be none.
  std::vector<CalibrationSample> calibrations;
  /// False: the weights hold no V, Q, p and f, so they predict pictures and nothing can be
  /// searched. Evaluate and Expand then answer 0 for all four.
  bool judges = true;
};

/// What is said where a search is asked of an engine that does not judge.
inline constexpr const char* kPicturesOnly =
    "these weights predict pictures only: they hold no V, Q, p and f to search with";

/// A picture, image_height x image_width x 3 bytes RGB, rows from the top.
using Pixels = std::span<const std::uint8_t>;

/// The learned models as the rest of the system uses them: the paper's f_enc, f_dec, T, V, Q, p, f,
/// C.
///
/// Answers are pure functions of one row's input: they do not depend on what else is asked in the
/// same call, before it, or by how many threads. Methods may be called from several threads; they
/// wait for each other.
///
/// The public functions check every size and action, for all engines alike: what does not fit
/// throws std::invalid_argument naming what was expected and what was given. Engines implement the
/// protected ones, which are never given anything else.
class Engine {
 public:
  virtual ~Engine() = default;

  /// f_enc: a picture to its hidden state.
  Hidden Encode(Pixels picture);

  /// V, Q and p of a state that was reached by really carrying out `previous_action` (num_actions =
  /// none yet). `done` is 1 and `h` empty.
  Prediction Evaluate(std::span<const float> h0, std::span<const float> h, int previous_action);

  /// For each row: h' = T(h0, h, a), then V(h'), f(h0, h', a), Q(h0, h', a, .), p(. | h0, h', a).
  std::vector<Prediction> Expand(const std::vector<ExpandInput>& rows);

  /// f_dec: pictures of states.
  std::vector<std::vector<std::uint8_t>> Decode(const std::vector<Hidden>& states);

  /// f_dec of states imagined from a picture that was seen (`seen`, encoded as `start`): in its
  /// light, and showing it where imagination changes nothing. Engines that do not paint leave it at
  /// Decode.
  std::vector<std::vector<std::uint8_t>> DecodeOnto(Pixels seen, std::span<const float> start,
                                                    const std::vector<Hidden>& states);

  /// C: for a picture, the probability of each action that this is the action's goal. Empty if the
  /// weights hold no classifier.
  std::vector<float> Classify(Pixels picture);

  virtual const EngineInfo& info() const = 0;

  /// Hash of the weights file's bytes: equal hash, equal networks.
  virtual std::uint64_t weights_hash() const = 0;

  /// Hash of the answers to a fixed question. Equal weights on different machines may give
  /// different last bits; engines of equal fingerprint may be mixed in one search.
  virtual std::uint64_t fingerprint() const = 0;

 protected:
  virtual Hidden DoEncode(Pixels picture) = 0;
  virtual Prediction DoEvaluate(std::span<const float> h0, std::span<const float> h,
                                int previous_action) = 0;
  virtual std::vector<Prediction> DoExpand(const std::vector<ExpandInput>& rows) = 0;
  virtual std::vector<std::vector<std::uint8_t>> DoDecode(const std::vector<Hidden>& states) = 0;
  virtual std::vector<std::vector<std::uint8_t>> DoDecodeOnto(Pixels /*seen*/,
                                                              std::span<const float> /*start*/,
                                                              const std::vector<Hidden>& states) {
    return DoDecode(states);
  }
  virtual std::vector<float> DoClassify(Pixels picture) = 0;
};

/// Loads a weights file's networks (model/weights_file.h) for the CPU; rows are spread over
/// `threads` threads (at least 1), each row on one. Throws WeightsError (model/weights_error.h)
/// naming file and reason.
std::unique_ptr<Engine> LoadEngine(const std::string& path, int threads);

/// The same by libtorch, six times slower: the reference that LoadEngine's is tested against. Only
/// in programs that link libtorch.
std::unique_ptr<Engine> LoadTorchEngine(const std::string& path, int threads);

/// The networks as those who decide ask them: LoadEngine, looking at each picture in as many turns
/// as the file says (model/turns.h).
std::unique_ptr<Engine> LoadDecidingEngine(const std::string& path, int threads);

/// LoadDecidingEngine for a search: weights that predict pictures only are a WeightsError, too.
std::unique_ptr<Engine> LoadSearchEngine(const std::string& path, int threads);

}  // namespace prospect::model
