#include "cli/run/processes.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "base/child_process.h"
#include "base/exit_error.h"
#include "base/stop_signals.h"
#include "cli/installation.h"

namespace prospect::cli {
namespace {

int RunWith(const Words& command, int output) {
  HeedSignals();
  base::ChildOptions options;
  options.command = command;
  options.out = output;
  options.err = output;
  options.death_signal = SIGTERM;
  base::ChildProcess child(options);
  const int status = child.Wait();
  return base::StopRequested() ? kExitInterrupted : status;
}

}  // namespace

void HeedSignals() {
  struct sigaction action {};
  action.sa_handler = [](int) { base::RequestStop(); };
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

std::string PathOf(const std::string& program) { return ProgramsFolder() + "/" + program; }

int Become(const Words& command) {
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  execvp(words[0], words.data());
  std::fprintf(stderr, "prospect: %s: %s\n", words[0], std::strerror(errno));
  return 127;
}

Words StartOf(const Command& command) {
  Words words{PathOf(command.program)};
  words.insert(words.end(), command.arguments.begin(), command.arguments.end());
  return words;
}

int RunToEnd(const Words& command) { return RunWith(command, -1); }

int RunToEnd(const Words& command, const std::string& log) {
  return RunWith(command, base::OpenOutput(log).get());
}

Said::Said() : file_(memfd_create("said", MFD_CLOEXEC)) {
  if (!file_) throw std::runtime_error(std::string("no memory file: ") + std::strerror(errno));
}

std::string Said::text() const {
  std::string text;
  char buffer[4096];
  ssize_t n = 0;
  while ((n = pread(file_.get(), buffer, sizeof buffer, static_cast<off_t>(text.size()))) > 0)
    text.append(buffer, static_cast<std::size_t>(n));
  return text;
}

std::string TextOf(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::string LastLine(const std::string& text) {
  std::istringstream lines(text);
  std::string last;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) last = line;
  return last;
}

std::string WithoutError(const std::string& said) {
  const std::string mark = "error: ";
  std::string words = said.starts_with(mark) ? said.substr(mark.size()) : said;
  while (words.ends_with('\n')) words.pop_back();
  return words;
}

}  // namespace prospect::cli
