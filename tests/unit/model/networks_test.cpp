#include "model/networks/networks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <set>

#include "model/engine.h"
#include "model/networks/blocks.h"
#include "model/networks/precision.h"
#include "model/weights.h"
#include "tests/unit/model/small_config.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::model {
namespace {

TEST(Networks, HaveThePapersShapes) {
  const torch::NoGradGuard no_grad;
  Networks n{NetworkConfig{}};
  n.SetTraining(false);
  const torch::Tensor x = torch::rand({2, 3, 64, 64});
  const torch::Tensor h = n.encoder->forward(x);
  EXPECT_EQ(h.sizes(), (torch::IntArrayRef{2, 8, 8, 8}));
  EXPECT_EQ(n.decoder->forward(h).sizes(), x.sizes());
  const torch::Tensor a = torch::tensor({1, 6});
  EXPECT_EQ(n.transform->forward(h, h, a).sizes(), h.sizes());
  EXPECT_EQ(n.value->forward(h).sizes(), (torch::IntArrayRef{2}));
  EXPECT_EQ(n.q->forward(h, h, torch::tensor({7, 0})).sizes(), (torch::IntArrayRef{2, 7}));
  EXPECT_EQ(n.f->forward(h, h, a).sizes(), (torch::IntArrayRef{2, 1}));
  EXPECT_EQ(n.classifier->forward(x).sizes(), (torch::IntArrayRef{2, 7}));
  EXPECT_GT(h.min().item<float>(), 0.0F);
  EXPECT_LT(h.max().item<float>(), 1.0F);
}

TEST(Networks, HaveTheAuthorsNumberOfWeights) {
  const Networks n{NetworkConfig{}};
  EXPECT_EQ(ParameterCount(*n.encoder), 442'088);  // as the authors count it
  EXPECT_EQ(ParameterCount(*n.value), 233'953);    // as the authors count it
  int64_t planning = 0;
  for (const auto& [name, module] : n.named()) {
    if (name.find("classifier") == std::string::npos) planning += ParameterCount(*module);
  }
  EXPECT_LT(planning * 2, 12'000'000) << "bytes of the bundled weights";
}

TEST(Networks, SuturingsSizesAndVariantsRun) {
  const torch::NoGradGuard no_grad;
  NetworkConfig config;
  config.image_width = 128;
  config.image_height = 96;
  config.num_actions = 16;
  config.transform_extra_stages = 1;
  for (const char* heads : {"paper", "costar"}) {
    config.heads = heads;
    config.activation = config.heads == "paper" ? "relu" : "leaky_relu";
    config.skip = config.heads == "paper";
    config.bottleneck = config.heads == "paper" ? "soft_argmax" : "strided";
    Networks n{config};
    const torch::Tensor h = n.encoder->forward(torch::rand({1, 3, 96, 128}));
    EXPECT_EQ(h.sizes(), (torch::IntArrayRef{1, 8, 12, 16}));
    const torch::Tensor a = torch::tensor({15});
    EXPECT_EQ(n.transform->forward(h, h, a).sizes(), h.sizes());
    EXPECT_EQ(n.q->forward(h, h, a).size(1), 16);
    EXPECT_EQ(n.value->forward(h).size(0), 1);
  }
}

NetworkConfig WithExtras(NetworkConfig config) {
  config.transform_action = "scale_and_shift";
  config.transform_mask = true;
  return config;
}

// Copies what both have by name.
void CopyShared(const Transform& from, Transform* to) {
  const torch::NoGradGuard no_grad;
  const auto known = from->named_parameters();
  for (auto& item : (*to)->named_parameters()) {
    if (const torch::Tensor* value = known.find(item.key())) item.value().copy_(*value);
  }
}

TEST(Networks, TsExtrasFitAllSizesAndEachChangesWhatItGives) {
  const torch::NoGradGuard no_grad;
  for (const int stages : {0, 1}) {
    NetworkConfig config = WithExtras(SmallConfig());
    config.image_width = config.image_height = 64;
    config.transform_extra_stages = stages;
    Transform with(config);
    with->eval();
    const torch::Tensor h = torch::rand({2, 8, 8, 8}), a = torch::tensor({0, 2});
    const torch::Tensor all = with->forward(h, h, a);
    EXPECT_EQ(all.sizes(), h.sizes());
    EXPECT_TRUE(all.gt(0).all().item<bool>() && all.lt(1).all().item<bool>());
    for (const bool mask : {false, true}) {
      NetworkConfig one = config;
      mask ? void(one.transform_mask = false) : void(one.transform_action = "bottleneck");
      Transform without(one);
      without->eval();
      CopyShared(with, &without);
      EXPECT_GT((without->forward(h, h, a) - all).abs().max().item<float>(), 1e-4F);
    }
  }
}

TEST(Networks, TsExtrasBeginAsIfTheyWereNotThere) {
  const torch::NoGradGuard no_grad;
  Transform plain(SmallConfig()), extended(WithExtras(SmallConfig()));
  plain->eval(), extended->eval();
  CopyShared(plain, &extended);
  extended->NeutraliseExtras();
  const torch::Tensor h = torch::rand({2, 8, 4, 4}), a = torch::tensor({0, 2});
  const torch::Tensor apart = (extended->forward(h, h, a) - plain->forward(h, h, a)).abs();
  EXPECT_LT(apart.max().item<float>(), 0.02F);  // the mask's 2 %
}

TEST(Blocks, InstanceNormCentresEachChannelOfEachPicture) {
  InstanceNorm norm(3);
  const torch::Tensor y = norm->forward(torch::rand({2, 3, 8, 8}) * 5 + 2);
  EXPECT_LT(y.mean({2, 3}).abs().max().item<float>(), 1e-5F);
  EXPECT_NEAR(y.var({2, 3}, false).mean().item<float>(), 1.0F, 1e-3F);
  const torch::Tensor same = torch::instance_norm(y, {}, {}, {}, {}, true, 0.1, 1e-5, false);
  EXPECT_LT((same - y).abs().max().item<float>(), 1e-4F);
}

TEST(Blocks, UpBlockDoublesAndEachInputPixelReachesItsNeighboursOnly) {
  UpBlock up(1, 1, BlockOptions{Activation::kNone, false, 0.0});
  torch::Tensor x = torch::zeros({1, 1, 6, 6});
  const torch::Tensor base = up->forward(x);
  x[0][0][2][3] = 1.0F;
  const torch::Tensor touched = (up->forward(x) - base).abs().gt(1e-9);
  EXPECT_EQ(base.sizes(), (torch::IntArrayRef{1, 1, 12, 12}));
  for (int r = 0; r < 12; ++r) {
    for (int c = 0; c < 12; ++c) {
      const bool near = std::abs(r / 2 - 2) <= 1 && std::abs(c / 2 - 3) <= 1;
      EXPECT_TRUE(near || !touched[0][0][r][c].item<bool>()) << r << " " << c;
    }
  }
}

TEST(Blocks, SpatialSoftArgmaxFindsAPeak) {
  torch::Tensor x = torch::zeros({1, 2, 5, 5});
  x[0][0][4][0] = 100.0F;  // last row, first column
  const torch::Tensor points = SpatialSoftArgmax(x);
  ASSERT_EQ(points.sizes(), (torch::IntArrayRef{1, 4}));
  EXPECT_NEAR(points[0][0].item<float>(), 1.0F, 1e-4F);
  EXPECT_NEAR(points[0][1].item<float>(), -1.0F, 1e-4F);
  EXPECT_NEAR(points[0][2].item<float>(), 0.0F, 1e-5F);
}

TEST(Blocks, NoActionIsAZeroRow) {
  const torch::Tensor rows = OneHot(torch::tensor({1, 3}), 3);
  EXPECT_TRUE(rows.equal(torch::tensor({{0.0F, 1.0F, 0.0F}, {0.0F, 0.0F, 0.0F}})));
}

TEST(Blocks, DropoutIsAFunctionOfItsSeedAndOffInInference) {
  const torch::Tensor x = torch::ones({1000});
  SeedDropout(5);
  const torch::Tensor a = Dropout(x, 0.25, true);
  SeedDropout(5);
  EXPECT_TRUE(Dropout(x, 0.25, true).equal(a));
  EXPECT_FALSE(Dropout(x, 0.25, true).equal(a));
  EXPECT_NEAR(a.mean().item<float>(), 1.0F, 0.1F);
  EXPECT_TRUE(Dropout(x, 0.25, false).equal(x));
}

class WeightsTest : public ::testing::Test {
 protected:
  WeightsTest() : networks_(SmallConfig()) {
    torch::manual_seed(3);
    for (const auto& [name, module] : networks_.named()) {
      if (name != "second_classifier") CollectTensors(name, *module, &tensors_);
    }
    metadata_ = {{"task", "made"},
                 {"network", networks_.config},
                 {"calibration", {{"refusal_threshold", 0.25}}}};
    path_ = folder_ / "w.safetensors";
    WriteWeights(path_, tensors_, metadata_);
  }
  std::string Bytes() const {
    std::ifstream in(path_, std::ios::binary);
    return std::string((std::istreambuf_iterator<char>(in)), {});
  }
  void Put(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }
  void ExpectRefused(const std::string& reason) const {
    for (const auto load : {LoadEngine, LoadTorchEngine}) {
      try {
        load(path_, 1);
        FAIL() << "expected a refusal: " << reason;
      } catch (const WeightsError& error) {
        const std::string what = error.what();
        EXPECT_NE(what.find("w.safetensors"), std::string::npos) << what;
        EXPECT_NE(what.find(reason), std::string::npos) << what;
      }
    }
  }
  TestFolder folder_;
  Networks networks_;
  std::map<std::string, torch::Tensor> tensors_;
  nlohmann::json metadata_;
  std::string path_;
};

TEST_F(WeightsTest, ComeBackAsSixteenBitFloats) {
  const WeightsFile file = ReadWeights(path_);
  EXPECT_EQ(file.metadata, metadata_);
  ASSERT_EQ(file.tensors.size(), tensors_.size());
  for (const auto& [name, tensor] : tensors_) {
    EXPECT_TRUE(ToTorch(file.tensors.at(name)).equal(tensor.to(torch::kHalf))) << name;
  }
  EXPECT_EQ(file.hash, WeightsFileHash(path_));
  EXPECT_FALSE(HasModule(file, "second_classifier"));
  EXPECT_TRUE(HasModule(file, "classifier"));
}

TEST_F(WeightsTest, TruncatedFilesAreRefused) {
  const std::string good = Bytes();
  Put(good.substr(0, good.size() - 10));
  ExpectRefused("truncated");
  Put(good.substr(0, 100));
  ExpectRefused("truncated");
  Put(good.substr(0, 3));
  ExpectRefused("too short");
}

TEST_F(WeightsTest, OtherFilesAreRefused) {
  Put("this is no weights file at all, but it is long enough to have a header");
  ExpectRefused("not a safetensors file");
  Put(std::string("\x02\0\0\0\0\0\0\0{}", 10));
  ExpectRefused("no metadata of ours");
  std::filesystem::remove(path_);
  ExpectRefused("cannot be opened");
}

std::string WithHeader(const std::string& header) {
  std::string length(8, '\0');
  for (std::size_t i = 0; i < 8; ++i) length[i] = static_cast<char>(header.size() >> 8 * i & 255);
  return length + header;
}

// One of the two would count, and which one is chance.
TEST_F(WeightsTest, ATensorThatIsNamedTwiceIsRefusedByName) {
  const std::string good = Bytes();
  std::size_t length = 0;
  for (int i = 7; i >= 0; --i)
    length = length << 8 | static_cast<unsigned char>(good[static_cast<std::size_t>(i)]);
  const std::string header = good.substr(8, length);
  const std::size_t at = header.find("\"f.out.bias\"");
  ASSERT_NE(at, std::string::npos);
  const std::string entry = header.substr(at, header.find('}', at) + 1 - at);
  Put(WithHeader(header.substr(0, header.rfind('}')) + "," + entry + "}") +
      good.substr(8 + length));
  ExpectRefused("tensor 'f.out.bias' twice");
}

TEST_F(WeightsTest, MetadataOfAnotherKindIsSaid) {
  Put(WithHeader(R"({"__metadata__": 5})"));
  ExpectRefused("'__metadata__' is of type number, where an object of texts belongs");
  Put(WithHeader(R"({"__metadata__": {"prospect": {}}})"));
  ExpectRefused("'prospect' in its '__metadata__' is of type object, where a text belongs");
  Put(WithHeader(R"({"__metadata__": {"prospect": "[1]"}})"));
  ExpectRefused("what its metadata holds is of type array, where an object belongs");
  Put(WithHeader(R"({"__metadata__": {"prospect": "{}"}})"));
  ExpectRefused("its metadata is empty");
  Put(WithHeader(R"({"__metadata__": {}})"));
  ExpectRefused("no metadata of ours");
  Put(WithHeader(R"({"__metadata__": {"prospect": "{\"task\": \"a\", \"task\": \"b\"}"}})"));
  ExpectRefused("'task' twice");
}

TEST_F(WeightsTest, AMissingTensorOrAnotherShapeIsRefusedByName) {
  auto some = tensors_;
  some.erase("f.out.bias");
  WriteWeights(path_, some, metadata_);
  ExpectRefused("f.out.bias");
  some = tensors_;
  some["value.out.bias"] = torch::zeros({2});
  WriteWeights(path_, some, metadata_);
  ExpectRefused("value.out.bias");
}

TEST_F(WeightsTest, AConfigurationThatIsNotUnderstoodIsRefused) {
  metadata_["network"]["heads"] = "other";
  WriteWeights(path_, tensors_, metadata_);
  ExpectRefused("configuration");
}

TEST_F(WeightsTest, ValuesThatSixteenBitsCannotHoldAreNotWritten) {
  tensors_["f.out.bias"] = torch::full({1}, 1e6F);
  EXPECT_THROW(WriteWeights(path_, tensors_, metadata_), WeightsError);
}

// What is not a number in the file is not a number in any answer.
TEST_F(WeightsTest, ATensorThatHoldsNoNumberIsRefusedByName) {
  std::map<std::string, StoredTensor> stored = ReadWeights(path_).tensors;
  std::string bytes = Bytes();
  const std::string& scale = stored.at("transform.merge.norm.scale").bytes;
  const std::size_t at = bytes.rfind(scale);
  ASSERT_NE(at, std::string::npos);
  bytes[at] = '\0', bytes[at + 1] = '\x7e';
  Put(bytes);
  ExpectRefused("values that are not numbers");
}

TEST(Half, IsWhatLibtorchMakesOfIt) {
  std::vector<float> values;
  for (int i = 0; i < 1 << 16; ++i) {
    StoredTensor one{
        StoredTensor::Type::kHalf, {1}, {static_cast<char>(i & 255), static_cast<char>(i >> 8)}};
    const float value = ToFloats(one).at(0);
    const float known = ToTorch(one).to(torch::kFloat).item<float>();
    ASSERT_TRUE(value == known || (std::isnan(value) && std::isnan(known))) << i;
    if (!std::isfinite(value)) continue;
    for (const float near :
         {value, std::nextafter(value, 1e9F), value * 1.0002441F, value * 1.001F})
      values.push_back(near);
  }
  const auto count = static_cast<std::int64_t>(values.size());
  const StoredTensor half = HalfTensor({count}, values);
  EXPECT_TRUE(ToTorch(half).equal(torch::tensor(values).to(torch::kHalf)));
}

TEST_F(WeightsTest, DamagedHeadersNeverCrashTheReader) {
  const std::string good = Bytes();
  for (std::size_t at = 0; at < 6000; at += 41) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x15);
    Put(bad);
    try {
      ReadWeights(path_);  // damage inside a name or a text may pass
    } catch (const WeightsError&) {
    }
  }
}

TEST(Precision, MixedIsNearAndEndsWithItsGuard) {
  torch::manual_seed(1);
  ConvBlock block(3, 8, 5, 1, BlockOptions{Activation::kNone, true, 0.0});
  const torch::Tensor x = torch::rand({2, 3, 16, 16});
  const torch::Tensor exact = block->forward(x);
  torch::Tensor mixed;
  {
    const MixedPrecision on(true);
    const MixedPrecision inner(false);  // does not switch off what is on
    mixed = block->forward(x);
  }
  EXPECT_EQ(mixed.dtype(), torch::kFloat);
  const float error = (mixed - exact).abs().max().item<float>();
  EXPECT_GT(error, 0.0F) << "it rounds";
  EXPECT_LT(error, 0.05F) << "of values with variance 1";
  EXPECT_TRUE(block->forward(x).equal(exact));
}

TEST(Precision, WhatNoNormFollowsStaysExactAndGradientsAreFloats) {
  torch::manual_seed(1);
  ConvBlock last(3, 8, 1, 1, BlockOptions{Activation::kSigmoid, false, 0.0});
  UpBlock up(3, 4, BlockOptions());
  const torch::Tensor x = torch::rand({2, 3, 16, 16});
  const torch::Tensor exact = last->forward(x);
  const MixedPrecision on(true);
  EXPECT_TRUE(last->forward(x).equal(exact));
  up->forward(x).square().sum().backward();
  for (const torch::Tensor& tensor : up->parameters()) {
    ASSERT_TRUE(tensor.grad().defined());
    EXPECT_EQ(tensor.grad().dtype(), torch::kFloat);
  }
}

class EngineTest : public WeightsTest {
 protected:
  EngineTest() : engine_(LoadTorchEngine(path_, 2)) {}
  std::vector<std::uint8_t> Picture(int seed) const {
    std::vector<std::uint8_t> picture(32 * 32 * 3);
    for (std::size_t i = 0; i < picture.size(); ++i) {
      picture[i] = static_cast<std::uint8_t>(i * static_cast<std::size_t>(seed + 3) / 7);
    }
    return picture;
  }
  std::unique_ptr<Engine> engine_;
};

void ExpectSame(const Prediction& a, const Prediction& b) {
  EXPECT_EQ(a.h, b.h);
  EXPECT_EQ(a.value, b.value);
  EXPECT_EQ(a.done, b.done);
  EXPECT_EQ(a.q, b.q);
  EXPECT_EQ(a.p, b.p);
}

TEST_F(EngineTest, SaysWhatItIs) {
  EXPECT_EQ(engine_->info().task, "made");
  EXPECT_EQ(engine_->info().num_actions, 3);
  EXPECT_EQ(engine_->info().hidden_size, 8 * 4 * 4);
  EXPECT_DOUBLE_EQ(engine_->info().refusal_threshold, 0.25);
  EXPECT_EQ(engine_->weights_hash(), WeightsFileHash(path_));
}

TEST_F(EngineTest, ARowDoesNotDependOnItsBatchMatesOrThreads) {
  std::vector<Hidden> states;
  for (int i = 0; i < 9; ++i) states.push_back(engine_->Encode(Picture(i)));
  std::vector<ExpandInput> rows;
  for (int i = 0; i < 9; ++i) rows.push_back({states[0], states[i], i % 3});
  const std::vector<Prediction> together = engine_->Expand(rows);
  const auto alone = LoadTorchEngine(path_, 1);
  ASSERT_EQ(together.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    ExpectSame(together[i], alone->Expand({rows[i]})[0]);
  EXPECT_NE(together[0].h, together[1].h);
  EXPECT_EQ(engine_->fingerprint(), alone->fingerprint());
}

TEST_F(EngineTest, AnswersAreThoseOfTheNetworks) {
  const torch::NoGradGuard no_grad;
  const WeightsFile file = ReadWeights(path_);
  for (const auto& [name, module] : networks_.named()) {
    if (HasModule(file, name)) LoadModule(file, path_, name, module);
  }
  networks_.SetTraining(false);
  const auto picture = Picture(2);
  const torch::Tensor x =
      torch::tensor(std::vector<float>(picture.begin(), picture.end())).view({1, 32, 32, 3}) /
      255.0;
  const torch::Tensor h = networks_.encoder->forward(x.permute({0, 3, 1, 2}).contiguous());
  const Hidden mine = engine_->Encode(picture);
  EXPECT_LT((torch::tensor(mine) - h.flatten()).abs().max().item<float>(), 1e-5F);
  const torch::Tensor next = networks_.transform->forward(h, h, torch::tensor({2}));
  const Prediction answer = engine_->Expand({{mine, mine, 2}})[0];
  EXPECT_LT((torch::tensor(answer.h) - next.flatten()).abs().max().item<float>(), 1e-5F);
  EXPECT_NEAR(answer.value, torch::sigmoid(networks_.value->forward(next)).item<float>(), 1e-5F);
  EXPECT_NEAR(answer.done,
              torch::sigmoid(networks_.f->forward(h, next, torch::tensor({2}))).item<float>(),
              1e-5F);
}

TEST_F(EngineTest, RootsAreDoneAndPicturesComeOut) {
  const Hidden h = engine_->Encode(Picture(1));
  const Prediction root = engine_->Evaluate(h, h, 3);
  EXPECT_EQ(root.done, 1.0F);
  EXPECT_TRUE(root.h.empty());
  EXPECT_EQ(root.p.size(), 3U);
  EXPECT_EQ(engine_->Decode({h, h}).at(1).size(), 32U * 32U * 3U);
  EXPECT_EQ(engine_->Classify(Picture(1)).size(), 3U);
  EXPECT_THROW(engine_->Expand({{h, h, 3}}), std::invalid_argument);
  EXPECT_THROW(engine_->Evaluate(h, h, 4), std::invalid_argument);
  EXPECT_THROW(engine_->Decode({Hidden(3)}), std::invalid_argument);
}

}  // namespace
}  // namespace prospect::model
