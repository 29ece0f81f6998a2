// spy: the bus in a window, by lcm-spy with our types, or in a terminal, by prospect-bus.

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "base/exit_error.h"
#include "cli/installation.h"
#include "cli/run/bus_place.h"
#include "cli/run/carriers.h"
#include "cli/run/deployment.h"
#include "cli/run/facts.h"
#include "cli/run/processes.h"
#include "cli/run/setting.h"

namespace prospect::cli {
namespace {

namespace fs = std::filesystem;

// Beside the programs in a build folder; with the data where it is installed.
std::string OurTypes() {
  const std::string built = ProgramsFolder() + "/../share/prospect_types.jar";
  std::error_code none;
  return fs::exists(built, none) ? built : DataFolder("prospect_types.jar");
}

void RequireFile(const std::string& file, const std::string& mend) {
  if (access(file.c_str(), R_OK) == 0) return;
  throw ExitError(kExitUnexpected, file + " is missing: " + mend);
}

// The number as it was typed: prospect-bus prints it.
int Survey(const SpyOptions& options, const Invocation& invocation) {
  TakeKey(options.bus.key);
  const std::string bus = BusOf(options.bus.bus);
  Deployment(bus).Join();
  Words command{PathOf("prospect-bus"),
                "check",
                "--bus",
                bus,
                "--seconds",
                invocation.app.get_option("--check")->reduced_results().front()};
  if (!options.report.json.empty()) command.insert(command.end(), {"--json", options.report.json});
  if (options.report.quiet) command.push_back("--quiet");
  return Become(command);
}

}  // namespace

Words ProgramsOf(const SpyOptions& options) {
  if (options.check > 0) return {"prospect-bus", "prospect-supervisor"};
  std::error_code none;
  return options.jar.empty() && !fs::exists(OurTypes(), none) ? Words{"prospect_types_jar"}
                                                              : Words{};
}

// Debian's own lcm-spy script asks Java for an option that Java 17 no longer has, and does not
// start; this does.
int Run(const SpyOptions& options, const Invocation& invocation) {
  if (options.check > 0) return Survey(options, invocation);
  const std::string jar = options.jar.empty() ? OurTypes() : options.jar;
  RequireFile(jar,
              "name it with --jar" + std::string(IsInstalled() ? "" : ", or run ./prospect setup"));
  const std::string java = "/usr/share/java/",
                    mend = "apt-get install liblcm-java libjchart2d-java";
  RequireFile(java + "lcm.jar", mend);
  RequireFile(java + "jchart2d.jar", mend);
  const char* display = std::getenv("DISPLAY");
  if (display == nullptr || *display == '\0')
    throw ExitError(kExitUnexpected, "there is no display; use " + Typed("spy --check SECONDS") +
                                         " for a list in the terminal");
  return Become({"java", "-Djava.net.preferIPv4Stack=true", "-Xmx256m", "-cp",
                 java + "lcm.jar:" + java + "jchart2d.jar:" + jar, "lcm.spy.Spy", "-l",
                 BusOf(options.bus.bus)});
}

}  // namespace prospect::cli
