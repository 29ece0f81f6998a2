#include <map>
#include <stdexcept>

#include "lcmtypes/schema.h"
#include "lcmtypes/schema_gen/emit.h"

namespace prospect::schema_gen {
namespace {

struct Primitive {
  const char* kind;
  int bytes;  // least on the wire: a string has a length and its zero
};

const std::map<std::string, Primitive>& Primitives() {
  static const std::map<std::string, Primitive> kTable = {
      {"byte", {"kByte", 1}},     {"boolean", {"kBoolean", 1}}, {"int8_t", {"kInt8", 1}},
      {"int16_t", {"kInt16", 2}}, {"int32_t", {"kInt32", 4}},   {"int64_t", {"kInt64", 8}},
      {"float", {"kFloat", 4}},   {"double", {"kDouble", 8}},   {"string", {"kString", 5}}};
  return kTable;
}

// Answers what the table needs to know of a type across files.
class Types {
 public:
  explicit Types(const std::vector<Struct>& types) : types_(types) {
    for (std::size_t i = 0; i < types.size(); ++i) index_[types[i].name] = static_cast<int>(i);
  }

  int IndexOf(const std::string& name) const {
    const auto found = index_.find(name);
    if (found == index_.end()) throw std::runtime_error("no .lcm file defines the type " + name);
    return found->second;
  }

  // `depth` finds a struct that holds itself, which no finite message could carry.
  int MinBytes(const std::string& name, int depth = 0) const {
    if (IsPrimitive(name)) return Primitives().at(name).bytes;
    if (depth > 16) throw std::runtime_error("the type " + name + " holds itself");
    int sum = 0;
    for (const Field& field : types_[IndexOf(name)].fields) {
      const int element = MinBytes(field.type, depth + 1);
      if (field.count.empty()) sum += element;
    }
    return sum;
  }

 private:
  const std::vector<Struct>& types_;
  std::map<std::string, int> index_;
};

int CountIndex(const Struct& type, const std::string& count) {
  for (std::size_t i = 0; i < type.fields.size(); ++i) {
    if (!count.empty() && type.fields[i].name == count) return static_cast<int>(i);
  }
  return -1;
}

void EmitField(const Types& all, const Struct& type, const Field& field, std::ostream& out) {
  const bool primitive = IsPrimitive(field.type);
  out << "      {\"" << field.name
      << "\", FieldKind::" << (primitive ? Primitives().at(field.type).kind : "kStruct") << ", "
      << (primitive ? -1 : all.IndexOf(field.type)) << ", " << CountIndex(type, field.count) << ", "
      << all.MinBytes(field.type) << "},\n";
}

void EmitType(const Types& all, const Struct& type, std::ostream& out) {
  if (type.fields.size() > messages::kMaxFields) {
    throw std::runtime_error(type.name + " has too many fields: raise kMaxFields in schema.h");
  }
  out << "    {\"" << type.name << "\", " << type.name << "::getHash(), {\n";
  for (const Field& field : type.fields) EmitField(all, type, field, out);
  out << "    }, {\n";
  for (const Constant& constant : type.constants) {
    out << "      {\"" << constant.name << "\", " << constant.value << "},\n";
  }
  out << "    }, " << all.MinBytes(type.name) << "},\n";
}

}  // namespace

void EmitTable(const std::vector<Struct>& types, std::ostream& out) {
  const Types all(types);
  out << "// Made by schema_gen from the .lcm files.\n#include \"lcmtypes/all_types.h\"\n"
         "#include \"lcmtypes/schema.h\"\n\nnamespace prospect::messages {\n\n"
         "const std::vector<TypeSchema>& Schema() {\n"
         "  static const std::vector<TypeSchema> kTypes = {\n";
  for (const Struct& type : types) EmitType(all, type, out);
  out << "  };\n  return kTypes;\n}\n\n}  // namespace prospect::messages\n";
}

}  // namespace prospect::schema_gen
