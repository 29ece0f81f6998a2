#include "planner/goal.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "base/text.h"

namespace prospect::planner {
namespace {

constexpr char kOpen[] = "*";
constexpr char kOn[] = "on";
constexpr char kVisited[] = "visited";
constexpr char kVisitKind[] = "investigate";
constexpr char kForms[] =
    "a goal is on(A,B), where * leaves a part open, or visited(A,B,...), such as on(red,blue), "
    "on(red,*) or visited(barrel,pylon)";
// From the bus, too, where anybody may ask for anything.
constexpr std::size_t kMostAtoms = 32;
constexpr std::size_t kMostQuoted = 80;
constexpr int kMostStandings = 1 << 19;  // of all actions: what Prepare looks at for each step

bool IsOpen(const std::string& argument) { return argument == kOpen; }

std::string Listed(const std::set<std::string>& names) {
  return names.empty() ? "none" : base::Joined(names);
}

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
    for (SkipSeparators(); at_ < text_.size(); SkipSeparators()) ParseTerm();
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

  void ParseTerm() {
    const std::string predicate = Word();
    if (predicate != kOn && predicate != kVisited)
      Fail(predicate.empty() ? "a word is missing" : "there is no '" + Short(predicate) + "'");
    Expect('(');
    std::vector<std::string> arguments{Argument()};
    while (Now() == ',') ++at_, arguments.push_back(Argument());
    Expect(')');
    predicate == kOn ? AddOn(std::move(arguments)) : AddVisits(arguments);
  }

  void AddOn(std::vector<std::string> arguments) {
    if (arguments.size() != 2) Fail("on takes two names");
    Add({kOn, std::move(arguments)});
  }

  void AddVisits(const std::vector<std::string>& arguments) {
    for (const std::string& argument : arguments) {
      if (IsOpen(argument)) Fail("visited takes names only");
      Add({kVisited, {argument}});
    }
  }

  void Add(GoalAtom atom) {
    if (std::find(goal_.begin(), goal_.end(), atom) != goal_.end()) return;
    if (goal_.size() == kMostAtoms) Fail("it is too long");
    goal_.push_back(std::move(atom));
  }

  const std::string& text_;
  std::size_t at_ = 0;
  std::vector<GoalAtom> goal_;
};

bool Meets(const GoalAtom& wish, const GoalAtom& fact) {
  const auto fits = [](const std::string& wanted, const std::string& has) {
    return IsOpen(wanted) || wanted == has;
  };
  return wish.predicate == fact.predicate && wish.arguments.size() == fact.arguments.size() &&
         std::equal(wish.arguments.begin(), wish.arguments.end(), fact.arguments.begin(), fits);
}

// Of the atoms on(A,B) without open parts: a block lies on one other, carries one other, and is not
// above itself.
class Towers {
 public:
  void Add(const GoalAtom& atom) {
    const std::string& upper = atom.arguments[0];
    const std::string& lower = atom.arguments[1];
    if (!IsOpen(upper) && upper == lower) Fail(upper + " cannot be on itself");
    if (IsOpen(upper) || IsOpen(lower)) return;
    if (!below_.emplace(upper, lower).second) Fail(upper + " cannot be on two others");
    if (!carriers_.insert(lower).second) Fail("two cannot be on " + lower);
    for (auto at = below_.find(lower); at != below_.end(); at = below_.find(at->second)) {
      if (at->second == upper) Fail(upper + " cannot be above and below " + lower);
    }
  }

 private:
  [[noreturn]] static void Fail(const std::string& what) { throw GoalError(what); }

  std::map<std::string, std::string> below_;
  std::set<std::string> carriers_;
};

// Facts and their effects, from the table's words and successors.
class Compiler {
 public:
  Compiler(const std::vector<ActionWords>& words, const TaskRules& rules)
      : words_(words), handovers_(FindHandovers(words, rules)) {
    goal_.effects.resize(words.size() * (words.size() + 1));
    for (const ActionWords& row : words) {
      names_.insert(row.object);
      if (row.kind == kVisitKind) visits_.insert(row.object);
    }
  }

  GoalRules Compile(const std::vector<GoalAtom>& goal) {
    for (const GoalAtom& atom : goal) {
      atom.predicate == kOn ? RequireOn(atom) : RequireVisit(atom);
    }
    return std::move(goal_);
  }

 private:
  void RequireKnown(const std::string& name) const {
    if (IsOpen(name) || names_.contains(name)) return;
    throw GoalError("there is no '" + name + "' in this task; there are: " + Listed(names_));
  }

  std::uint8_t NewFact() {
    if (goal_.num_facts == GoalRules::kMaxFacts) FailTooMuch();
    return static_cast<std::uint8_t>(1u << goal_.num_facts++);
  }

  void RequireVisit(const GoalAtom& atom) {
    const std::string& name = atom.arguments[0];
    if (visits_.empty()) throw GoalError("this task visits nothing: its goals are on(A,B)");
    RequireKnown(name);
    if (!visits_.contains(name)) throw GoalError("this task cannot visit " + name);
    const std::uint8_t fact = NewFact();
    for (std::size_t action = 0; action < words_.size(); ++action) {
      if (words_[action].kind != kVisitKind || words_[action].object != name) continue;
      for (std::size_t previous = 0; previous <= words_.size(); ++previous)
        Effect(previous, action).sets |= fact;
    }
    goal_.required.push_back(fact);
  }

  void RequireOn(const GoalAtom& atom) {
    if (handovers_.empty())
      throw GoalError("this task puts nothing on anything: its goals are visited(A,...)");
    for (const std::string& name : atom.arguments) RequireKnown(name);
    towers_.Add(atom);
    const std::uint8_t facts = OnFacts(atom.arguments[0], atom.arguments[1]);
    if (facts == 0) throw GoalError("this task cannot bring about " + ToString(atom));
    goal_.required.push_back(facts);
  }

  // Where only the thing moved is open, any of several facts suffices: one for each thing, because
  // each may be moved on by itself.
  std::uint8_t OnFacts(const std::string& upper, const std::string& lower) {
    if (!IsOpen(upper) || IsOpen(lower)) return OnFact(upper, lower);
    std::uint8_t facts = 0;
    for (const std::string& name : names_) {
      if (name != lower) facts |= OnFact(name, lower);
    }
    return facts;
  }

  // 0: nothing in the table does that.
  std::uint8_t OnFact(const std::string& upper, const std::string& lower) {
    const auto known = facts_.find({upper, lower});
    if (known != facts_.end()) return known->second;
    const auto moves = [&](const Handover& h) {
      return IsOpen(upper) || words_[h.giver].object == upper;
    };
    const auto brings = [&](const Handover& h) {
      return moves(h) && (IsOpen(lower) || words_[h.taker].object == lower);
    };
    if (std::none_of(handovers_.begin(), handovers_.end(), brings)) return 0;
    const std::uint8_t fact = NewFact();
    for (const Handover& h : handovers_) {
      if (brings(h)) {
        Effect(h.giver, h.taker).sets |= fact;
      } else if (moves(h)) {
        Effect(h.giver, h.taker).clears |= fact;
      }
    }
    return facts_[{upper, lower}] = fact;
  }

  GoalRules::Effect& Effect(std::size_t previous, std::size_t action) {
    return goal_.effects[previous * words_.size() + action];
  }

  const std::vector<ActionWords>& words_;
  GoalRules goal_;
  Towers towers_;
  std::set<std::string> names_, visits_;
  std::vector<Handover> handovers_;
  std::map<std::pair<std::string, std::string>, std::uint8_t> facts_;
};

}  // namespace

std::vector<GoalAtom> ParseGoal(const std::string& text) { return Parser(text).Parse(); }

std::string ToString(const GoalAtom& atom) {
  std::string text;
  for (const std::string& argument : atom.arguments) text += (text.empty() ? "" : ",") + argument;
  return atom.predicate + "(" + text + ")";
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
    return std::any_of(known.begin(), known.end(),
                       [&](const GoalAtom& fact) { return Meets(wish, fact); });
  });
}

void SetGoal(const std::vector<GoalAtom>& goal, const std::vector<ActionWords>& words,
             TaskRules* rules) {
  rules->goal = {};
  rules->Validate();
  if (words.size() != static_cast<std::size_t>(rules->num_actions))
    throw std::invalid_argument("a goal needs the words of every action of the task");
  if (!goal.empty()) rules->goal = Compiler(words, *rules).Compile(goal);
  if (rules->num_actions * rules->tower.num_states << rules->goal.num_facts > kMostStandings)
    FailTooMuch();
  rules->Prepare();
  if (goal.empty() || !rules->AllowedActions({}, {}).empty()) return;
  throw GoalError("no plan of this task's " + std::to_string(rules->plan_length) +
                  (rules->plan_length == 1 ? " action" : " actions") + " brings about " +
                  ToString(goal) + (rules->tower.empty() ? "" : " in one tower"));
}

}  // namespace prospect::planner
