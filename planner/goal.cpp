#include "planner/goal.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>

#include "base/nearest.h"
#include "base/text.h"

namespace prospect::planner {
namespace {

constexpr char kOpen[] = "*";
constexpr char kForms[] =
    "a goal is written as on(A,B), where * leaves a part open, such as on(red,blue), on(red,*) or "
    "visited(barrel,pylon)";
// From the bus, too, where anybody may ask for anything.
constexpr std::size_t kMostAtoms = 32, kMostSteps = 4096;
constexpr std::size_t kMostQuoted = 80;
constexpr int kMostStandings = 1 << 19;  // of all actions: what Prepare looks at for each step

bool IsOpen(const std::string& argument) { return argument == kOpen; }

std::string Short(const std::string& text) {
  return text.size() > kMostQuoted ? text.substr(0, kMostQuoted) + "..." : text;
}

[[noreturn]] void FailTooMuch() {
  throw GoalError("it asks for too much at once: leave some of it out");
}

class Parser {
 public:
  explicit Parser(const std::string& text) : text_(text) {}

  std::vector<GoalAtom> Parse() {
    for (SkipSeparators(); at_ < text_.size(); SkipSeparators()) ParseAtom();
    if (goal_.empty()) Fail("it is empty");
    return std::move(goal_);
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw std::invalid_argument("'" + Short(text_) + "' is no goal, " + what + ": " + kForms);
  }

  char Now() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  void SkipSpace() {
    while (std::isspace(static_cast<unsigned char>(Now()))) ++at_;
  }

  void SkipSeparators() {
    const auto separates = [](char c) {
      return c == ',' || c == ';' || std::isspace(static_cast<unsigned char>(c));
    };
    while (separates(Now())) ++at_;
  }

  std::string Word() {
    SkipSpace();
    const std::size_t begin = at_;
    const auto belongs = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '*';
    };
    while (belongs(Now())) ++at_;
    const std::string word = text_.substr(begin, at_ - begin);
    SkipSpace();
    return word;
  }

  void Expect(char c) {
    if (Now() != c) Fail(std::string("'") + c + "' is missing");
    ++at_;
  }

  std::string Argument() {
    const std::string word = Word();
    if (word.empty()) Fail("a name is missing");
    if (word == "*" || word == "_") return kOpen;
    if (word.find('*') != std::string::npos) Fail("'" + Short(word) + "' is no name");
    return word;
  }

  void ParseAtom() {
    GoalAtom atom{Word(), {}};
    if (atom.predicate.empty()) Fail("a word is missing");
    if (atom.predicate.find('*') != std::string::npos)
      Fail("'" + Short(atom.predicate) + "' is no word");
    Expect('(');
    atom.arguments.push_back(Argument());
    while (Now() == ',') ++at_, atom.arguments.push_back(Argument());
    Expect(')');
    if (std::find(goal_.begin(), goal_.end(), atom) != goal_.end()) return;
    if (goal_.size() == kMostAtoms || atom.arguments.size() > kMostAtoms) Fail("it is too long");
    goal_.push_back(std::move(atom));
  }

  const std::string& text_;
  std::size_t at_ = 0;
  std::vector<GoalAtom> goal_;
};

bool Meets(const GoalAtom& wish, const std::string& predicate,
           const std::vector<std::string>& arguments) {
  const auto fits = [](const std::string& wanted, const std::string& has) {
    return IsOpen(wanted) || wanted == has;
  };
  return wish.predicate == predicate && wish.arguments.size() == arguments.size() &&
         std::equal(wish.arguments.begin(), wish.arguments.end(), arguments.begin(), fits);
}

// "visited(A)", "on(A,B)": each form of what is known once.
std::set<std::string> FormsOf(const std::vector<GoalFact>& known) {
  std::set<std::string> forms;
  for (const GoalFact& fact : known) {
    std::vector<std::string> letters;
    for (std::size_t i = 0; i < fact.arguments.size(); ++i)
      letters.emplace_back(1, static_cast<char>('A' + i % 26));
    forms.insert(fact.predicate + "(" + base::Joined(letters, ",") + ")");
  }
  return forms;
}

// How many names a predicate has; 0: it is not known.
std::size_t NamesOf(const std::string& predicate, const std::vector<GoalFact>& known) {
  for (const GoalFact& fact : known) {
    if (fact.predicate == predicate) return fact.arguments.size();
  }
  return 0;
}

std::string NearestPredicate(const std::string& word, const std::vector<GoalFact>& known) {
  std::vector<std::string> words;
  for (const GoalFact& fact : known) words.push_back(fact.predicate);
  return base::NearestWord(Short(word), words);
}

void RequirePredicate(const GoalAtom& atom, const std::vector<GoalFact>& known) {
  if (known.empty()) throw GoalError("this task knows no goals: its task file names none");
  const std::size_t names = NamesOf(atom.predicate, known);
  const std::string forms = base::Joined(FormsOf(known));
  if (names == 0) {
    const std::string nearest = NearestPredicate(atom.predicate, known);
    throw GoalError("this task has no goal '" + Short(atom.predicate) + "': its goals are " +
                    forms + (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
  }
  if (names != 1 && names != atom.arguments.size())
    throw GoalError(ToString(atom) + " has " + std::to_string(atom.arguments.size()) +
                    " names, and not " + std::to_string(names) + ": the goals of this task are " +
                    forms);
}

void RequireNames(const GoalAtom& atom, const std::vector<GoalFact>& known) {
  std::set<std::string> names;
  for (const GoalFact& fact : known) names.insert(fact.arguments.begin(), fact.arguments.end());
  for (const std::string& name : atom.arguments) {
    if (IsOpen(name) || names.count(name)) continue;
    throw GoalError("there is no '" + Short(name) +
                    "' in this task; there are: " + base::Joined(names));
  }
}

bool IsIn(const GoalStep& step, const std::vector<GoalStep>& steps) {
  return std::find(steps.begin(), steps.end(), step) != steps.end();
}

// All facts as one, which holds while any of them does; where one could be undone while another
// holds, each for itself.
std::vector<GoalTerm::Fact> Together(std::vector<GoalTerm::Fact> facts) {
  GoalTerm::Fact all;
  for (const GoalTerm::Fact& fact : facts)
    all.brought_by.insert(all.brought_by.end(), fact.brought_by.begin(), fact.brought_by.end());
  for (const GoalTerm::Fact& fact : facts) {
    for (const GoalStep& step : fact.undone_by) {
      if (!IsIn(step, all.brought_by)) return facts;
    }
  }
  return {all};
}

void Append(const std::vector<GoalStep>& steps, char mark, std::string* text) {
  for (const GoalStep& step : steps) {
    *text += mark;
    if (step.previous >= 0) *text += std::to_string(step.previous) + ">";
    *text += std::to_string(step.action);
  }
}

// Of "on(red,blue)=12>17!12>18/13>17", what stands behind the words.
class TermReader {
 public:
  TermReader(const std::string& text, int num_actions) : text_(text), num_actions_(num_actions) {}

  GoalTerm Read() {
    GoalTerm term;
    at_ = text_.find('=');
    if (at_ == std::string::npos) Fail();
    term.words = text_.substr(0, at_);
    while (at_ < text_.size()) term.facts.push_back(ReadFact());
    return term;
  }

 private:
  [[noreturn]] void Fail() const { throw GoalError("'" + Short(text_) + "' is no term of a goal"); }

  GoalTerm::Fact ReadFact() {
    GoalTerm::Fact fact;
    if (text_[at_] == '/') ++at_;
    while (at_ < text_.size() && text_[at_] != '/') {
      const char mark = text_[at_++];
      if (mark != '=' && mark != '!') Fail();
      if (++steps_ > kMostSteps) FailTooMuch();
      (mark == '=' ? fact.brought_by : fact.undone_by).push_back(ReadStep());
    }
    if (fact.brought_by.empty()) Fail();
    return fact;
  }

  GoalStep ReadStep() {
    const int first = ReadAction();
    if (at_ == text_.size() || text_[at_] != '>') return {-1, first};
    ++at_;
    return {first, ReadAction()};
  }

  int ReadAction() {
    int action = 0;
    const std::size_t begin = at_;
    while (at_ < text_.size() && at_ < begin + 3 && text_[at_] >= '0' && text_[at_] <= '9')
      action = 10 * action + (text_[at_++] - '0');
    if (at_ == begin || action >= num_actions_) Fail();
    return action;
  }

  const std::string& text_;
  int num_actions_;
  std::size_t at_ = 0, steps_ = 0;
};

class Compiler {
 public:
  explicit Compiler(int num_actions) : num_actions_(static_cast<std::size_t>(num_actions)) {
    goal_.effects.resize(num_actions_ * (num_actions_ + 1));
  }

  GoalRules Compile(const std::vector<GoalTerm>& terms) {
    for (const GoalTerm& term : terms) {
      std::uint8_t any = 0;
      for (const GoalTerm::Fact& fact : term.facts) any |= Add(fact);
      goal_.required.push_back(any);
    }
    return std::move(goal_);
  }

 private:
  std::uint8_t Add(const GoalTerm::Fact& fact) {
    if (goal_.num_facts == GoalRules::kMaxFacts) FailTooMuch();
    const auto bit = static_cast<std::uint8_t>(1u << goal_.num_facts++);
    for (const GoalStep& step : fact.undone_by)
      ForEach(step, [bit](GoalRules::Effect& effect) { effect.clears |= bit; });
    for (const GoalStep& step : fact.brought_by) {
      ForEach(step, [bit](GoalRules::Effect& effect) {
        effect.sets |= bit;
        effect.clears &= static_cast<std::uint8_t>(~bit);
      });
    }
    return bit;
  }

  template <typename Change>
  void ForEach(const GoalStep& step, const Change& change) {
    const auto action = static_cast<std::size_t>(step.action);
    if (step.previous >= 0)
      return change(goal_.effects[static_cast<std::size_t>(step.previous) * num_actions_ + action]);
    for (std::size_t previous = 0; previous <= num_actions_; ++previous)
      change(goal_.effects[previous * num_actions_ + action]);
  }

  std::size_t num_actions_;
  GoalRules goal_;
};

std::string WordsOf(const std::vector<GoalTerm>& terms) {
  std::vector<std::string> words;
  for (const GoalTerm& term : terms) words.push_back(term.words);
  return base::Joined(words);
}

}  // namespace

std::vector<GoalAtom> ParseGoal(const std::string& text) { return Parser(text).Parse(); }

std::string ToString(const GoalAtom& atom) {
  return atom.predicate + "(" + base::Joined(atom.arguments, ",") + ")";
}

std::string ToString(const std::vector<GoalAtom>& goal) {
  std::string text;
  for (const GoalAtom& atom : goal) text += (text.empty() ? "" : ", ") + ToString(atom);
  return text;
}

bool Holds(const std::vector<GoalAtom>& goal, const std::vector<std::string>& facts) {
  std::vector<GoalAtom> known;
  for (const std::string& fact : facts) known.push_back(ParseGoal(fact).front());
  return std::all_of(goal.begin(), goal.end(), [&](const GoalAtom& wish) {
    return std::any_of(known.begin(), known.end(), [&](const GoalAtom& fact) {
      return Meets(wish, fact.predicate, fact.arguments);
    });
  });
}

std::vector<GoalAtom> ResolveGoal(const std::vector<GoalAtom>& goal,
                                  const std::vector<GoalFact>& known) {
  std::vector<GoalAtom> resolved;
  const auto add = [&resolved](GoalAtom atom) {
    if (std::find(resolved.begin(), resolved.end(), atom) == resolved.end())
      resolved.push_back(std::move(atom));
  };
  for (const GoalAtom& atom : goal) {
    RequirePredicate(atom, known);
    RequireNames(atom, known);
    if (NamesOf(atom.predicate, known) == atom.arguments.size()) {
      add(atom);
    } else {
      for (const std::string& name : atom.arguments) add({atom.predicate, {name}});
    }
  }
  return resolved;
}

std::vector<GoalTerm> TermsOf(const std::vector<GoalAtom>& goal,
                              const std::vector<GoalFact>& known) {
  std::vector<GoalTerm> terms;
  for (const GoalAtom& atom : ResolveGoal(goal, known)) {
    GoalTerm term{ToString(atom), {}};
    for (const GoalFact& fact : known) {
      if (Meets(atom, fact.predicate, fact.arguments))
        term.facts.push_back({fact.brought_by, fact.undone_by});
    }
    if (term.facts.empty()) throw GoalError("this task cannot bring about " + term.words);
    term.facts = Together(std::move(term.facts));
    terms.push_back(std::move(term));
  }
  return terms;
}

std::string ToString(const GoalTerm& term) {
  std::string text = term.words;
  for (std::size_t i = 0; i < term.facts.size(); ++i) {
    if (i > 0) text += '/';
    Append(term.facts[i].brought_by, '=', &text);
    Append(term.facts[i].undone_by, '!', &text);
  }
  return text;
}

GoalTerm ParseTerm(const std::string& text, int num_actions) {
  return TermReader(text, num_actions).Read();
}

void SetGoal(const std::vector<GoalTerm>& terms, TaskRules* rules) {
  rules->goal = {};
  rules->Validate();
  if (terms.size() > kMostAtoms) FailTooMuch();
  if (!terms.empty()) rules->goal = Compiler(rules->num_actions).Compile(terms);
  if (rules->num_actions * rules->tower.num_states << rules->goal.num_facts > kMostStandings)
    FailTooMuch();
  rules->Prepare();
  if (terms.empty() || !rules->AllowedActions({}, {}).empty()) return;
  throw GoalError("no plan of this task's " + std::to_string(rules->plan_length) +
                  (rules->plan_length == 1 ? " action" : " actions") + " brings about " +
                  WordsOf(terms) + (rules->tower.empty() ? "" : " in one tower"));
}

}  // namespace prospect::planner
