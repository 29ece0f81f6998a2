#include "services/console/request_guard.h"

#include <arpa/inet.h>
#include <openssl/crypto.h>
#include <unistd.h>

#include <cctype>

#include "base/hash.h"
#include "services/common/ids.h"

namespace prospect::services::console {
namespace {

std::string MachineName() {
  char name[256] = {};
  return gethostname(name, sizeof name - 1) == 0 ? name : "";
}

std::string Lower(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

bool IsAddress(const std::string& text) {
  unsigned char bytes[16];
  return inet_pton(AF_INET, text.c_str(), bytes) == 1;
}

bool IsAddress6(std::string_view text) {
  if (text.size() < 4 || text.front() != '[' || text.back() != ']') return false;
  unsigned char bytes[16];
  return inet_pton(AF_INET6, std::string(text.substr(1, text.size() - 2)).c_str(), bytes) == 1;
}

}  // namespace

RequestGuard::RequestGuard(unsigned short port, std::string token)
    : port_(":" + std::to_string(port)), token_(std::move(token)), machine_(Lower(MachineName())) {}

bool RequestGuard::HostAllowed(std::string_view host) const {
  if (!host.ends_with(port_)) return false;
  const std::string name = Lower(host.substr(0, host.size() - port_.size()));
  return name == "localhost" || IsAddress(name) || IsAddress6(name) ||
         (!machine_.empty() && name == machine_);
}

bool RequestGuard::OriginAllowed(std::string_view origin, std::string_view host,
                                 bool needed) const {
  if (origin.empty()) return !needed;
  return origin == "http://" + std::string(host);
}

bool RequestGuard::TokenRight(std::string_view token) const {
  if (token_.empty()) return true;
  return token.size() == token_.size() &&
         CRYPTO_memcmp(token.data(), token_.data(), token_.size()) == 0;
}

std::string_view QueryValue(std::string_view target, std::string_view name) {
  const auto mark = target.find('?');
  if (mark == std::string_view::npos) return {};
  for (std::string_view rest = target.substr(mark + 1); !rest.empty();) {
    const auto end = std::min(rest.find('&'), rest.size());
    const std::string_view pair = rest.substr(0, end);
    if (pair.size() > name.size() && pair.starts_with(name) && pair[name.size()] == '=')
      return pair.substr(name.size() + 1);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return {};
}

std::string MakeToken() {
  const auto part = [] { return base::HexText(static_cast<std::uint64_t>(RandomId())); };
  return part() + part();
}

}  // namespace prospect::services::console
