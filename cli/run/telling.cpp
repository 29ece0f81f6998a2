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
namespace {

// The commit of the sources; empty where git does not tell.
std::string AnswerOfGit() {
  base::ChildOptions git;
  git.command = {"/usr/bin/env", "git", "-C", DataFolder(""), "describe", "--always", "--dirty"};
  const base::ChildResult said = base::RunCaptured(git, std::chrono::seconds(10));
  return said.status == 0 ? said.out : "";
}

}  // namespace

int TellMessages() {
  Words files;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(DataFolder("lcmtypes"), none))
    if (entry.path().extension() == ".lcm") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  Words command{PathOf(IsInstalled() ? "schema_gen" : "../tools/schema_gen"), "--markdown"};
  command.insert(command.end(), files.begin(), files.end());
  return Become(command);
}

int TellVersion() {
  const std::string commit = IsInstalled() ? TextOf(DataFolder("commit")) : AnswerOfGit();
  std::printf("prospect %s (%s)\n", PROSPECT_VERSION,
              commit.empty() ? "no git" : LastLine(commit).c_str());
  return kExitSuccess;
}

int TellCompletion() {
  std::fputs(BashCompletion(Commands()).c_str(), stdout);
  return kExitSuccess;
}

}  // namespace prospect::cli
