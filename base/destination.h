#pragma once

#include <string>
#include <string_view>

namespace prospect::base {

/// What a path to be written to stands for.
struct Destination {
  enum class Kind {
    kNew,     ///< nothing is there yet
    kPlain,   ///< a plain file, which may be replaced
    kStream,  ///< a device, pipe, terminal or socket: it stays what it is and is written to
  };
  Kind kind = Kind::kNew;
  std::string path;     ///< with links followed, also where they lead to nothing
  int descriptor = -1;  ///< of a stream: this process's own (/dev/stdout, /dev/fd/3), else -1
};

/// Follows links and looks what is there. Throws DiskError for a folder, for links in a circle and
/// for what cannot be looked at.
Destination DestinationOf(const std::string& path);

/// Writes all of `bytes` to an open descriptor. @return 0, or the errno of what went wrong.
int WriteAll(int descriptor, std::string_view bytes);

/// Writes to a stream, behind whatever this process has printed. Waits for a reader where a pipe
/// has none, as a shell does. Throws DiskError.
void WriteStream(const Destination& stream, std::string_view bytes);

}  // namespace prospect::base
