#include "services/common/bus_key.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>

#include "base/exit_error.h"

namespace prospect::services {
namespace {

std::optional<BusKey> process_key;

int HexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

bool Parse(const std::string& digits, BusKey* key) {
  if (digits.size() != 2 * key->bytes.size()) return false;
  for (std::size_t i = 0; i < key->bytes.size(); ++i) {
    const int high = HexDigit(digits[2 * i]);
    const int low = HexDigit(digits[2 * i + 1]);
    if (high < 0 || low < 0) return false;
    key->bytes[i] = static_cast<std::uint8_t>(16 * high + low);
  }
  return true;
}

}  // namespace

BusKey ReadBusKey(const std::string& path) {
  // What is looked at is the file that is read, whatever the path may name by then.
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "re"),
                                                             &std::fclose);
  struct stat status {};
  if (!file || fstat(fileno(file.get()), &status) != 0) {
    throw ExitError(kExitUsage, "the key " + path + " cannot be read: " + std::strerror(errno));
  }
  if (status.st_mode & (S_IRWXG | S_IRWXO)) {
    throw ExitError(kExitUsage, "the key " + path + " is open to other users: chmod 600 " + path);
  }
  char line[2 * sizeof(BusKey) + 3] = {};
  std::string digits = std::fgets(line, sizeof line, file.get()) ? line : "";
  if (!digits.empty() && digits.back() == '\n') digits.pop_back();
  BusKey key;
  if (!Parse(digits, &key)) {
    throw ExitError(kExitUsage, path + " is no key: it must hold 64 hexadecimal digits");
  }
  return key;
}

const BusKey* ProcessBusKey() { return process_key ? &*process_key : nullptr; }

void SetProcessBusKey(const BusKey& key) { process_key = key; }

}  // namespace prospect::services
