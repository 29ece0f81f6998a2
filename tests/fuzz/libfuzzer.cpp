// A libFuzzer target for the type PROSPECT_FUZZ_TYPE: built with -DPROSPECT_FUZZ=ON by clang, run
// by tests/fuzz/libfuzzer.sh.

#include "tests/fuzz/one_payload.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const prospect::fuzz::Target& target = *prospect::fuzz::FindTarget(PROSPECT_FUZZ_TYPE);
  target.feed(data, size);
  return 0;
}
