#include "lcmtypes/schema_gen/emit.h"

namespace prospect::schema_gen {
namespace {

// A bar would end the table's cell.
std::string Cell(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c;
  }
  return result;
}

void EmitConstants(const Struct& type, std::ostream& out) {
  if (type.constants.empty()) return;
  out << "\n| constant | value | meaning |\n|---|---|---|\n";
  for (const Constant& constant : type.constants) {
    out << "| `" << constant.name << "` | " << constant.value << " | " << Cell(constant.comment)
        << " |\n";
  }
}

void EmitType(const Struct& type, std::ostream& out) {
  out << "\n## " << type.name << "\n\n"
      << type.comment << "\n\n| field | type | meaning |\n|---|---|---|\n";
  for (const Field& field : type.fields) {
    out << "| `" << field.name << "` | `" << field.type;
    if (!field.count.empty()) out << "[" << field.count << "]";
    out << "` | " << Cell(field.comment) << " |\n";
  }
  EmitConstants(type, out);
}

}  // namespace

void EmitMarkdown(const std::vector<Struct>& types, std::ostream& out) {
  out << "# Messages\n\nMade from `lcmtypes/*.lcm`; change those, not this page. Package "
         "`prospect`; numbers are big-endian on the wire, as LCM "
         "sends them.\n\n";
  for (const Struct& type : types) out << "- [" << type.name << "](#" << type.name << ")\n";
  for (const Struct& type : types) EmitType(type, out);
}

}  // namespace prospect::schema_gen
