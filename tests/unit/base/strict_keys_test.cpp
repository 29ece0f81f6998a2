#include <gtest/gtest.h>

#include "base/strict_json.h"
#include "base/yaml_keys.h"

namespace prospect::base {
namespace {

std::string TwiceIn(const std::string& text) {
  try {
    ParseStrictJson(text);
  } catch (const KeyTwiceError& error) {
    return error.key;
  }
  return "";
}

TEST(StrictJson, RefusesAKeyThatComesTwiceAtAnyLevel) {
  EXPECT_EQ(TwiceIn(R"({"a": 1, "b": 2, "a": 3})"), "a");
  EXPECT_EQ(TwiceIn(R"({"a": {"b": [1, {"c": 1, "c": 2}]}})"), "a.b.c");
  EXPECT_EQ(TwiceIn(R"({"a": {"x": 1}, "b": {"x": 1}, "x": [{"a": 1}, {"a": 2}]})"), "");
}

TEST(StrictJson, IsElseTheSameParser) {
  EXPECT_EQ(ParseStrictJson(std::string(R"({"a": [1, 2.5, "x", null, true]})")),
            nlohmann::json::parse(R"({"a": [1, 2.5, "x", null, true]})"));
  EXPECT_TRUE(ParseStrictJson(std::string("no json")).is_discarded());
  EXPECT_TRUE(ParseStrictJson(std::string("")).is_discarded());
}

TEST(YamlKeys, FindsAKeyThatComesTwiceAtAnyLevel) {
  EXPECT_EQ(KeyTwice(YAML::Load("a: 1\nb: 2\na: 3\n")), "a");
  EXPECT_EQ(KeyTwice(YAML::Load("a:\n  - b: 1\n  - b: 1\n    b: 2\n")), "a[1].b");
  EXPECT_EQ(KeyTwice(YAML::Load("a: {x: 1}\nb: {x: 1}\n")), "");
}

}  // namespace
}  // namespace prospect::base
