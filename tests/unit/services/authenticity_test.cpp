#include "services/common/authenticity.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>

#include "base/exit_error.h"
#include "lcmtypes/checked_codec.h"

namespace prospect::services {
namespace {

using Bytes = std::vector<std::uint8_t>;

BusKey KeyOf(std::uint8_t first) {
  BusKey key;
  std::iota(key.bytes.begin(), key.bytes.end(), first);
  return key;
}

Bytes Text(const std::string& text) { return {text.begin(), text.end()}; }

std::string Hex(const std::uint8_t* bytes, std::size_t size) {
  std::string hex;
  char two[3];
  for (std::size_t i = 0; i < size; ++i) {
    std::snprintf(two, sizeof two, "%02x", bytes[i]);
    hex += two;
  }
  return hex;
}

Bytes Signed(MessageSigner* signer, const std::string& channel, const std::string& text) {
  Bytes bytes = Text(text);
  signer->Sign(channel, &bytes);
  return bytes;
}

// The vector is from Python: hmac.new(bytes(range(32)), b"ACTION_COMMAND\0start", "sha256").
TEST(KeyedMac, IsHmacSha256CutToTwelveBytes) {
  KeyedMac mac(KeyOf(0));
  const Bytes data = Text("start");
  std::uint8_t out[KeyedMac::kBytes];
  for (int again = 0; again < 2; ++again) {
    mac.Compute("ACTION_COMMAND", data.data(), data.size(), out);
    EXPECT_EQ(Hex(out, sizeof out), "cf04ddd177b0d4c49ab8ca71");
  }
}

TEST(Authenticity, ATaggedMessageIsBelievedAndLosesItsTag) {
  MessageSigner signer(KeyOf(1));
  MessageVerifier verifier(KeyOf(1));
  for (const char* text : {"", "a", "a longer message"}) {
    Bytes bytes = Signed(&signer, "PLAN", text);
    EXPECT_EQ(bytes.size(), std::string(text).size() + kTagBytes);
    EXPECT_EQ(verifier.Verify("PLAN", &bytes), nullptr);
    EXPECT_EQ(bytes, Text(text));
  }
}

TEST(Authenticity, EveryChangedBitIsRefused) {
  MessageSigner signer(KeyOf(1));
  MessageVerifier verifier(KeyOf(1));
  const Bytes good = Signed(&signer, "PLAN", "0123456789");
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    Bytes bad = good;
    bad[bit / 8] ^= static_cast<std::uint8_t>(1 << (bit % 8));
    EXPECT_STREQ(verifier.Verify("PLAN", &bad), "not authentic") << bit;
  }
  Bytes unharmed = good;
  EXPECT_EQ(verifier.Verify("PLAN", &unharmed), nullptr) << "a forgery must not use a number up";
}

TEST(Authenticity, AnotherKeyAnotherChannelNoTagAndHalfATagAreRefused) {
  MessageSigner signer(KeyOf(1));
  const Bytes good = Signed(&signer, "PLAN", "text");
  MessageVerifier stranger(KeyOf(2)), verifier(KeyOf(1));
  Bytes bytes = good;
  EXPECT_STREQ(stranger.Verify("PLAN", &bytes), "not authentic");
  EXPECT_STREQ(verifier.Verify("PLAN2", &bytes), "not authentic");
  bytes = Text("text");
  EXPECT_STREQ(verifier.Verify("PLAN", &bytes), "not authentic");
  bytes = {};
  EXPECT_STREQ(verifier.Verify("PLAN", &bytes), "not authentic");
  bytes.assign(good.end() - 20, good.end());
  EXPECT_STREQ(verifier.Verify("PLAN", &bytes), "not authentic");
}

TEST(Authenticity, NothingIsBelievedTwice) {
  MessageSigner signer(KeyOf(1)), other(KeyOf(1));
  MessageVerifier verifier(KeyOf(1));
  const Bytes first = Signed(&signer, "PLAN", "first");
  const Bytes second = Signed(&signer, "PLAN", "second");
  const Bytes third = Signed(&signer, "PLAN", "third");
  const auto verify = [&](Bytes bytes) { return verifier.Verify("PLAN", &bytes); };
  EXPECT_EQ(verify(first), nullptr);
  EXPECT_EQ(verify(third), nullptr);
  EXPECT_EQ(verify(second), nullptr) << "messages may overtake one another";
  for (const Bytes& again : {first, second, third}) EXPECT_STREQ(verify(again), "replayed");
  EXPECT_EQ(verify(Signed(&other, "PLAN", "first")), nullptr) << "another sender counts anew";
}

// Who comes later does not know what was said before: it may not be said again to them either.
TEST(Authenticity, WhatWasSaidBeforeTheFirstWordHeardIsNotBelieved) {
  MessageSigner signer(KeyOf(1));
  MessageVerifier late(KeyOf(1));
  Bytes before = Signed(&signer, "PLAN", "before");
  Bytes heard = Signed(&signer, "PLAN", "heard");
  EXPECT_EQ(late.Verify("PLAN", &heard), nullptr);
  EXPECT_STREQ(late.Verify("PLAN", &before), "replayed");
}

TEST(ReplayWindow, TakesEachNumberOnceAndNoneThatIsTooOld) {
  ReplayWindow window;
  EXPECT_FALSE(window.Take(0));
  EXPECT_TRUE(window.Take(10));
  EXPECT_FALSE(window.Take(9));
  EXPECT_TRUE(window.Take(12));
  EXPECT_TRUE(window.Take(11));
  EXPECT_FALSE(window.Take(11));
  EXPECT_TRUE(window.Take(12 + ReplayWindow::kWidth));
  EXPECT_FALSE(window.Take(12));
  EXPECT_TRUE(window.Take(13)) << "as old as may be, and not taken";
  EXPECT_FALSE(window.Take(13));
  EXPECT_TRUE(window.Take(1'000'000'000'000));
  EXPECT_FALSE(window.Take(13));
  EXPECT_TRUE(window.Take(1'000'000'000'000 - ReplayWindow::kWidth + 1));
}

TEST(UntaggedSize, IsThatOfTheMessage) {
  search_stop_t stop{};
  stop.reason = "budget";
  Bytes bytes = messages::CheckedEncode(stop);
  const std::size_t size = bytes.size();
  EXPECT_EQ(UntaggedSize(bytes.data(), size), size);
  MessageSigner(KeyOf(1)).Sign("SEARCH_STOP", &bytes);
  EXPECT_EQ(UntaggedSize(bytes.data(), bytes.size()), size);
  EXPECT_EQ(UntaggedSize(bytes.data(), size - 3), size - 3) << "half a message stays as it is";
  EXPECT_EQ(UntaggedSize(bytes.data(), 3), 3u);
}

class KeyFile : public testing::Test {
 protected:
  KeyFile() : path_(testing::TempDir() + "key-" + std::to_string(getpid())) {}
  ~KeyFile() override { std::filesystem::remove(path_); }

  void Write(const std::string& text, mode_t mode = 0600) {
    std::ofstream(path_) << text;
    chmod(path_.c_str(), mode);
  }
  std::string Defect() const {
    try {
      ReadBusKey(path_);
      return "";
    } catch (const ExitError& error) {
      EXPECT_EQ(error.code(), kExitUsage);
      return error.what();
    }
  }

  const std::string path_;
};

TEST_F(KeyFile, IsSixtyFourHexadecimalDigits) {
  std::string digits;
  for (int i = 0; i < 32; ++i) digits += Hex(&KeyOf(0).bytes[static_cast<std::size_t>(i)], 1);
  Write(digits + "\n");
  EXPECT_EQ(ReadBusKey(path_).bytes, KeyOf(0).bytes);
  for (const std::string& bad :
       {std::string(), digits.substr(1), digits + "0", "g" + digits.substr(1)}) {
    Write(bad);
    EXPECT_NE(Defect().find("is no key"), std::string::npos) << bad;
  }
}

TEST_F(KeyFile, ThatOthersCouldReadIsRefused) {
  const std::string digits(64, 'a');
  for (const mode_t mode : {0640, 0604, 0620, 0666}) {
    Write(digits, mode);
    EXPECT_NE(Defect().find("chmod 600"), std::string::npos) << mode;
  }
  Write(digits, 0400);
  EXPECT_EQ(Defect(), "");
}

TEST_F(KeyFile, ThatIsMissingIsNamed) {
  EXPECT_NE(Defect().find(path_ + " cannot be read: No such file"), std::string::npos) << Defect();
}

// What robots in other languages start from. Each signs for us, believes what we sign, and refuses
// what was changed.
class OtherLanguage : public KeyFile, public testing::WithParamInterface<const char*> {
 protected:
  std::string Run(const std::string& what, const std::string& channel, const std::string& input) {
    const std::string in = path_ + ".in", out = path_ + ".out";
    std::ofstream(in, std::ios::binary) << input;
    const std::string command = std::string(GetParam()) + " " + what + " " + path_ + " " + channel +
                                " <" + in + " >" + out + " 2>/dev/null";
    const bool worked = std::system(command.c_str()) == 0;
    std::ifstream file(out, std::ios::binary);
    std::string said{std::istreambuf_iterator<char>(file), {}};
    std::filesystem::remove(in);
    std::filesystem::remove(out);
    return worked ? said : "refused";
  }
};

TEST_P(OtherLanguage, SignsAndVerifiesAsWeDo) {
  std::string digits;
  for (int i = 0; i < 32; ++i) digits += Hex(&KeyOf(7).bytes[static_cast<std::size_t>(i)], 1);
  Write(digits + "\n");
  const std::string theirs = Run("sign", "TASK", "a message");
  Bytes bytes = Text(theirs);
  ASSERT_EQ(MessageVerifier(KeyOf(7)).Verify("TASK", &bytes), nullptr);
  EXPECT_EQ(bytes, Text("a message"));

  MessageSigner signer(KeyOf(7));
  Bytes ours = Signed(&signer, "TASK", "ours");
  EXPECT_EQ(Run("verify", "TASK", {ours.begin(), ours.end()}), "ours");
  EXPECT_EQ(Run("verify", "PLAN", {ours.begin(), ours.end()}), "refused");
  ours[0] ^= 1;
  EXPECT_EQ(Run("verify", "TASK", {ours.begin(), ours.end()}), "refused");
}

const char* const kNames[] = {"Python", "Java", "PlainCpp"};
INSTANTIATE_TEST_SUITE_P(All, OtherLanguage,
                         testing::Values("python3 " PROSPECT_KEYED "/keyed.py",
                                         "java " PROSPECT_KEYED "/Keyed.java", PROSPECT_KEYED_CPP),
                         [](const auto& one) { return std::string(kNames[one.index]); });

}  // namespace
}  // namespace prospect::services
