#include "cli/completion.h"

#include "cli/help.h"

namespace prospect::cli {
namespace {

std::string OptionsOf(const Command& command) {
  if (!command.define) return "--help";
  CLI::App app;
  SetUp(app, command.name);
  const Bound bound = command.define(app);
  std::string words;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames())
      words += (words.empty() ? "--" : " --") + name;
  return words;
}

}  // namespace

std::string BashCompletion(const std::vector<Command>& commands) {
  std::string names, cases;
  for (const Command& command : commands) {
    names += (names.empty() ? "" : " ") + command.name.substr(0, command.name.find(' '));
    cases += "    '" + command.name + "') words='" + OptionsOf(command) + "' ;;\n";
  }
  std::string second;  // of commands of two words
  for (const Command& command : commands) {
    const std::size_t space = command.name.find(' ');
    if (space != std::string::npos)
      second += "    '2 " + command.name.substr(0, space) + "') words+=' " +
                command.name.substr(space + 1) + "' ;;\n";
  }
  return "# Completion of prospect's commands and options for bash, from the table of commands.\n"
         "_prospect() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} words= command=${COMP_WORDS[1]}\n"
         "  if [ \"$COMP_CWORD\" = 1 ]; then\n"
         "    words='" +
         names +
         " help'\n"
         "  else\n"
         "    case \"$command ${COMP_WORDS[2]}\" in\n" +
         cases + "    *) case \"$command\" in\n" + cases +
         "    esac ;;\n    esac\n  fi\n"
         "  case \"$COMP_CWORD $command\" in\n" +
         second +
         "  esac\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
         "  [ ${#COMPREPLY[@]} != 0 ] || COMPREPLY=($(compgen -f -- \"$word\"))\n"
         "}\n"
         "complete -o filenames -F _prospect prospect ./prospect\n";
}

}  // namespace prospect::cli
