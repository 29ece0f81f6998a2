#include "lcmtypes/schema.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <set>
#include <sstream>

#include "lcmtypes/messages.h"
#include "lcmtypes/schema_gen/emit.h"

namespace prospect {
namespace {

using messages::FieldKind;
using messages::FieldSchema;
using messages::TypeSchema;

TEST(Schema, HoldsEveryTypeUnderItsOwnFingerprint) {
  std::set<std::int64_t> fingerprints;
#define CHECK_TYPE(type)                                            \
  {                                                                 \
    const TypeSchema* found = messages::FindByName(#type);          \
    ASSERT_NE(found, nullptr) << #type;                             \
    EXPECT_EQ(found->fingerprint, type::getHash());                 \
    EXPECT_EQ(messages::FindByFingerprint(type::getHash()), found); \
    fingerprints.insert(found->fingerprint);                        \
  }
  PROSPECT_MESSAGE_TYPES(CHECK_TYPE)
#undef CHECK_TYPE
  EXPECT_EQ(fingerprints.size(), messages::Schema().size());
}

TEST(Schema, KnowsFieldsCountsAndConstants) {
  const TypeSchema& type = messages::SchemaOf<evaluation_t>();
  ASSERT_EQ(type.fields.size(), 7u);
  EXPECT_EQ(type.fields[0].kind, FieldKind::kStruct);
  EXPECT_STREQ(messages::Schema()[type.fields[0].struct_index].name, "path_t");
  EXPECT_STREQ(type.fields[5].name, "q");
  EXPECT_EQ(type.fields[5].count_field, 3);
  EXPECT_EQ(type.fields[5].min_bytes, 2);
  EXPECT_EQ(type.min_bytes, 4 + 4 + 4 + 4);

  const TypeSchema& command = messages::SchemaOf<action_command_t>();
  ASSERT_EQ(command.constants.size(), 3u);
  EXPECT_STREQ(command.constants[2].name, "KIND_CANCEL");
  EXPECT_EQ(command.constants[2].value, 2);
}

TEST(Schema, UnknownNamesAndFingerprintsAreNull) {
  EXPECT_EQ(messages::FindByName("nothing_t"), nullptr);
  EXPECT_EQ(messages::FindByFingerprint(12345), nullptr);
  EXPECT_EQ(messages::FingerprintOf("1234567", 7), 0);
}

// A .lcm file of the test's own, removed with the object.
class LcmText {
 public:
  explicit LcmText(const std::string& text)
      : path_("schema_test_" + std::to_string(getpid()) + ".lcm") {
    std::ofstream(path_) << text;
  }
  ~LcmText() { std::remove(path_.c_str()); }
  schema_gen::Struct Read() const { return schema_gen::ReadLcmFile(path_); }

 private:
  std::string path_;
};

TEST(LcmFile, ReadsFieldsConstantsAndComments) {
  const schema_gen::Struct type = LcmText(
                                      "package prospect;\n\n// What it is,\n// in two "
                                      "lines.\nstruct x_t\n{\n  int32_t num;  // how many\n"
                                      "  const int8_t A = -3;  // a value\n  byte data[num];  // "
                                      "first\n                   // second\n}\n")
                                      .Read();
  EXPECT_EQ(type.name, "x_t");
  EXPECT_EQ(type.comment, "What it is, in two lines.");
  ASSERT_EQ(type.fields.size(), 2u);
  EXPECT_EQ(type.fields[1].count, "num");
  EXPECT_EQ(type.fields[1].comment, "first second");
  ASSERT_EQ(type.constants.size(), 1u);
  EXPECT_EQ(type.constants[0].value, "-3");
}

TEST(LcmFile, RefusesWhatItDoesNotUnderstandByFileAndLine) {
  for (const char* body : {"int32_t a, b;", "byte data[7][n];", "byte data[n];", "enum { A };"}) {
    const LcmText file("package prospect;\nstruct x_t {\n" + std::string(body) + "\n}\n");
    try {
      file.Read();
      ADD_FAILURE() << body << " was taken";
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(".lcm:3: "), std::string::npos) << error.what();
    }
  }
}

TEST(LcmFile, RefusesOtherPackagesAndMissingFiles) {
  EXPECT_THROW(LcmText("package other;\nstruct x_t {\n}\n").Read(), std::runtime_error);
  EXPECT_THROW(schema_gen::ReadLcmFile("no/such/file.lcm"), std::runtime_error);
}

TEST(Table, RefusesUnknownAndRecursiveStructs) {
  std::ostringstream out;
  EXPECT_THROW(schema_gen::EmitTable({{"a_t", "", {{"b_t", "b", "", ""}}, {}}}, out),
               std::runtime_error);
  EXPECT_THROW(schema_gen::EmitTable({{"a_t", "", {{"a_t", "a", "", ""}}, {}}}, out),
               std::runtime_error);
}

TEST(Markdown, NamesEveryFieldWithItsComment) {
  const auto type =
      schema_gen::ReadLcmFile(std::string(LCM_FOLDER) + "/prospect_observation_t.lcm");
  std::ostringstream out;
  schema_gen::EmitMarkdown({type}, out);
  for (const schema_gen::Field& field : type.fields) {
    EXPECT_FALSE(field.comment.empty() && field.name != "data") << field.name << " has no comment";
    EXPECT_NE(out.str().find("| `" + field.name + "` |"), std::string::npos) << field.name;
  }
  EXPECT_NE(out.str().find("`byte[num_bytes]`"), std::string::npos);
  EXPECT_NE(out.str().find("| `ENCODING_RGB8` | 1 |"), std::string::npos);
}

}  // namespace
}  // namespace prospect
