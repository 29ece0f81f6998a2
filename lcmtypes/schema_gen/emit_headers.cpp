#include <algorithm>

#include "lcmtypes/schema_gen/emit.h"

namespace prospect::schema_gen {
namespace {

bool IsCount(const Struct& type, const std::string& name) {
  return std::any_of(type.fields.begin(), type.fields.end(),
                     [&](const Field& field) { return field.count == name; });
}

void EmitVisit(const Struct& type, const Field& field, std::ostream& out) {
  const std::string& name = field.name;
  if (!field.count.empty()) {
    out << "    v.Array(\"" << name << "\", m." << field.count << ", m." << name << ");\n";
  } else {
    out << "    v." << (IsCount(type, name) ? "Count" : "Value") << "(\"" << name << "\", m."
        << name << ");\n";
  }
}

}  // namespace

void EmitAllTypes(const std::vector<Struct>& types, std::ostream& out) {
  out << "#pragma once\n// Made by schema_gen from the .lcm files.\n\n";
  for (const Struct& type : types) out << "#include \"prospect/" << type.name << ".hpp\"\n";
  out << "\n// X(type) for every message type.\n#define PROSPECT_MESSAGE_TYPES(X)";
  for (const Struct& type : types) out << " \\\n  X(" << type.name << ")";
  out << "\n";
}

void EmitFields(const std::vector<Struct>& types, std::ostream& out) {
  out << "#pragma once\n// Made by schema_gen from the .lcm files.\n\n"
         "#include \"lcmtypes/all_types.h\"\n\n"
         "namespace prospect::messages {\n\n"
         "// Fields<T>::Visit(message, visitor) calls visitor.Value(name, field) for plain fields, "
         ".Count(name, n) for\n"
         "// counts and .Array(name, n, vector) for arrays, in wire order.\n"
         "template <class T>\nstruct Fields {\n  static constexpr bool kIsMessage = false;\n};\n";
  for (const Struct& type : types) {
    out << "\ntemplate <>\nstruct Fields<" << type.name
        << "> {\n  static constexpr bool kIsMessage = true;\n"
           "  template <class M, class V>\n  static void Visit(M& m, V& v) {\n";
    for (const Field& field : type.fields) EmitVisit(type, field, out);
    out << "  }\n};\n";
  }
  out << "\n}  // namespace prospect::messages\n";
}

}  // namespace prospect::schema_gen
