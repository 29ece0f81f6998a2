#include "report/whole_mp4.h"

#include <cstdint>
#include <fstream>

namespace prospect::report {

bool IsWholeMp4(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::int64_t size = file.tellg();
  bool index = false;
  std::int64_t at = 0;
  while (file && at + 8 <= size) {
    unsigned char head[16] = {};
    file.seekg(at).read(reinterpret_cast<char*>(head), 8);
    std::uint64_t length = 0;
    for (int i = 0; i < 4; ++i) length = length << 8 | head[i];
    if (length == 1) {  // a long box: eight more bytes have its length
      file.read(reinterpret_cast<char*>(head + 8), 8);
      length = 0;
      for (int i = 8; i < 16; ++i) length = length << 8 | head[i];
    }
    if (!file || length < 8 || length > static_cast<std::uint64_t>(size - at)) return false;
    index = index || std::string(head + 4, head + 8) == "moov";
    at += static_cast<std::int64_t>(length);
  }
  return file && at == size && index;
}

}  // namespace prospect::report
