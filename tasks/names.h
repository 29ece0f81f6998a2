#pragma once

#include <string>
#include <vector>

namespace prospect::tasks {

// Which names a task file may give. Each function says what is wrong with a name and what helps;
// empty: nothing. Names travel on the bus, in file names, command lines and pages, so that no
// character of theirs may mean anything there.

/// Of a task: lower-case letters, digits, '_' and '-', a letter first, at most 32.
std::string TaskNameDefect(const std::string& name);

/// Of an action: "open_lid", "pick(cup)", "put(cup,shelf)": words of letters, digits, '_' and '-',
/// at most 64 characters.
std::string ActionNameDefect(const std::string& name);

/// Of a kind or an object that names are made of: one word of letters, digits, '_' and '-'.
std::string WordDefect(const std::string& word);

/// Of a kind or object that is only shown to people: spaces and points, too.
std::string PhraseDefect(const std::string& words);

/// Of words for people, such as a cause's: one line of at most 200 bytes.
std::string SentenceDefect(const std::string& words);

/// An action's name taken apart: "pick(cup)" is of the kind "pick" and about "cup"; "open_lid" of
/// the kind "open_lid", about nothing.
struct NameParts {
  std::string kind;
  std::string object;
};
NameParts PartsOf(const std::string& name);

}  // namespace prospect::tasks
