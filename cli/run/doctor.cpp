// doctor: what a deployment needs of this machine, one line each, with the command that mends what
// is wrong.

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "base/child_process.h"
#include "base/exit_error.h"
#include "cli/installation.h"
#include "cli/report_file.h"
#include "cli/run/bus_place.h"
#include "cli/run/carriers.h"
#include "cli/run/deployment.h"
#include "cli/run/processes.h"

namespace prospect::cli {
namespace {

namespace fs = std::filesystem;

// What a check found; nothing to say of it where `words` is empty.
struct Finding {
  int code = kExitSuccess;  ///< what the command ends with if it is the first fault
  std::string words;
  std::string mend = {};  ///< a command; empty: none could
};

base::ChildResult AnswerOf(const Words& command) {
  base::ChildOptions options;
  options.command = command;
  return base::RunCaptured(options, std::chrono::seconds(60));
}

bool IsThere(const std::string& path, int mode = F_OK) { return access(path.c_str(), mode) == 0; }

std::string AsRoot(const std::string& command) {
  return geteuid() == 0 ? command : "sudo " + command;
}

// Builds all; empty where there are no sources.
std::string Setup() {
  const std::string script = DataFolder("prospect");
  return IsThere(script, X_OK) ? script + " setup" : "";
}

Finding Packages() {
  std::ifstream list(DataFolder("packages.txt"));
  if (!list) return {};  // installed as a package, which brings what it needs
  std::string missing;
  for (std::string line; std::getline(list, line);) {
    std::istringstream words(line);
    std::string name, scope;
    words >> name >> scope;
    if (scope != "build" && scope != "run") continue;
    const auto said = AnswerOf({"/usr/bin/env", "dpkg-query", "-W", "-f=${Status}", name});
    if (said.out.find("ok installed") == std::string::npos) missing += " " + name;
  }
  if (missing.empty()) return {0, "all of packages.txt"};
  return {kExitUsage, "missing:" + missing,
          AsRoot("apt-get install --no-install-recommends -y" + missing)};
}

Finding Programs() {
  const std::string folder = ProgramsFolder();
  if (IsThere(PathOf("prospect-executive"), X_OK) && IsThere(PathOf("prospect-supervisor"), X_OK))
    return {0, folder};
  return {kExitUsage, "not built in " + folder, Setup()};
}

Finding Route(const std::string& bus) {
  if (HasRoute(bus)) return {0, "there is one for " + bus};
  return {kExitBus, "no multicast route for " + bus + ": LCM cannot send",
          AsRoot("ip link set lo up") + " && " + AsRoot("ip route add 224.0.0.0/4 dev lo")};
}

// LCM asks the kernel for the buffer in its URL and gets at most rmem_max; with less, bursts are
// lost.
Finding ReceiveBuffer(const std::string& bus) {
  const std::string key = "recv_buf_size=";
  const std::size_t at = bus.find(key);
  const long want = at == std::string::npos ? 4194304 : std::atol(bus.c_str() + at + key.size());
  std::ifstream file("/proc/sys/net/core/rmem_max");
  long have = 0;
  if (!(file >> have)) return {0, "not to be seen in this namespace"};
  const std::string wanted = std::to_string(want), allowed = std::to_string(have) + " bytes";
  if (have >= want) return {0, allowed + " allowed, " + wanted + " asked for"};
  return {kExitBus,
          "the kernel allows " + allowed + ", " + wanted + " are asked for: bursts will be lost",
          AsRoot("sysctl -w net.core.rmem_max=" + wanted)};
}

// Sends a message to itself and listens for others.
Finding BusItself(const std::string& bus) {
  if (!IsThere(PathOf("prospect-bus"), X_OK) || !HasRoute(bus)) return {};
  const char* deployment = std::getenv("PROSPECT_DEPLOYMENT");
  const auto said = AnswerOf({PathOf("prospect-bus"), "probe", "--bus", bus, "--deployment",
                              deployment != nullptr && *deployment != '\0' ? deployment : "1"});
  return {said.status.value_or(kExitTimeout), WithoutError(LastLine(said.out + said.err))};
}

// Times in logs and recordings come from the clock; one that was never set is older than this
// program.
Finding Clock() {
  const auto now = fs::file_time_type::clock::now();
  std::string words = AnswerOf({"/usr/bin/env", "date", "--rfc-3339=seconds"}).out;
  words = LastLine(words);
  std::error_code none;
  const auto made = fs::last_write_time(fs::read_symlink("/proc/self/exe"), none);
  if (none || now >= made) return {0, words};
  return {kExitUsage, words + " is before this program was made",
          AsRoot("timedatectl set-ntp true")};
}

Finding Java() {
  const auto said = AnswerOf({"/usr/bin/env", "java", "-version"});
  if (said.status == 0) return {0, said.err.substr(0, said.err.find('\n'))};
  return {kExitUsage, "no java: all works but spy",
          AsRoot("apt-get install --no-install-recommends -y default-jre")};
}

Finding Jar() {
  for (const std::string& jar :
       {ProgramsFolder() + "/../share/prospect_types.jar", DataFolder("prospect_types.jar")})
    if (IsThere(jar)) return {0, fs::weakly_canonical(jar).string()};
  return {kExitUsage, "lcm-spy has no types of ours: not built", Setup()};
}

Finding Weights(const std::string& file) {
  if (!IsThere(PathOf("prospect-model-server"), X_OK)) return {};
  const auto said = AnswerOf({PathOf("prospect-model-server"), "--check", "--weights", file});
  if (said.status == 0) return {0, LastLine(said.out)};
  return {kExitWeights, WithoutError(LastLine(said.err)),
          IsInstalled() ? "" : "git -C " + DataFolder("") + " checkout -- model/weights"};
}

// What the model server may serve: classifiers read labels when scores are made.
Words WeightsFiles() {
  Words files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(DataFolder("model/weights"), none)) {
    const std::string path = entry.path().string();
    if (path.ends_with(".safetensors") && !path.ends_with("-classifiers.safetensors"))
      files.push_back(path);
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Tells what was found, and mends on consent.
class Doctor {
 public:
  explicit Doctor(const DoctorOptions& options) : options_(options) {}

  void Look(const char* name, const std::function<Finding()>& check) {
    Finding finding = check();
    if (finding.words.empty()) return;
    Say(name, finding);
    if (finding.code != 0 && !finding.mend.empty() && Consents() && Mend(finding.mend)) {
      const std::string tried = finding.mend;
      finding = check();
      if (finding.code != 0) Say("", {finding.code, "still so after: " + tried});
      if (finding.code == 0) Say(name, finding);
    }
    if (code_ == 0) code_ = finding.code;
    checks_.push_back({{"name", name},
                       {"ok", finding.code == 0},
                       {"words", finding.words},
                       {"mend", finding.code == 0 ? "" : finding.mend}});
  }

  int code() const { return code_; }
  nlohmann::json report() const { return {{"ok", code_ == 0}, {"checks", checks_}}; }

 private:
  void Say(const char* name, const Finding& finding) const {
    if (!options_.report.talks() && (finding.code == 0 || options_.report.json == "-")) return;
    std::printf("%-6s %-15s %s\n", finding.code == 0 ? "ok" : "FAULT", name, finding.words.c_str());
    if (finding.code != 0 && !finding.mend.empty())
      std::printf("%-6s %-15s mend it with: %s\n", "", "", finding.mend.c_str());
    std::fflush(stdout);
  }

  // Whether to run the command just shown: --yes, or a person says so.
  bool Consents() const {
    if (options_.mend) return true;
    if (!isatty(STDIN_FILENO) || !isatty(STDOUT_FILENO) || !options_.report.talks()) return false;
    std::printf("       Run it now? [y/N] ");
    std::fflush(stdout);
    std::string answer;
    std::getline(std::cin, answer);
    return answer == "y" || answer == "Y";
  }

  static bool Mend(const std::string& command) {
    return RunToEnd({"/usr/bin/env", "sh", "-c", command}) == 0;
  }

  const DoctorOptions& options_;
  int code_ = 0;
  nlohmann::json checks_ = nlohmann::json::array();
};

}  // namespace

int Run(const DoctorOptions& options) {
  const std::string bus = BusOf(options.bus);
  Deployment(bus).Join();
  Doctor doctor(options);
  doctor.Look("packages", Packages);
  doctor.Look("programs", Programs);
  doctor.Look("route", [&] { return Route(bus); });
  doctor.Look("receive buffer", [&] { return ReceiveBuffer(bus); });
  doctor.Look("bus", [&] { return BusItself(bus); });
  doctor.Look("clock", Clock);
  doctor.Look("java", Java);
  doctor.Look("jar", Jar);
  for (const std::string& file : WeightsFiles())
    doctor.Look("weights", [&] { return Weights(file); });
  WriteReport(options.report, doctor.report());
  return doctor.code();
}

}  // namespace prospect::cli
