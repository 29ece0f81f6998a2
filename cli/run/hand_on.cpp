#include "cli/run/invocation.h"

namespace prospect::cli {

Words HandedOn(const CLI::App& app, const CLI::App& other) {
  Words words;
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() == 0 || option->get_lnames().empty()) continue;
    const std::string name = "--" + option->get_lnames().front();
    if (name == "--help" || other.get_option_no_throw(name) == nullptr) continue;
    if (option->get_expected_max() == 0) {
      words.push_back(name);
    } else {
      for (const std::string& value : option->reduced_results())
        words.push_back(name + "=" + value);
    }
  }
  return words;
}

}  // namespace prospect::cli
