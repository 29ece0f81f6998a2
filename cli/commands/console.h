#pragma once

#include <optional>
#include <string>

#include "cli/fwd.h"
#include "cli/options/bus.h"

namespace prospect::cli {

struct ConsoleOptions {
  BusOptions bus;
  std::string log;            ///< a recording in the place of a bus; empty: none
  std::string listen;         ///< address; empty: loopback
  std::optional<int> port;    ///< left out: 7660, or a free one where that is taken
  bool control = false;       ///< the page may run, stop and scale
  std::string out = "out";    ///< folder in which runs leave their results
  int memory_mb = 128;        ///< what it may hold
  bool browser = true;        ///< opens one where there is a display
  std::string url_file;       ///< where its address is written, too; empty: nowhere
  std::string services_file;  ///< a supervisor's services.json; empty: none is known
};
void Define(CLI::App& app, ConsoleOptions& options);
std::string Defect(const ConsoleOptions& options);

}  // namespace prospect::cli
