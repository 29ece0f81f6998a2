#include "model/training/scores.h"

#include <cstdio>

#include "model/training/head_scores.h"
#include "model/training/picture_scores.h"

namespace prospect::model {
namespace {

using nlohmann::json;

constexpr std::size_t kMostTrials = 1000;  // a part's trials that are scored, evenly spread
constexpr std::size_t kMostChains = 800;   // chains whose pictures are decoded

json Summary(const Judgements& valid, const Judgements& test) {
  const double base = BaseRate(test);
  const double threshold = BestThreshold(valid);
  return {{"balanced_accuracy", BalancedAccuracy(test, threshold)},
          {"threshold", threshold},
          {"balanced_accuracy_at_half", BalancedAccuracy(test, 0.5)},
          {"accuracy", Accuracy(test)},
          {"area_under_roc", AreaUnderRoc(test)},
          {"base_rate", base},
          {"brier", BrierScore(test)},
          {"trivial_brier", base * (1 - base)},
          {"samples", test.size()}};
}

void AddStates(const std::string& kind, const StateJudgements& valid, const StateJudgements& test,
               json* scores) {
  (*scores)["value"][kind] = Summary(valid.value, test.value);
  (*scores)["f"][kind] = Summary(valid.done, test.done);
  (*scores)["p"][kind] = Summary(valid.p, test.p);
  (*scores)["p"][kind]["recall_at_tenth"] = Recall(test.taken, 0.1);
  (*scores)["q"][kind] = Summary(valid.q, test.q);
}

json HeadScores(const HeadJudgements& valid, const HeadJudgements& test) {
  json scores;
  AddStates("real", valid.real, test.real, &scores);
  AddStates("after_one", valid.after_one, test.after_one, &scores);
  AddStates("after_two", valid.after_two, test.after_two, &scores);
  AddStates("boundary", valid.boundary, test.boundary, &scores);
  AddStates("boundary_after_one", valid.boundary_after_one, test.boundary_after_one, &scores);
  AddStates("boundary_after_two", valid.boundary_after_two, test.boundary_after_two, &scores);
  AddStates("imagined", valid.imagined, test.imagined, &scores);
  for (std::size_t k = 0; k < test.done_at_depth.size(); ++k) {
    const bool chosen = k < valid.done_at_depth.size();
    scores["f"]["depth" + std::to_string(k + 1)] =
        Summary(chosen ? valid.done_at_depth[k] : Judgements{}, test.done_at_depth[k]);
  }
  scores["plan"] = Summary(valid.plan, test.plan);
  return scores;
}

void PrintPictures(const json& scores) {
  std::printf("%-28s %10s %10s %14s %12s\n", "pictures, mean abs. error", "T", "copying x",
              "enc-dec(goal)", "noise floor");
  for (const char* step : {"x1", "x2"}) {
    const json& s = scores["pictures"][step];
    for (const char* kind : {"mae", "mae_changed", "mae_clean", "mae_changed_clean"}) {
      const double floor = std::string(kind) == "mae" ? s["noise_floor"].get<double>() : 0.0;
      std::printf("  %s %-23s %10.4f %10.4f %14.4f %12.4f\n", step, kind, s[kind].get<double>(),
                  s[std::string("copy_") + kind].get<double>(),
                  s[std::string("reconstruction_") + kind].get<double>(), floor);
    }
  }
}

void PrintLikeness(const json& scores) {
  std::printf("%-28s %10s %10s %14s\n", "pictures, likeness", "T", "copying x", "enc-dec(goal)");
  for (const char* step : {"x1", "x2"}) {
    const json& s = scores["pictures"][step];
    for (const std::string kind : {"psnr", "ssim"}) {
      std::printf("  %s %-23s %10.3f %10.3f %14.3f\n", step, kind.c_str(), s[kind].get<double>(),
                  s["copy_" + kind].get<double>(), s["reconstruction_" + kind].get<double>());
    }
  }
}

void PrintLabels(const json& scores) {
  std::printf("%-28s %10s %10s %14s %12s %10s\n", "label accuracy", "2nd class.", "C",
              "2nd on real", "C on real", "majority");
  for (const char* step : {"x1", "x2"}) {
    const json& s = scores["labels"][step];
    const auto share = [&s](const char* key) {
      char text[16] = "-";
      if (s.contains(key)) std::snprintf(text, sizeof text, "%.3f", s[key].get<double>());
      return std::string(text);
    };
    std::printf("  %-26s %10s %10s %14s %12s %10s\n", step, share("second").c_str(),
                share("first").c_str(), share("real_second").c_str(), share("real_first").c_str(),
                share("majority").c_str());
  }
}

void PrintHead(const std::string& name, const json& s) {
  std::printf("  %-26s %10.3f %10.3f %10.3f %10.3f %10.4f %10.4f %10.3f\n", name.c_str(),
              s["balanced_accuracy"].get<double>(), s["balanced_accuracy_at_half"].get<double>(),
              s["accuracy"].get<double>(), s["area_under_roc"].get<double>(),
              s["brier"].get<double>(), s["trivial_brier"].get<double>(),
              s["base_rate"].get<double>());
}

void PrintHeads(const json& scores) {
  std::printf("%-28s %10s %10s %10s %10s %10s %10s %10s\n", "V, f, p, Q", "bal. acc.", "at 0.5",
              "accuracy", "ROC area", "Brier", "trivial", "base rate");
  for (const char* head : {"value", "f", "p", "q"}) {
    for (const auto& item : scores[head].items()) {
      PrintHead(std::string(head) + " " + item.key(), item.value());
    }
  }
  PrintHead("plan (V x f along it)", scores["plan"]);
  std::printf("  p of the action taken next above 0.1: real %.3f, after one transform %.3f\n",
              scores["p"]["real"]["recall_at_tenth"].get<double>(),
              scores["p"]["after_one"]["recall_at_tenth"].get<double>());
}

}  // namespace

json ComputeScores(const TrainContext& context, const TrialFile& file, int threads) {
  context.networks.SetTraining(false);
  const ScoredSplit test(context, Split::kTest, kMostTrials, threads);
  json scores = json::object();
  if (context.networks.has_heads) {
    HeadJudgements valid;
    if (!context.samples.TrialsOf(Split::kValid).empty()) {
      valid = JudgeHeads(ScoredSplit(context, Split::kValid, kMostTrials, threads), threads);
    }
    scores = HeadScores(valid, JudgeHeads(test, threads));
  }
  scores.update(ScorePictures(test, file, kMostChains, threads));
  scores["trials"] = test.trials().size();
  return scores;
}

void PrintScores(const json& scores) {
  std::printf("Held-out scores (%zu test trials)\n", scores["trials"].get<std::size_t>());
  PrintPictures(scores);
  PrintLikeness(scores);
  if (scores.contains("labels")) PrintLabels(scores);
  if (scores.contains("plan")) PrintHeads(scores);
}

void RoundToHalf(const Networks& networks) {
  const torch::NoGradGuard no_grad;
  for (const auto& [name, module] : networks.named()) {
    for (torch::Tensor& tensor : module->parameters()) {
      tensor.copy_(tensor.to(torch::kHalf).to(torch::kFloat));
    }
  }
}

}  // namespace prospect::model
