#include "services/common/host_filter.h"

#include <arpa/inet.h>
#include <linux/filter.h>
#include <linux/if_packet.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <vector>

namespace prospect::services {
namespace {

// LCM's own defaults.
constexpr char kGroup[] = "239.255.76.67";
constexpr int kPort = 7667;
constexpr std::string_view kUdp = "udpm://";
constexpr std::string_view kTtl = "ttl=";

// As LCM reads it (strtol, any base); what is no number counts as LCM takes it, 0.
int SmallestTtl(const std::string& url) {
  std::optional<int> smallest;
  for (auto at = url.find(kTtl); at != std::string::npos; at = url.find(kTtl, at + 1)) {
    const int ttl = static_cast<int>(std::strtol(url.c_str() + at + kTtl.size(), nullptr, 0));
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

bool IsUdpSocket(int file) {
  int type = 0;
  socklen_t size = sizeof type;
  return getsockopt(file, SOL_SOCKET, SO_TYPE, &type, &size) == 0 && type == SOCK_DGRAM;
}

// What may be loaded beside the datagram's bytes. Offset 0 is the UDP header, so LCM's begins at 8.
constexpr auto kDestination = static_cast<std::uint32_t>(SKF_NET_OFF + 16);
constexpr auto kInterface = static_cast<std::uint32_t>(SKF_AD_OFF + SKF_AD_IFINDEX);
constexpr auto kPacketType = static_cast<std::uint32_t>(SKF_AD_OFF + SKF_AD_PKTTYPE);
constexpr std::uint32_t kLcm = 8;

// LCM's format: "LC02", sequence, channel, zero, message; or "LC03", sequence, size of the message,
// offset of this part, its number, number of parts, and, in part 0, channel and zero.
constexpr std::uint32_t kWhole = 0x4c433032, kPart = 0x4c433033;
constexpr std::uint32_t kWholeHeader = 8, kPartHeader = 20;
constexpr std::uint32_t kLongestChannel = 63;
constexpr std::uint32_t kLargestMessage = 1 << 24;  // LCM keeps no more of parts

/// A program for the kernel's filter (linux/filter.h): steps that go on or drop the datagram. Where
/// a value cannot be loaded, since the datagram has ended, it is dropped, too.
class Program {
 public:
  void Do(int code, std::uint32_t value) {
    steps_.push_back({static_cast<std::uint16_t>(code), 0, 0, value});
  }
  void Load(int size, std::uint32_t at) { Do(BPF_LD | BPF_ABS | size, at); }
  void Drop() { Do(BPF_RET | BPF_K, 0); }
  void Accept() { Do(BPF_RET | BPF_K, 0xffffffff); }
  /// Goes on where what was loaded compares so (JEQ, JGT, JGE) with `value`, or with register X.
  void Require(int condition, std::uint32_t value) {
    Jump(condition, value, 1, 0);
    Drop();
  }
  void Forbid(int condition, std::uint32_t value) {
    Jump(condition, value, 0, 1);
    Drop();
  }
  void AcceptIf(int condition, std::uint32_t value) {
    Jump(condition, value, 0, 1);
    Accept();
  }
  /// Skips what follows, up to SkipsTo(), where it compares so. @return to be given to SkipsTo()
  std::size_t SkipIf(int condition, std::uint32_t value) {
    Jump(condition, value, 0, 0);
    return steps_.size() - 1;
  }
  void SkipsTo(std::size_t from) {
    steps_[from].jt = static_cast<std::uint8_t>(steps_.size() - from - 1);
  }
  bool AttachTo(int file) {
    sock_fprog program{static_cast<std::uint16_t>(steps_.size()), steps_.data()};
    return setsockopt(file, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof program) == 0;
  }

 private:
  void Jump(int condition, std::uint32_t value, std::uint8_t yes, std::uint8_t no) {
    steps_.push_back({static_cast<std::uint16_t>(BPF_JMP | condition), yes, no, value});
  }

  std::vector<sock_filter> steps_;
};

// What the machine sent itself comes by the loopback interface, or, where multicast is routed to
// another one, is marked as a copy of what went out there.
void RequireThisMachine(Program* program) {
  program->Load(BPF_W, kInterface);
  const std::size_t loopback = program->SkipIf(BPF_JEQ, if_nametoindex("lo"));
  program->Load(BPF_W, kPacketType);
  program->Require(BPF_JEQ, PACKET_LOOPBACK);
  program->SkipsTo(loopback);
}

// A part after the first is let in here; of the first, the channel is still to be looked at.
void RequirePart(Program* program) {
  program->Require(BPF_JEQ, kPart);
  program->Load(BPF_W, kLcm + 8);
  program->Forbid(BPF_JGT, kLargestMessage);
  program->Load(BPF_W, kLcm + 12);
  program->Forbid(BPF_JGT, kLargestMessage);
  program->Do(BPF_ST, 0);  // the part's offset
  program->Load(BPF_H, kLcm + 18);
  program->Do(BPF_MISC | BPF_TAX, 0);
  program->Load(BPF_H, kLcm + 16);
  program->Forbid(BPF_JGE | BPF_X, 0);  // its number is one of them
  const std::size_t first = program->SkipIf(BPF_JEQ, 0);
  program->Do(BPF_LD | BPF_MEM, 0);
  program->Forbid(BPF_JEQ, 0);
  program->Accept();
  program->SkipsTo(first);
  program->Do(BPF_LD | BPF_MEM, 0);
  program->Require(BPF_JEQ, 0);
  program->Do(BPF_LDX | BPF_IMM, kLcm + kPartHeader);
}

void RequireLcm(Program* program) {
  program->Do(BPF_LDX | BPF_IMM, kLcm + kWholeHeader);
  program->Load(BPF_W, kLcm);
  const std::size_t whole = program->SkipIf(BPF_JEQ, kWhole);
  RequirePart(program);
  program->SkipsTo(whole);
  for (std::uint32_t i = 0; i <= kLongestChannel; ++i) {
    program->Do(BPF_LD | BPF_B | BPF_IND, i);
    program->AcceptIf(BPF_JEQ, 0);
  }
  program->Drop();
}

bool Filter(int file, const std::string& url) {
  Program program;
  program.Load(BPF_W, kDestination);
  program.Require(BPF_JEQ, GroupOf(url));
  if (ReachOf(url) == Reach::kThisMachine) RequireThisMachine(&program);
  RequireLcm(&program);
  return program.AttachTo(file);
}

// Of the HostFilter that lives on this thread.
thread_local const std::string* filtered_url = nullptr;
thread_local int filtered_sockets = 0;

bool IsPortOfTheBus(const sockaddr* address, socklen_t size) {
  if (size < sizeof(sockaddr_in) || address->sa_family != AF_INET) return false;
  return ntohs(reinterpret_cast<const sockaddr_in*>(address)->sin_port) == PortOf(*filtered_url);
}

}  // namespace

// In the C library's place, for LCM too, which calls it by this name.
extern "C" int bind(int file, const sockaddr* address, socklen_t size) noexcept {
  if (filtered_url && IsPortOfTheBus(address, size) && IsUdpSocket(file)) {
    if (!Filter(file, *filtered_url)) return -1;
    ++filtered_sockets;
  }
  return static_cast<int>(syscall(SYS_bind, file, address, size));
}

bool IsUdpMulticast(const std::string& url) { return url.starts_with(kUdp); }

Reach ReachOf(const std::string& url) {
  if (IsUdpMulticast(url)) return SmallestTtl(url) > 0 ? Reach::kNetwork : Reach::kThisMachine;
  return url.starts_with("tcpq://") ? Reach::kRelay : Reach::kFile;
}

std::string ReachText(const std::string& url) {
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

HostFilter::HostFilter(const std::string& url) : url_(url) {
  filtered_sockets = 0;
  filtered_url = IsUdpMulticast(url_) ? &url_ : nullptr;
}

HostFilter::~HostFilter() { filtered_url = nullptr; }

bool HostFilter::InForce() const { return !IsUdpMulticast(url_) || filtered_sockets > 0; }

}  // namespace prospect::services
