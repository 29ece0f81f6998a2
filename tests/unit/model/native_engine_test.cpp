#include "model/native_engine.h"

#include <gtest/gtest.h>
#include <torch/torch.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "model/networks/networks.h"
#include "model/weights.h"
#include "tests/unit/model/made_weights.h"
#include "tests/unit/model/small_config.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::model {
namespace {

float Apart(const std::vector<float>& a, const std::vector<float>& b) {
  EXPECT_EQ(a.size(), b.size());
  float most = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

void ExpectNear(const Prediction& a, const Prediction& b) {
  EXPECT_LT(Apart(a.h, b.h), 1e-4F);
  EXPECT_NEAR(a.value, b.value, 1e-4F);
  EXPECT_NEAR(a.done, b.done, 1e-4F);
  EXPECT_LT(Apart(a.q, b.q), 1e-4F);
  EXPECT_LT(Apart(a.p, b.p), 1e-4F);
}

void ExpectSame(const Prediction& a, const Prediction& b) {
  EXPECT_EQ(a.h, b.h);
  EXPECT_EQ(a.value, b.value);
  EXPECT_EQ(a.done, b.done);
  EXPECT_EQ(a.q, b.q);
  EXPECT_EQ(a.p, b.p);
}

int FarthestByte(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  EXPECT_EQ(a.size(), b.size());
  int most = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    most = std::max(most, std::abs(int{a[i]} - int{b[i]}));
  return most;
}

void ExpectAgreement(Engine& reference, Engine& engine) {
  const EngineInfo& info = engine.info();
  const auto picture = Picture(info, 1);
  const Hidden h0 = reference.Encode(picture);
  EXPECT_LT(Apart(engine.Encode(picture), h0), 1e-4F);
  Hidden h = reference.Encode(Picture(info, 2));
  for (int action = 0; action < std::min(3, info.num_actions); ++action) {
    const Prediction known = reference.Expand({{h0, h, action}}).at(0);
    ExpectNear(engine.Expand({{h0, h, action}}).at(0), known);
    ExpectNear(engine.Evaluate(h0, h, action), reference.Evaluate(h0, h, action));
    h = known.h;
  }
  ExpectNear(engine.Evaluate(h0, h, info.num_actions), reference.Evaluate(h0, h, info.num_actions));
  EXPECT_LE(FarthestByte(engine.Decode({h}).at(0), reference.Decode({h}).at(0)), 1);
  EXPECT_LE(FarthestByte(engine.DecodeOnto(picture, h0, {h}).at(0),
                         reference.DecodeOnto(picture, h0, {h}).at(0)),
            1);
  EXPECT_LT(Apart(engine.Classify(picture), reference.Classify(picture)), 1e-4F);
}

struct Case {
  const char* name;
  void (*change)(NetworkConfig*);
};

class NativeEngineAgrees : public testing::TestWithParam<Case> {};

TEST_P(NativeEngineAgrees, WithTheNetworksInLibtorch) {
  NetworkConfig config = SmallConfig();
  GetParam().change(&config);
  const MadeWeights weights(config);
  const auto reference = LoadTorchEngine(weights.path, 1);
  for (const inference::Kernels* kernels : inference::RunnableKernels()) {
    SCOPED_TRACE(kernels->name);
    ExpectAgreement(*reference, *LoadNativeEngine(weights.path, 1, *kernels));
  }
}

const Case kCases[] = {
    {"Defaults", [](NetworkConfig*) {}},
    {"NoSkip", [](NetworkConfig* c) { c->skip = false; }},
    {"Strided", [](NetworkConfig* c) { c->bottleneck = "strided"; }},
    {"ScaleAndShift", [](NetworkConfig* c) { c->transform_action = "scale_and_shift"; }},
    {"Mask", [](NetworkConfig* c) { c->transform_mask = true; }},
    {"LeakyRelu", [](NetworkConfig* c) { c->activation = "leaky_relu"; }},
    {"Costar", [](NetworkConfig* c) { c->heads = "costar"; }},
    {"FiveChannels", [](NetworkConfig* c) { c->hidden_channels = 5; }},
    {"SixtyFourPixels", [](NetworkConfig* c) { c->image_width = c->image_height = 64; }},
    {"SmallAndOblong", [](NetworkConfig* c) { c->image_width = 48, c->image_height = 32; }},
    {"AsManyActionsAsThereMayBe", [](NetworkConfig* c) { c->num_actions = 255; }},
    {"AsLargeAsPicturesMayBe",
     [](NetworkConfig* c) {
       c->image_width = c->image_height = 256;
       c->transform_mask = true;
     }},
    {"EverythingAtSuturingsSize",
     [](NetworkConfig* c) {
       c->image_width = 128, c->image_height = 96, c->num_actions = 15;
       c->transform_extra_stages = 1;
       c->transform_action = "scale_and_shift";
       c->transform_mask = true;
     }},
    {"TheAuthorsCode",
     [](NetworkConfig* c) {
       c->image_width = 96, c->image_height = 64;
       c->transform_extra_stages = 1;
       c->heads = "costar", c->activation = "leaky_relu", c->bottleneck = "strided";
       c->skip = false;
     }},
};
INSTANTIATE_TEST_SUITE_P(Options, NativeEngineAgrees, testing::ValuesIn(kCases),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(NativeEngine, PicturesOnlyIsSaidAndAnsweredWithZeros) {
  const MadeWeights weights(SmallConfig(), /*heads=*/false);
  const auto engine = LoadEngine(weights.path, 1);
  EXPECT_FALSE(engine->info().judges);
  ExpectAgreement(*LoadTorchEngine(weights.path, 1), *engine);
  EXPECT_THROW(LoadSearchEngine(weights.path, 1), WeightsError);
}

// The promise that everything else rests on: what a row is asked with does not change its answer.
TEST(NativeEngine, ARowDoesNotDependOnItsBatchThreadsOrHistory) {
  NetworkConfig config = SmallConfig();
  config.num_actions = 6;
  config.transform_action = "scale_and_shift";
  const MadeWeights weights(config);
  for (const inference::Kernels* kernels : inference::RunnableKernels()) {
    SCOPED_TRACE(kernels->name);
    const auto alone = LoadNativeEngine(weights.path, 1, *kernels);
    std::mt19937 random(11);
    std::vector<Hidden> roots, states;
    for (int i = 0; i < 20; ++i) roots.push_back(alone->Encode(Picture(alone->info(), i)));
    for (int i = 0; i < 1000; ++i) {
      states.push_back(roots[random() % roots.size()]);
      for (float& value : states.back()) value *= static_cast<float>(random() % 1000) / 1000;
    }
    std::vector<ExpandInput> rows;
    std::vector<Prediction> known;
    for (int i = 0; i < 1000; ++i) {
      rows.push_back({roots[random() % roots.size()], states[i], static_cast<int>(random() % 6)});
      known.push_back(alone->Expand({rows.back()}).at(0));
    }
    std::vector<std::size_t> order(rows.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::vector<std::unique_ptr<Engine>> engines;
    for (int threads = 1; threads <= 4; ++threads)
      engines.push_back(LoadNativeEngine(weights.path, threads, *kernels));
    const int batchings = kernels == &inference::BestKernels() ? 50 : 4;  // others are slower
    for (int batching = 0; batching < batchings; ++batching) {
      std::shuffle(order.begin(), order.end(), random);
      for (std::size_t at = 0; at < order.size();) {
        std::vector<std::size_t> which;
        for (std::size_t n = 1 + random() % 64; n > 0 && at < order.size(); --n)
          which.push_back(order[at++]);
        std::vector<ExpandInput> batch;
        for (const std::size_t i : which) batch.push_back(rows[i]);
        const auto answers = engines[static_cast<std::size_t>(batching) % 4]->Expand(batch);
        for (std::size_t i = 0; i < which.size(); ++i) ExpectSame(answers[i], known[which[i]]);
      }
      if (HasFailure()) return;
    }
  }
}

TEST(NativeEngine, FingerprintsTellInstructionSetsApart) {
  const MadeWeights weights(SmallConfig());
  std::set<std::uint64_t> fingerprints;
  for (const inference::Kernels* kernels : inference::RunnableKernels()) {
    const auto engine = LoadNativeEngine(weights.path, 1, *kernels);
    EXPECT_NE(engine->info().engine.find(kernels->name), std::string::npos);
    EXPECT_EQ(engine->fingerprint(), LoadNativeEngine(weights.path, 3, *kernels)->fingerprint());
    fingerprints.insert(engine->fingerprint());
  }
  EXPECT_EQ(fingerprints.size(), inference::RunnableKernels().size());
}

}  // namespace
}  // namespace prospect::model
