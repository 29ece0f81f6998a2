// prospect-dataset: what a data set holds, joining trial files, a sheet of its pictures (DESIGN
// §5).

#include <png.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/dataset.h"

namespace prospect {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kExitUsage = 2, kExitDisk = 13, kExitData = 14;

json ToJson(const model::DataSetSummary& s) {
  json failures = json::object();
  for (const auto& [reason, count] : s.failures) failures[reason] = count;
  return {{"task", s.task},         {"world_version", s.world_version},
          {"trials", s.trials},     {"successes", s.successes},
          {"failures", failures},   {"frames", s.frames},
          {"segments", s.segments}, {"segments_succeeded", s.segments_succeeded},
          {"train", s.train},       {"valid", s.valid},
          {"test", s.test},         {"width", s.width},
          {"height", s.height},     {"num_actions", s.num_actions}};
}

void Print(const model::DataSetSummary& s) {
  std::printf("task            %s (%s)\n", s.task.c_str(), s.world_version.c_str());
  std::printf("trials          %zu: %zu train, %zu valid, %zu test\n", s.trials, s.train, s.valid,
              s.test);
  std::printf("successes       %zu (%.1f %%)\n", s.successes,
              100.0 * static_cast<double>(s.successes) /
                  static_cast<double>(std::max<std::size_t>(1, s.trials)));
  for (const auto& [reason, count] : s.failures) {
    std::printf("  failed by     %-24s %zu\n", reason.c_str(), count);
  }
  std::printf("actions         %zu carried out, %zu succeeded\n", s.segments, s.segments_succeeded);
  std::printf("frames          %zu of %dx%d\n", s.frames, s.width, s.height);
}

int Info(const std::string& path, const std::string& json_file) {
  const model::DataSetSummary summary = model::Summarize(model::TrialFile(path));
  Print(summary);
  if (json_file.empty()) return 0;
  std::ofstream out(json_file);
  out << ToJson(summary).dump(2) << '\n';
  if (!out.flush()) throw std::runtime_error(json_file + ": cannot be written");
  return 0;
}

/// Files as named; of folders every *.h5 inside.
std::vector<std::string> Expand(const std::vector<std::string>& inputs) {
  std::vector<std::string> files;
  for (const std::string& input : inputs) {
    if (!fs::is_directory(input)) {
      files.push_back(input);
      continue;
    }
    for (const auto& entry : fs::directory_iterator(input)) {
      if (entry.path().extension() == ".h5") files.push_back(entry.path().string());
    }
  }
  return files;
}

int Pack(const std::vector<std::string>& inputs, const std::string& out) {
  const std::size_t trials = model::PackTrialFiles(Expand(inputs), out);
  std::printf("%zu trials in %s\n", trials, out.c_str());
  return 0;
}

/// An RGB picture that pictures are pasted into.
class Sheet {
 public:
  Sheet(int width, int height)
      : width_(width), height_(height), rgb_(static_cast<std::size_t>(width * height) * 3, 255) {}

  void Paste(const std::uint8_t* picture, int width, int height, int left, int top) {
    for (int row = 0; row < height; ++row) {
      std::copy_n(picture + row * width * 3, width * 3,
                  rgb_.begin() + static_cast<long>((top + row) * width_ + left) * 3);
    }
  }

  void Write(const std::string& path) const {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width_);
    image.height = static_cast<png_uint_32>(height_);
    image.format = PNG_FORMAT_RGB;
    if (png_image_write_to_file(&image, path.c_str(), 0, rgb_.data(), 0, nullptr) == 0) {
      throw std::runtime_error(path + ": cannot be written (" + image.message + ")");
    }
  }

 private:
  int width_, height_;
  std::vector<std::uint8_t> rgb_;
};

/// The frames a sheet shows of a trial: the first of each segment, and the trial's last.
std::vector<int> KeyFrames(const model::Trial& trial) {
  std::vector<int> frames;
  int segment = -1;
  for (int i = 0; i < trial.frames(); ++i) {
    if (trial.segment[static_cast<std::size_t>(i)] == segment) continue;
    segment = trial.segment[static_cast<std::size_t>(i)];
    frames.push_back(i);
  }
  frames.push_back(trial.frames() - 1);
  return frames;
}

int WriteSheet(const std::string& path, const std::string& out, std::size_t rows) {
  constexpr int kGap = 2;
  const model::TrialFile file(path);
  std::vector<std::pair<std::size_t, std::vector<int>>> chosen;
  std::size_t columns = 0;
  model::Trial shape;
  for (std::size_t i = 0; i < std::min(rows, file.size()); ++i) {
    const model::Trial trial = file.ReadLabels(i);
    chosen.emplace_back(i, KeyFrames(trial));
    columns = std::max(columns, chosen.back().second.size());
    shape.width = trial.width;
    shape.height = trial.height;
  }
  if (chosen.empty()) throw model::DataError(path + ": has no trials");
  Sheet sheet(static_cast<int>(columns) * (shape.width + kGap),
              static_cast<int>(chosen.size()) * (shape.height + kGap));
  for (std::size_t row = 0; row < chosen.size(); ++row) {
    const auto& [trial, frames] = chosen[row];
    std::vector<std::uint8_t> pixels(frames.size() * shape.frame_bytes());
    file.ReadFrames(trial, frames, pixels.data());
    for (std::size_t k = 0; k < frames.size(); ++k) {
      sheet.Paste(pixels.data() + k * shape.frame_bytes(), shape.width, shape.height,
                  static_cast<int>(k) * (shape.width + kGap),
                  static_cast<int>(row) * (shape.height + kGap));
    }
  }
  sheet.Write(out);
  std::printf("%zu trials in %s: the first picture of each action, and the last\n", chosen.size(),
              out.c_str());
  return 0;
}

struct Arguments {
  std::string file, out, json_file;
  std::vector<std::string> inputs;
  std::size_t rows = 12;
};

int Dispatch(const CLI::App& app, const Arguments& a) {
  if (app.got_subcommand("info")) return Info(a.file, a.json_file);
  if (app.got_subcommand("pack")) return Pack(a.inputs, a.out);
  return WriteSheet(a.file, a.out, a.rows);
}

void AddCommands(CLI::App* app, Arguments* a) {
  app->require_subcommand(1);
  CLI::App* info = app->add_subcommand("info", "what a data set holds");
  info->add_option("FILE", a->file, "the data set")->required();
  info->add_option("--json", a->json_file, "write it here, too");
  CLI::App* pack = app->add_subcommand("pack", "joins trial files into one data set");
  pack->add_option("INPUTS", a->inputs, "trial files, data sets, or folders of them")->required();
  pack->add_option("--out", a->out, "the data set to write")->required();
  CLI::App* sheet = app->add_subcommand("sheet", "a picture of trials: a row each");
  sheet->add_option("FILE", a->file, "the data set")->required();
  sheet->add_option("--out", a->out, "the PNG to write")->required();
  sheet->add_option("--rows", a->rows, "trials to show")->check(CLI::Range(1, 200));
}

int RunGuarded(const CLI::App& app, const Arguments& a) {
  try {
    return Dispatch(app, a);
  } catch (const model::DataError& error) {
    std::fprintf(stderr, "prospect-dataset: %s\n", error.what());
    return kExitData;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "prospect-dataset: %s\n", error.what());
    return kExitDisk;
  }
}

}  // namespace
}  // namespace prospect

int main(int argc, char** argv) {
  CLI::App app("Data sets: what they hold, joining them, a sheet of their pictures.");
  prospect::Arguments arguments;
  prospect::AddCommands(&app, &arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : prospect::kExitUsage;
  }
  return prospect::RunGuarded(app, arguments);
}
