#include "tools/evaluate/novelty_gate.h"

#include <utility>

namespace prospect::tools {
namespace {

class NoveltyGate : public Decider {
 public:
  NoveltyGate(std::unique_ptr<Decider> inner, model::Engine* engine, model::NoveltyGauge gauge,
              double level)
      : inner_(std::move(inner)), engine_(engine), gauge_(std::move(gauge)), level_(level) {}

  void Begin(std::uint64_t scene_seed, const std::vector<std::uint8_t>& first) override {
    novelty_ = gauge_.Judge(model::TakeNoveltySample(*engine_, first));
    inner_->Begin(scene_seed, first);
  }

  Decision Decide(const planner::Path& executed, const std::vector<std::uint8_t>& latest,
                  sim::Task& task) override {
    if (!executed.empty() || novelty_.p >= level_) return inner_->Decide(executed, latest, task);
    Decision decision;
    decision.reason = model::NoveltyRefusal(novelty_);
    return decision;
  }

 private:
  std::unique_ptr<Decider> inner_;
  model::Engine* engine_;
  model::NoveltyGauge gauge_;
  double level_;
  model::Novelty novelty_;
};

}  // namespace

std::unique_ptr<Decider> MakeNoveltyGate(std::unique_ptr<Decider> inner, model::Engine* engine,
                                         const model::NoveltyGauge& gauge, double level) {
  return std::make_unique<NoveltyGate>(std::move(inner), engine, gauge, level);
}

}  // namespace prospect::tools
