#include "cli/options/rule.h"

#include "cli/values.h"
#include "planner/selection_rule.h"

namespace prospect::cli {

CLI::Option* DefineRule(CLI::App& app, std::string& rule) {
  return app.add_option("--rule", rule, "selection rule of the search; planner/README.md")
      ->type_name("NAME")
      ->check(OneOf(planner::SelectionRuleNames()))
      ->default_str(rule.empty() ? "the one that the weights were calibrated with, else paper"
                                 : rule);
}

}  // namespace prospect::cli
