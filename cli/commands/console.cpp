#include "cli/commands/console.h"

#include "cli/values.h"

namespace prospect::cli {

void Define(CLI::App& app, ConsoleOptions& options) {
  app.add_option("--log", options.log,
                 "show this recording, without a deployment: scrub, step, play it")
      ->type_name("FILE");
  app.add_flag("--control", options.control,
               "let the page start and stop episodes and change the number of workers; without it, "
               "it looks and touches nothing");
  app.add_option("--listen", options.listen,
                 "serve on this address of the machine, to whoever has the token that is printed "
                 "(default: 127.0.0.1, this machine alone)")
      ->type_name("ADDRESS");
  app.add_option("--port", options.port, "0: a free one (default: 7660, or a free one)")
      ->type_name("N")
      ->transform(Whole(0, 65535));
  app.add_option("--out", options.out,
                 "episodes started from the page leave their results in folders of this one")
      ->type_name("DIR")
      ->capture_default_str();
  app.add_option("--memory", options.memory_mb,
                 "what it may hold, MB; the oldest searches are dropped, and the page says so")
      ->type_name("MB")
      ->transform(Whole(32, 65536))
      ->capture_default_str();
  app.add_flag("!--no-browser", options.browser, "open no browser, even where there is a display");
  app.add_option("--url-file", options.url_file, "write its address to this file, too")
      ->type_name("FILE");
  app.add_option("--services-file", options.services_file,
                 "the services.json of a supervisor (default: of the deployment that is up)")
      ->type_name("FILE");
  DefineProcess(app, options.bus);
}

std::string Defect(const ConsoleOptions& options) {
  if (!options.log.empty() && options.control) return "--control is for a bus, not for --log";
  return "";
}

}  // namespace prospect::cli
