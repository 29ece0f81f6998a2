#include "model/training/verdict.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "base/number_format.h"

namespace prospect::model {
namespace {

using nlohmann::json;

constexpr double kSurely = 2;           // standard errors
constexpr std::size_t kMostWanted = 3;  // kinds of examples that are named

struct Line {
  std::string what, found, trivial, words;
  bool better = false;
};

// Of a network that tells two kinds of cases apart; guessing has a balanced accuracy of 1/2.
Line HeadLine(const std::string& what, const json& s) {
  const double right = s.at("balanced_accuracy"), brier = s.at("brier");
  const double trivial = s.at("trivial_brier"), rate = s.at("base_rate");
  const double samples = s.at("samples");
  Line line{what, base::Number("%.1f %% right", 100 * right), "50 %", "", false};
  if (samples < 1 || rate <= 0 || rate >= 1) {
    line.found = "-";
    line.words = "cannot be told: the test trials hold one kind of case only";
    return line;
  }
  // Of the mean of two shares, each of the cases of one kind; their worst where one case more or
  // less is not yet seen.
  const double error = 0.5 * std::sqrt(0.25 / (rate * samples) + 0.25 / ((1 - rate) * samples));
  line.better = right > 0.5 + kSurely * error;
  if (!line.better) {
    line.words = right < 0.5 - kSurely * error ? "WORSE than guessing" : "NOT better than guessing";
  } else if (brier >= trivial) {
    line.words = "better than guessing, but its numbers are not: always saying " +
                 base::Number("%.2f", rate) + " is as close";
  } else {
    line.words = "better than guessing; its numbers are " +
                 base::Number("%.0f %% closer", 100 * (1 - brier / trivial)) +
                 " than always saying " + base::Number("%.2f", rate);
  }
  return line;
}

// Of imagined pictures: mean absolute error on the pixels that the action changes.
Line PictureLine(const std::string& what, const json& s) {
  const double error = s.at("mae_changed"), copying = s.at("copy_mae_changed");
  Line line{what, base::Number("error %.3f", error), base::Number("%.3f", copying), "",
            error < copying};
  line.words = line.better ? base::Number("%.0f %% less", 100 * (1 - error / copying)) +
                                 " than an unchanged picture"
                           : "NOT better than an unchanged picture";
  return line;
}

std::vector<Line> Lines(const json& scores) {
  const json& pictures = scores.at("pictures");
  std::vector<Line> lines{PictureLine("pictures after one action", pictures.at("x1")),
                          PictureLine("pictures after two", pictures.at("x2"))};
  if (!scores.contains("plan")) return lines;
  const std::pair<const char*, const char*> heads[] = {{"value", "V, will it succeed"},
                                                       {"f", "f, will the action get done"},
                                                       {"p", "p, is the action possible"},
                                                       {"q", "Q, is the action worth it"}};
  for (const auto& [head, what] : heads)
    lines.push_back(HeadLine(what, scores.at(head).at("imagined")));
  lines.push_back(HeadLine("whole plans, V times f", scores.at("plan")));
  return lines;
}

std::string Row(const std::string& what, const std::string& found, const std::string& trivial,
                const std::string& words) {
  char text[320];
  std::snprintf(text, sizeof text, "  %-30s %-13s %-10s %s\n", what.c_str(), found.c_str(),
                trivial.c_str(), words.c_str());
  return text;
}

// The fewer kind of examples of an action.
struct Rare {
  int examples = 0;
  std::string name, what;
};

std::string WantedWords(std::vector<Rare> rare) {
  std::stable_sort(rare.begin(), rare.end(),
                   [](const Rare& a, const Rare& b) { return a.examples < b.examples; });
  rare.resize(std::min<std::size_t>(rare.size(), kMostWanted));
  std::string wanted;
  for (const Rare& one : rare) {
    wanted += (wanted.empty() ? "" : ", ") + one.name + " " + one.what + " (" +
              std::to_string(one.examples) + " here)";
  }
  return "More trials would help most of: " + wanted + "\n";
}

}  // namespace

std::string PictureVerdict(const std::string& what, const json& scores) {
  const Line line = PictureLine(what, scores);
  return Row(what, line.found, line.trivial, line.words);
}

std::string HeadVerdict(const std::string& what, const json& scores) {
  const Line line = HeadLine(what, scores);
  return Row(what, line.found, line.trivial, line.words);
}

std::string ActionVerdict(const json& actions) {
  std::string guessed;
  std::vector<Rare> rare;
  for (const json& action : actions) {
    if (HeadLine("f", action).better) continue;
    const std::string name = action.at("name");
    const int samples = action.at("samples");
    const auto succeeded =
        static_cast<int>(std::lround(samples * action.at("base_rate").get<double>()));
    guessed += (guessed.empty() ? "" : ", ") + name + " (" + std::to_string(samples) +
               (samples == 1 ? " example)" : " examples)");
    const bool failures = 2 * succeeded >= samples;
    rare.push_back({failures ? samples - succeeded : succeeded, name,
                    failures ? "that fails" : "that succeeds"});
  }
  if (guessed.empty()) return "";
  return "Not better than guessing: f for " + guessed + "\n" + WantedWords(std::move(rare));
}

std::string Verdict(const json& scores) {
  const std::vector<Line> lines = Lines(scores);
  std::string text = "On " + std::to_string(scores.at("trials").get<std::size_t>()) +
                     " trials that were held out, of imagined states:\n";
  text += Row("", "found", "trivially", "");
  std::string failed;
  for (const Line& line : lines) {
    text += Row(line.what, line.found, line.trivial, line.words);
    if (!line.better) failed += (failed.empty() ? "" : "; ") + line.what;
  }
  if (failed.empty()) return text + "Everything was learned better than the trivial answer.\n";
  return text + "Not shown to be learned: " + failed +
         ". More trials or more iterations may mend it.\n";
}

}  // namespace prospect::model
