#pragma once

#include <string>

#include "services/executive/conversation.h"

namespace prospect::services {

// What a person at the terminal is asked. While one is thought about, the process goes on listening
// and saying that it lives, and a stop signal ends the wait.

/// Throws kExitUsage where nobody can answer: the input is no terminal.
void RequirePerson();

/// Says "`what`: set the scene up, then type Enter" and waits for it. Throws kExitInterrupted where
/// nobody can type Enter any more.
void AwaitEnter(Conversation& talk, const std::string& what);

/// Asks "`what`: did it work? [y/n]" until y, yes, n or no is typed. What was typed before the
/// question answers nothing. Throws kExitInterrupted where nobody can answer any more.
bool AskWhetherItWorked(Conversation& talk, const std::string& what);

}  // namespace prospect::services
