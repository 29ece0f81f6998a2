#include "tasks/names.h"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace prospect::tasks {
namespace {

constexpr std::size_t kLongestTaskName = 32, kLongestName = 64, kLongestSentence = 200;
// Words of rules, which no name may be.
constexpr const char* kReserved[] = {"any", "any_other", "same", "other", "then"};

bool IsLetterOrDigit(char c) { return std::isalnum(static_cast<unsigned char>(c)) && c > 0; }
bool OfWord(char c) { return IsLetterOrDigit(c) || c == '_' || c == '-'; }

bool IsWord(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), OfWord);
}

std::string TooLong(const std::string& text, std::size_t most) {
  if (text.empty()) return "is empty: name it";
  if (text.size() <= most) return "";
  return "has " + std::to_string(text.size()) + " characters: use at most " + std::to_string(most);
}

std::string Forbidden(const std::string& text, bool (*may)(char), const char* remedy) {
  const auto found = std::find_if_not(text.begin(), text.end(), may);
  if (found == text.end()) return "";
  const bool shown = *found > ' ' && *found < 0x7f;
  const std::string culprit = *found == ' ' ? "a space"
                              : shown       ? "the character " + std::string(1, *found)
                                            : "a character that is no letter of ASCII";
  return "has " + culprit + ": " + remedy;
}

std::string ReservedDefect(const std::string& word) {
  const bool reserved =
      std::find(std::begin(kReserved), std::end(kReserved), word) != std::end(kReserved);
  return reserved ? "is a word of the rules: use another, such as " + word + "_one" : "";
}

// The first that says something.
std::string First(const std::string& a, const std::string& b) { return a.empty() ? b : a; }

}  // namespace

std::string TaskNameDefect(const std::string& name) {
  const auto may = [](char c) { return (OfWord(c) && !(c >= 'A' && c <= 'Z')); };
  const std::string wrong =
      First(TooLong(name, kLongestTaskName),
            Forbidden(name, may, "use lower-case letters, digits, '_' and '-', such as my_rover"));
  if (!wrong.empty()) return wrong;
  const bool begins = name[0] >= 'a' && name[0] <= 'z';
  return begins ? "" : "begins with no letter: put one before it, such as t" + name;
}

std::string ActionNameDefect(const std::string& name) {
  const auto may = [](char c) { return OfWord(c) || c == '(' || c == ')' || c == ','; };
  const std::string wrong = First(
      TooLong(name, kLongestName),
      Forbidden(name, may, "use letters, digits, '_' and '-', such as open_lid or pick(cup)"));
  if (!wrong.empty()) return wrong;
  const std::size_t open = name.find('(');
  if (open == std::string::npos && IsWord(name)) return ReservedDefect(name);
  const bool whole =
      open != std::string::npos && name.back() == ')' && IsWord(name.substr(0, open));
  std::string inside = whole ? name.substr(open + 1, name.size() - open - 2) : "";
  const bool words = whole && !inside.empty() && inside.front() != ',' && inside.back() != ',' &&
                     inside.find_first_of("()") == std::string::npos &&
                     inside.find(",,") == std::string::npos;
  if (!words) return "is not of the form open_lid, pick(cup) or put(cup,shelf): write it so";
  return First(ReservedDefect(name.substr(0, open)), ReservedDefect(inside));
}

std::string WordDefect(const std::string& word) {
  return First(First(TooLong(word, kLongestName),
                     Forbidden(word, OfWord, "use letters, digits, '_' and '-', such as red_cup")),
               ReservedDefect(word));
}

std::string PhraseDefect(const std::string& words) {
  const auto may = [](char c) { return OfWord(c) || c == ' ' || c == '.' || c == '(' || c == ')'; };
  return First(TooLong(words, kLongestName),
               Forbidden(words, may, "use letters, digits, spaces, '_', '-' and points"));
}

std::string SentenceDefect(const std::string& words) {
  const auto may = [](char c) {
    return static_cast<unsigned char>(c) >= ' ' && c != 0x7f && c != '<' && c != '>';
  };
  return First(TooLong(words, kLongestSentence),
               Forbidden(words, may, "write one line of words, without tags"));
}

NameParts PartsOf(const std::string& name) {
  const std::size_t open = name.find('(');
  if (open == std::string::npos) return {name, ""};
  return {name.substr(0, open), name.substr(open + 1, name.size() - open - 2)};
}

}  // namespace prospect::tasks
