#pragma once

#include <ostream>
#include <vector>

#include "lcmtypes/schema_gen/lcm_file.h"

/// What schema_gen writes. `types` are in alphabetical order in all of them.
namespace prospect::schema_gen {

/// all_types.h: includes every generated type and lists their names in a macro, so that a test can
/// visit them all.
void EmitAllTypes(const std::vector<Struct>& types, std::ostream& out);

/// fields.h: Fields<T>::Visit for every type, which shows a visitor each field in wire order.
void EmitFields(const std::vector<Struct>& types, std::ostream& out);

/// schema_table.cpp: the table behind Schema(). @throws std::runtime_error for an unknown or
/// recursive struct, or too many fields
void EmitTable(const std::vector<Struct>& types, std::ostream& out);

/// The message reference for people, in Markdown.
void EmitMarkdown(const std::vector<Struct>& types, std::ostream& out);

}  // namespace prospect::schema_gen
