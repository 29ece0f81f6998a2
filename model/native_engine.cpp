#include "model/native_engine.h"

#include <algorithm>
#include <list>
#include <memory>
#include <mutex>
#include <span>

#include "base/hash.h"
#include "model/engine.h"
#include "model/engine_facts.h"
#include "model/inference/networks.h"
#include "model/inference/painting.h"
#include "model/row_pool.h"
#include "model/turning_engine.h"
#include "model/turns.h"
#include "model/weights_file.h"

namespace prospect::model {
namespace {

using inference::Arena;
using inference::Judgements;
using inference::RootPart;

/// Rows that a thread computes layer by layer, so that each layer's weights are read once for all.
constexpr std::size_t kMostRowsTogether = 8;
constexpr std::size_t kRootsKept = 16;

/// Arenas for threads that come and go. Thread-safe.
class ArenaShelf {
 public:
  /// One that nobody else has while this lives.
  class Lease {
   public:
    explicit Lease(ArenaShelf& shelf) : shelf_(shelf), arena_(shelf.Take()) {}
    ~Lease() { shelf_.Put(std::move(arena_)); }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    Arena& arena() { return *arena_; }

   private:
    ArenaShelf& shelf_;
    std::unique_ptr<Arena> arena_;
  };

 private:
  std::unique_ptr<Arena> Take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (free_.empty()) return std::make_unique<Arena>();
    std::unique_ptr<Arena> arena = std::move(free_.back());
    free_.pop_back();
    return arena;
  }
  void Put(std::unique_ptr<Arena> arena) {
    const std::lock_guard<std::mutex> lock(mutex_);
    free_.push_back(std::move(arena));
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<Arena>> free_;
};

/// The parts of recent roots, by the root's own numbers. One thread at a time.
class RootMemory {
 public:
  std::shared_ptr<const RootPart> Of(const inference::Networks& networks, std::span<const float> h0,
                                     Arena& arena) {
    const auto found = std::find_if(roots_.begin(), roots_.end(), [&](const Root& root) {
      return std::equal(root.h0.begin(), root.h0.end(), h0.begin());
    });
    if (found != roots_.end()) {
      roots_.splice(roots_.begin(), roots_, found);
    } else {
      roots_.push_front({Hidden(h0.begin(), h0.end()),
                         std::make_shared<const RootPart>(networks.FoldRoot(h0.data(), arena))});
      if (roots_.size() > kRootsKept) roots_.pop_back();
    }
    return roots_.front().part;
  }

 private:
  struct Root {
    Hidden h0;
    std::shared_ptr<const RootPart> part;
  };
  std::list<Root> roots_;  // last used first
};

/// The networks by our own kernels, in 32-bit floats. Rows are spread over threads in groups; each
/// row is computed as if it were alone.
class NativeEngine : public Engine {
 public:
  NativeEngine(const WeightsFile& file, const std::string& path, int threads,
               const inference::Kernels& kernels)
      : networks_(kernels, file, path),
        weights_hash_(file.hash),
        compose_(file.metadata.value("train", nlohmann::json::object()).value("compose", true)),
        threads_(static_cast<std::size_t>(std::max(1, threads))),
        pool_(static_cast<int>(threads_), [] {}) {
    const std::string name = std::string("native ") + kernels.name;
    info_ = InfoOf(file, path, networks_.config(),
                   networks_.judges() ? name : name + ", pictures only", networks_.judges());
    fingerprint_ = base::HashText(name, HashOfProbe(*this));
  }

  const EngineInfo& info() const override { return info_; }
  std::uint64_t weights_hash() const override { return weights_hash_; }
  std::uint64_t fingerprint() const override { return fingerprint_; }

 protected:
  Hidden DoEncode(Pixels picture) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    ArenaShelf::Lease lease(shelf_);
    Hidden h(static_cast<std::size_t>(info_.hidden_size));
    networks_.Encode(picture.data(), h.data(), lease.arena());
    return h;
  }

  Prediction DoEvaluate(std::span<const float> h0, std::span<const float> h,
                        int previous_action) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    ArenaShelf::Lease lease(shelf_);
    const auto root = roots_.Of(networks_, h0, lease.arena());
    const inference::Networks::Question question{h.data(), root.get(), previous_action};
    Judgements judgements;
    networks_.Judge({&question, 1}, &judgements, lease.arena());
    Prediction answer = AnswerOf(judgements, 0);
    answer.done = info_.judges ? 1 : 0;
    return answer;
  }

  std::vector<Prediction> DoExpand(const std::vector<ExpandInput>& rows) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::vector<std::shared_ptr<const RootPart>> roots = RootsOf(rows);
    std::vector<Prediction> answers(rows.size());
    const std::size_t group =
        std::clamp<std::size_t>((rows.size() + threads_ - 1) / threads_, 1, kMostRowsTogether);
    pool_.Run((rows.size() + group - 1) / group, [&](std::size_t i) {
      ExpandGroup(rows, roots, i * group, std::min(rows.size(), (i + 1) * group), &answers);
    });
    return answers;
  }

  std::vector<std::vector<std::uint8_t>> DoDecode(const std::vector<Hidden>& states) override {
    return Paint(states, [](float*) {});
  }

  std::vector<std::vector<std::uint8_t>> DoDecodeOnto(Pixels seen, std::span<const float> start,
                                                      const std::vector<Hidden>& states) override {
    inference::SeenPicture picture;
    picture.seen.resize(PictureSize());
    picture.decoded_start.resize(PictureSize());
    inference::ToFloats(seen.data(), PictureSize(), picture.seen.data());
    {
      ArenaShelf::Lease lease(shelf_);
      networks_.Decode(start.data(), picture.decoded_start.data(), lease.arena());
    }
    return Paint(states, [&](float* decoded) {
      inference::PaintOnto(picture, {info_.image_height, info_.image_width}, compose_, decoded);
    });
  }

  std::vector<float> DoClassify(Pixels picture) override {
    if (!networks_.classifies()) return {};
    ArenaShelf::Lease lease(shelf_);
    return networks_.Classify(picture.data(), lease.arena());
  }

 private:
  std::size_t PictureSize() const {
    return static_cast<std::size_t>(networks_.config().image_bytes());
  }

  std::vector<std::shared_ptr<const RootPart>> RootsOf(const std::vector<ExpandInput>& rows) {
    ArenaShelf::Lease lease(shelf_);
    std::vector<std::shared_ptr<const RootPart>> roots;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const bool same = i > 0 && rows[i].h0.data() == rows[i - 1].h0.data();
      roots.push_back(same ? roots.back() : roots_.Of(networks_, rows[i].h0, lease.arena()));
    }
    return roots;
  }

  void ExpandGroup(const std::vector<ExpandInput>& rows,
                   const std::vector<std::shared_ptr<const RootPart>>& roots, std::size_t begin,
                   std::size_t end, std::vector<Prediction>* answers) {
    ArenaShelf::Lease lease(shelf_);
    const Arena::Scope scope(lease.arena());
    const auto size = static_cast<std::size_t>(info_.hidden_size);
    float* const next = lease.arena().Take((end - begin) * size);
    std::vector<inference::Networks::Question> questions;
    for (std::size_t i = begin; i < end; ++i)
      questions.push_back({rows[i].h.data(), roots[i].get(), rows[i].action});
    Judgements judgements;
    networks_.Expand(questions, next, &judgements, lease.arena());
    for (std::size_t i = begin; i < end; ++i) {
      Prediction& answer = (*answers)[i];
      answer = AnswerOf(judgements, i - begin);
      answer.done = info_.judges ? judgements.done[i - begin] : 0;
      answer.h.assign(next + (i - begin) * size, next + (i - begin + 1) * size);
    }
  }

  /// Value, Q and p of state i; all 0 where the weights do not judge.
  Prediction AnswerOf(const Judgements& judgements, std::size_t i) const {
    const auto actions = static_cast<std::size_t>(info_.num_actions);
    Prediction answer;
    if (!info_.judges) {
      answer.q.assign(actions, 0.0F);
      answer.p.assign(actions, 0.0F);
      return answer;
    }
    const auto part = [&](const std::vector<float>& all) {
      const float* const begin = all.data() + i * actions;
      return std::vector<float>(begin, begin + actions);
    };
    answer.value = judgements.value[i];
    answer.q = part(judgements.q);
    answer.p = part(judgements.p);
    return answer;
  }

  /// Decodes states, each finished by `finish`, into bytes.
  template <typename Finish>
  std::vector<std::vector<std::uint8_t>> Paint(const std::vector<Hidden>& states,
                                               const Finish& finish) {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<std::vector<std::uint8_t>> pictures(states.size());
    pool_.Run(states.size(), [&](std::size_t i) {
      ArenaShelf::Lease lease(shelf_);
      const Arena::Scope scope(lease.arena());
      float* const decoded = lease.arena().Take(PictureSize());
      networks_.Decode(states[i].data(), decoded, lease.arena());
      finish(decoded);
      pictures[i].resize(PictureSize());
      inference::ToBytes(decoded, PictureSize(), pictures[i].data());
    });
    return pictures;
  }

  inference::Networks networks_;
  EngineInfo info_;
  std::uint64_t weights_hash_ = 0;
  bool compose_ = true;  // pictures keep what was seen where nothing changes
  std::uint64_t fingerprint_ = 0;
  std::size_t threads_;
  std::mutex mutex_;  // one question at a time; the pool spreads its rows
  ArenaShelf shelf_;
  RootMemory roots_;
  RowPool pool_;
};

}  // namespace

std::unique_ptr<Engine> LoadNativeEngine(const std::string& path, int threads,
                                         const inference::Kernels& kernels) {
  return std::make_unique<NativeEngine>(ReadWeights(path), path, threads, kernels);
}

std::unique_ptr<Engine> LoadEngine(const std::string& path, int threads) {
  return LoadNativeEngine(path, threads, inference::BestKernels());
}

std::unique_ptr<Engine> LoadDecidingEngine(const std::string& path, int threads) {
  std::unique_ptr<Engine> engine = LoadEngine(path, threads);
  const int turns = TurnsOf(path);
  if (turns == 1) return engine;
  return std::make_unique<TurningEngine>(std::move(engine), turns);
}

std::unique_ptr<Engine> LoadSearchEngine(const std::string& path, int threads) {
  std::unique_ptr<Engine> engine = LoadDecidingEngine(path, threads);
  if (!engine->info().judges) throw WeightsError(path + ": " + kPicturesOnly);
  return engine;
}

}  // namespace prospect::model
