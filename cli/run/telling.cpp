// messages, version, completion: what prospect knows of itself.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "base/child_process.h"
#include "base/exit_error.h"
#include "cli/completion.h"
#include "cli/installation.h"
#include "cli/run/carriers.h"
#include "cli/run/processes.h"
#include "cli/table.h"

namespace prospect::cli {

int TellMessages() {
  Words files;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(DataFolder("lcmtypes"), none))
    if (entry.path().extension() == ".lcm") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  Words command{PathOf("../tools/schema_gen"), "--markdown"};
  command.insert(command.end(), files.begin(), files.end());
  return Become(command);
}

int TellVersion() {
  base::ChildOptions git;
  git.command = {"/usr/bin/env", "git", "-C", DataFolder(""), "describe", "--always", "--dirty"};
  const base::ChildResult said = base::RunCaptured(git, std::chrono::seconds(10));
  const std::string commit = said.status == 0 ? LastLine(said.out) : "no git";
  std::printf("prospect %s (%s)\n", PROSPECT_VERSION, commit.c_str());
  return kExitSuccess;
}

int TellCompletion() {
  std::fputs(BashCompletion(Commands()).c_str(), stdout);
  return kExitSuccess;
}

}  // namespace prospect::cli
