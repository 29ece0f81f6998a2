// What find_package(Prospect) gives beside the plain message types: codec, checks of values, key
// and filter.
//   rover KEYFILE
#include <cstdio>

#include "examples/keyed/keyed.h"
#include "lcmtypes/checked_codec.h"
#include "lcmtypes/messages.h"
#include "lcmtypes/validate.h"
#include "services/common/host_filter.h"

using namespace prospect;

namespace {

int failures = 0;

void Expect(bool holds, const char* what) {
  if (holds) return;
  std::printf("not so: %s\n", what);
  ++failures;
}

action_command_t Start() {
  action_command_t command{};
  command.kind = action_command_t::KIND_START;
  command.executive_id = 1;
  command.command_id = 7;
  return command;
}

}  // namespace

int main(int, char** argv) {
  const char* const kChannel = "ACTION_COMMAND";
  Keyed sender(argv[1]), receiver(argv[1]);
  Keyed::Bytes bytes = sender.Sign(kChannel, messages::CheckedEncode(Start()));
  Keyed::Bytes again = bytes;
  Expect(receiver.Verify(kChannel, &bytes), "a signed message is believed");
  Expect(!receiver.Verify(kChannel, &again), "it is not believed twice");

  const auto heard = messages::CheckedDecode<action_command_t>(bytes.data(), bytes.size());
  Expect(heard.ok() && heard.value.command_id == 7, "what was encoded is decoded");
  Expect(messages::Validate(heard.value).empty(), "its values are sound");
  const auto half = messages::CheckedDecode<action_command_t>(bytes.data(), bytes.size() / 2);
  Expect(!half.ok(), "half a message is refused");

  const services::HostFilter filter("udpm://239.255.76.67:7667?ttl=0");
  Expect(services::ReachOf("udpm://239.255.76.67:7667?ttl=0") == services::Reach::kThisMachine,
         "a bus without ttl reaches this machine only");
  return failures;
}
