#include "tools/tables/report.h"

#include <cstdio>

namespace prospect::tools {
namespace {

enum class Form { kShare, kError, kDecibels };

struct Heading {
  Column column;
  const char* text;  // Markdown
  const char* name;  // CSV
  Form form;
};

constexpr Heading kHeadings[] = {
    {kX1Label, "x1 label, %", "x1_label", Form::kShare},
    {kX1Error, "x1 MAE", "x1_mae", Form::kError},
    {kX2Label, "x2 label, %", "x2_label", Form::kShare},
    {kX2Error, "x2 MAE", "x2_mae", Form::kError},
    {kX1Psnr, "x1 PSNR, dB", "x1_psnr", Form::kDecibels},
    {kX2Psnr, "x2 PSNR, dB", "x2_psnr", Form::kDecibels},
    {kX1Ssim, "x1 SSIM", "x1_ssim", Form::kError},
    {kX2Ssim, "x2 SSIM", "x2_ssim", Form::kError},
    {kX2LabelOfC, "x2 label by C, %", "x2_label_by_c", Form::kShare},
    {kX1Composed, "x1 MAE, composed", "x1_mae_composed", Form::kError},
    {kX2Composed, "x2 MAE, composed", "x2_mae_composed", Form::kError},
};

template <typename... Values>
std::string Text(const char* format, Values... values) {
  char text[160];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

std::vector<TrialSums> SumsOf(const Row& row, bool successful_only) {
  std::vector<TrialSums> sums;
  for (const Row::Trial& trial : row.trials) {
    if (!successful_only || trial.succeeded) sums.push_back(trial.sums);
  }
  return sums;
}

std::string Cell(const Estimate& e, Form form) {
  if (e.examples == 0) return "";
  if (form == Form::kShare)
    return Text("%.1f [%.1f, %.1f]", 100 * e.value, 100 * e.low, 100 * e.high);
  if (form == Form::kDecibels) return Text("%.2f [%.2f, %.2f]", e.value, e.low, e.high);
  return Text("%.4f [%.4f, %.4f]", e.value, e.low, e.high);
}

std::string MarkdownLine(const Line& line, bool successful_only) {
  std::string text = "| " + line.name + " |";
  const std::vector<TrialSums> sums =
      line.row ? SumsOf(*line.row, successful_only) : std::vector<TrialSums>();
  for (const Heading& heading : kHeadings) {
    text += " " + Cell(Bootstrap(sums, heading.column), heading.form) + " |";
  }
  if (!line.row) return text + " not trained | | |\n";
  text += Text(" %.0f |", Bootstrap(sums, kX1Error).examples);
  if (!line.is_model) return text + " | |\n";
  text += Text(" %lld |", static_cast<long long>(line.iterations));
  return text + (line.seconds > 0 ? Text(" %.0f |", line.seconds) : std::string(" |")) + "\n";
}

std::string DifferenceCell(const Estimate& e, Form form) {
  if (e.examples == 0) return "";
  if (form == Form::kShare)
    return Text("%+.1f [%+.1f, %+.1f]", 100 * e.value, 100 * e.low, 100 * e.high);
  return Text("%+.4f [%+.4f, %+.4f]", e.value, e.low, e.high);
}

constexpr int kCompared = 4;  // of kHeadings: labels and errors

std::string DifferencesLine(const Line& line, const Line& reference) {
  std::string text = "| " + line.name + " |";
  for (const bool successful_only : {true, false}) {
    const std::vector<TrialSums> sums = SumsOf(*line.row, successful_only);
    const std::vector<TrialSums> others = SumsOf(*reference.row, successful_only);
    for (int i = 0; i < kCompared; ++i) {
      const Heading& heading = kHeadings[i];
      const Estimate difference = BootstrapDifference(sums, others, heading.column);
      text += " " + DifferenceCell(difference, heading.form) + " |";
    }
  }
  return text + "\n";
}

std::string CsvCells(const Estimate& e) {
  if (e.examples == 0) return ",,,,";
  return Text(",%.6f,%.6f,%.6f,%.0f", e.value, e.low, e.high, e.examples);
}

std::string CsvLine(const Line& line, bool successful_only) {
  std::string text = std::string(successful_only ? "successful" : "all") + "," + line.name;
  const std::vector<TrialSums> sums =
      line.row ? SumsOf(*line.row, successful_only) : std::vector<TrialSums>();
  for (const Heading& heading : kHeadings) text += CsvCells(Bootstrap(sums, heading.column));
  if (!line.row || !line.is_model) return text + ",,\n";
  text += Text(",%lld", static_cast<long long>(line.iterations));
  return text + (line.seconds > 0 ? Text(",%.1f", line.seconds) : std::string(",")) + "\n";
}

}  // namespace

std::string MarkdownTable(const std::vector<Line>& lines, bool successful_only) {
  std::string text = "| model |", rule = "|---|";
  for (const Heading& heading : kHeadings) {
    text += std::string(" ") + heading.text + " |";
    rule += "---|";
  }
  text += " examples | iterations of T | seconds |\n" + rule + "---|---|---|\n";
  for (const Line& line : lines) text += MarkdownLine(line, successful_only);
  return text;
}

std::string DifferencesTable(const std::vector<Line>& lines, const Line& reference) {
  std::string rows;
  for (const Line& line : lines) {
    if (line.is_model && line.row && line.name != reference.name)
      rows += DifferencesLine(line, reference);
  }
  if (rows.empty()) return "";
  std::string text = "| less " + reference.name + " |", rule = "|---|";
  for (const char* trials : {"successful: ", "all: "}) {
    for (int i = 0; i < kCompared; ++i) {
      text += std::string(" ") + trials + kHeadings[i].text + " |";
      rule += "---|";
    }
  }
  return text + "\n" + rule + "\n" + rows;
}

std::string CsvTables(const std::vector<Line>& lines) {
  std::string text = "table,model";
  for (const Heading& heading : kHeadings) {
    const std::string name = heading.name;
    text += "," + name + "," + name + "_low," + name + "_high," + name + "_examples";
  }
  text += ",iterations,seconds\n";
  for (const bool successful_only : {true, false}) {
    for (const Line& line : lines) text += CsvLine(line, successful_only);
  }
  return text;
}

}  // namespace prospect::tools
