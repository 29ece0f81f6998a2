// Turns the .lcm files into what code and people need to know of them:
//   schema_gen --out DIR FILE.lcm...    writes all_types.h, fields.h and schema_table.cpp into DIR
//   schema_gen --markdown FILE.lcm...   prints the message reference
#include <algorithm>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "lcmtypes/schema_gen/emit.h"

namespace prospect::schema_gen {
namespace {

using Emit = void (*)(const std::vector<Struct>&, std::ostream&);

std::vector<Struct> ReadAll(const std::vector<std::string>& paths) {
  std::vector<Struct> types;
  for (const std::string& path : paths) types.push_back(ReadLcmFile(path));
  std::sort(types.begin(), types.end(),
            [](const Struct& a, const Struct& b) { return a.name < b.name; });
  return types;
}

void Write(const std::string& path, Emit emit, const std::vector<Struct>& types) {
  std::ostringstream text;
  emit(types, text);
  std::ofstream file(path);
  if (!(file << text.str()) || !file.flush()) throw std::runtime_error(path + " cannot be written");
}

void WriteCode(const std::string& folder, const std::vector<Struct>& types) {
  Write(folder + "/all_types.h", EmitAllTypes, types);
  Write(folder + "/fields.h", EmitFields, types);
  Write(folder + "/schema_table.cpp", EmitTable, types);
}

int Run(std::vector<std::string> arguments) {
  if (arguments.size() >= 2 && arguments[0] == "--markdown") {
    EmitMarkdown(ReadAll({arguments.begin() + 1, arguments.end()}), std::cout);
    return 0;
  }
  if (arguments.size() >= 3 && arguments[0] == "--out") {
    WriteCode(arguments[1], ReadAll({arguments.begin() + 2, arguments.end()}));
    return 0;
  }
  std::cerr << "usage: schema_gen --out DIR FILE.lcm... | --markdown FILE.lcm...\n";
  return 2;
}

}  // namespace
}  // namespace prospect::schema_gen

int main(int argc, char** argv) {
  try {
    return prospect::schema_gen::Run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "schema_gen: " << error.what() << "\n";
    return 1;
  }
}
