#include "services/common/bus_url.h"

#include <cstdlib>
#include <fstream>

#include "cli/options/bus.h"
#include "services/common/host_filter.h"

namespace prospect::services {
namespace {

constexpr char kBufferOption[] = "recv_buf_size=";
constexpr long kDefaultBuffer = 4194304;

std::string FirstChoice(const std::string& option) {
  if (!option.empty()) return option;
  const char* environment = std::getenv("LCM_DEFAULT_URL");
  return environment && *environment ? environment : cli::kDefaultBusUrl;
}

long RequestedBuffer(const std::string& url) {
  const auto at = url.find(kBufferOption);
  return at == std::string::npos ? 0 : std::atol(url.c_str() + at + sizeof(kBufferOption) - 1);
}

}  // namespace

std::string ResolveBusUrl(const std::string& option) {
  std::string url = FirstChoice(option);
  if (IsUdpMulticast(url) && url.find(kBufferOption) == std::string::npos) {
    url += url.find('?') == std::string::npos ? '?' : '&';
    url += kBufferOption + std::to_string(kDefaultBuffer);
  }
  return url;
}

long ReceiveBufferLimit() {
  std::ifstream file("/proc/sys/net/core/rmem_max");
  long limit = 0;
  return file >> limit ? limit : 0;
}

std::string ReceiveBufferWarning(const std::string& url) {
  const long wanted = RequestedBuffer(url);
  const long limit = ReceiveBufferLimit();
  if (!IsUdpMulticast(url) || limit == 0 || wanted <= limit) return "";
  return "the host cuts the bus's receive buffer from " + std::to_string(wanted) + " to " +
         std::to_string(limit) +
         " bytes, so bursts may be lost; mend it with: sysctl -w net.core.rmem_max=" +
         std::to_string(wanted);
}

std::string BusAdvice(const std::string& url) {
  if (url.starts_with("tcpq://")) {
    return "cannot open the bus '" + url +
           "': no relay answers there: start the relay (docs/network.md), or check host and port "
           "of "
           "the URL (--bus or LCM_DEFAULT_URL)";
  }
  if (!IsUdpMulticast(url)) {
    return "cannot open the bus '" + url +
           "': the URL must be like udpm://239.255.76.67:7667?ttl=0 (also tcpq://HOST:PORT, "
           "file://LOG)";
  }
  return "cannot open the bus '" + url +
         "': most likely there is no multicast route. On one machine, run as root: "
         "ip link set lo up; ip route add 224.0.0.0/4 dev lo. Otherwise check address and port of "
         "the URL (--bus or LCM_DEFAULT_URL)";
}

}  // namespace prospect::services
