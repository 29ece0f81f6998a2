#pragma once

#include <string>
#include <vector>

/// What a .lcm file says, comments included. Read by a small line parser that takes the subset of
/// the language that our types use (one struct a file, one field a line, arrays of one dimension
/// counted by an earlier int32_t field) and refuses the rest by file and line.
namespace prospect::schema_gen {

struct Field {
  std::string type;  ///< as written: "int32_t", "path_t", ...
  std::string name;
  std::string count;    ///< name of the field that counts this array; empty: no array
  std::string comment;  ///< without slashes, lines joined
};

struct Constant {
  std::string type;
  std::string name;
  std::string value;
  std::string comment;
};

struct Struct {
  std::string name;
  std::string comment;
  std::vector<Field> fields;
  std::vector<Constant> constants;
};

/// Parses one file. @throws std::runtime_error with file, line and what is not understood
Struct ReadLcmFile(const std::string& path);

/// Whether a field's type is one of LCM's own and no struct.
bool IsPrimitive(const std::string& type);

}  // namespace prospect::schema_gen
