// The jar for lcm-spy holds every message type with the fingerprint that the C++ programs use:
// found as lcm-spy finds them, by a scan of the classes.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <memory>

#include "lcmtypes/schema.h"

namespace prospect::messages {
namespace {

std::map<std::string, std::int64_t> TypesInJar() {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(LIST_JAR_TYPES, "r"), pclose);
  std::map<std::string, std::int64_t> types;
  char name[128];
  long long fingerprint = 0;
  while (pipe && std::fscanf(pipe.get(), "%127s %lld", name, &fingerprint) == 2)
    types[name] = fingerprint;
  return types;
}

TEST(Jar, HoldsEveryTypeWithItsFingerprint) {
  std::map<std::string, std::int64_t> expected;
  for (const TypeSchema& type : Schema()) expected[type.name] = type.fingerprint;
  EXPECT_EQ(TypesInJar(), expected);
}

}  // namespace
}  // namespace prospect::messages
