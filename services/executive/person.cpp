#include "services/executive/person.h"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <iostream>

#include "base/exit_error.h"

namespace prospect::services {
namespace {

constexpr std::int64_t kForeverMs = INT64_C(1) << 40;

bool Typed() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  return poll(&input, 1, 0) > 0;
}

// The next line without its end. A terminal gives whole lines; of a pipe the rest is soon there.
std::string AwaitLine(Conversation& talk) {
  talk.Until(Typed, kForeverMs);
  std::string line;
  for (char letter = 0;;) {
    if (read(STDIN_FILENO, &letter, 1) != 1)
      throw ExitError(kExitInterrupted, "nobody can answer: the input has ended");
    if (letter == '\n') return line;
    line += letter;
  }
}

}  // namespace

void RequirePerson() {
  if (isatty(STDIN_FILENO) != 1)
    throw ExitError(kExitUsage, "--ask asks a person, and the input is no terminal");
}

void AwaitEnter(Conversation& talk, const std::string& what) {
  std::cerr << what << ": set the scene up, then type Enter" << std::endl;
  AwaitLine(talk);
}

bool AskWhetherItWorked(Conversation& talk, const std::string& what) {
  tcflush(STDIN_FILENO, TCIFLUSH);
  for (;;) {
    std::cerr << what << ": did it work? [y/n] " << std::flush;
    const std::string answer = AwaitLine(talk);
    if (answer == "y" || answer == "yes") return true;
    if (answer == "n" || answer == "no") return false;
  }
}

}  // namespace prospect::services
