#include "services/common/host_filter.h"

#include <arpa/inet.h>
#include <linux/filter.h>
#include <linux/if_packet.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>

namespace prospect::services {
namespace {

// LCM's own defaults.
constexpr char kGroup[] = "239.255.76.67";
constexpr int kPort = 7667;
constexpr std::string_view kUdp = "udpm://";
constexpr std::string_view kTtl = "ttl=";

int SmallestTtl(const std::string& url) {
  std::optional<int> smallest;
  for (auto at = url.find(kTtl); at != std::string::npos; at = url.find(kTtl, at + 1)) {
    const int ttl = std::atoi(url.c_str() + at + kTtl.size());
    smallest = std::min(ttl, smallest.value_or(ttl));
  }
  return smallest.value_or(0);
}

std::string HostAndPort(const std::string& url) {
  return url.substr(kUdp.size(), url.find_first_of("/?", kUdp.size()) - kUdp.size());
}

// In host order; 0 when it is none.
std::uint32_t GroupOf(const std::string& url) {
  const std::string place = HostAndPort(url);
  const std::string group = place.substr(0, place.find(':'));
  in_addr address{};
  inet_pton(AF_INET, group.empty() ? kGroup : group.c_str(), &address);
  return ntohl(address.s_addr);
}

int PortOf(const std::string& url) {
  const std::string place = HostAndPort(url);
  const auto colon = place.find(':');
  return colon == std::string::npos ? kPort : std::atoi(place.c_str() + colon + 1);
}

std::vector<int> OpenFiles() {
  std::vector<int> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", error)) {
    files.push_back(std::atoi(entry.path().filename().c_str()));
  }
  return files;
}

bool IsUdpSocketOn(int file, int port) {
  int type = 0;
  socklen_t size = sizeof type;
  if (getsockopt(file, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_DGRAM) return false;
  sockaddr_in name{};
  size = sizeof name;
  return getsockname(file, reinterpret_cast<sockaddr*>(&name), &size) == 0 &&
         name.sin_family == AF_INET && ntohs(name.sin_port) == port;
}

// The kernel runs it on each datagram: the jumps count instructions to skip. Where a value cannot
// be loaded the datagram is dropped.
bool Filter(int file, std::uint32_t group, bool this_machine_only) {
  constexpr std::uint32_t kDestination = static_cast<std::uint32_t>(SKF_NET_OFF + 16);
  constexpr std::uint32_t kInterface = static_cast<std::uint32_t>(SKF_AD_OFF + SKF_AD_IFINDEX);
  constexpr std::uint32_t kPacketType = static_cast<std::uint32_t>(SKF_AD_OFF + SKF_AD_PKTTYPE);
  const std::uint32_t loopback = if_nametoindex("lo");
  // What the machine sent itself comes by the loopback interface, or, where multicast is routed
  // to another one, is marked as a copy of what went out there.
  sock_filter local[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kDestination),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, group, 0, 5),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kInterface),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, loopback, 2, 0),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kPacketType),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, PACKET_LOOPBACK, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, 0xffffffff),
      BPF_STMT(BPF_RET | BPF_K, 0),
  };
  sock_filter wide[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kDestination),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, group, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, 0xffffffff),
      BPF_STMT(BPF_RET | BPF_K, 0),
  };
  sock_fprog program{};
  program.len = this_machine_only ? std::size(local) : std::size(wide);
  program.filter = this_machine_only ? local : wide;
  return setsockopt(file, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof program) == 0;
}

}  // namespace

bool IsUdpMulticast(const std::string& url) { return url.compare(0, kUdp.size(), kUdp) == 0; }

Reach ReachOf(const std::string& url) {
  if (IsUdpMulticast(url)) return SmallestTtl(url) > 0 ? Reach::kNetwork : Reach::kThisMachine;
  return url.compare(0, 7, "tcpq://") == 0 ? Reach::kRelay : Reach::kFile;
}

std::string ReachInWords(const std::string& url) {
  switch (ReachOf(url)) {
    case Reach::kThisMachine:
      return "this machine only";
    case Reach::kNetwork:
      return "the network (ttl=" + std::to_string(SmallestTtl(url)) + ")";
    case Reach::kRelay:
      return "whoever reaches the relay";
    case Reach::kFile:
      break;
  }
  return "no network";
}

HostFilter::HostFilter() : before_(OpenFiles()) {}

bool HostFilter::Attach(const std::string& url) const {
  if (!IsUdpMulticast(url)) return true;
  const std::uint32_t group = GroupOf(url);
  const bool local = ReachOf(url) == Reach::kThisMachine;
  int filtered = 0;
  for (const int file : OpenFiles()) {
    if (std::count(before_.begin(), before_.end(), file) || !IsUdpSocketOn(file, PortOf(url)))
      continue;
    if (!Filter(file, group, local)) return false;
    ++filtered;
  }
  return filtered > 0;
}

}  // namespace prospect::services
