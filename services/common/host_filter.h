#pragma once

#include <string>

namespace prospect::services {

/// How far the bus at `url` reaches.
enum class Reach {
  kThisMachine,  ///< udpm with ttl=0: nothing leaves, and nothing from outside is heard
  kNetwork,      ///< udpm with a ttl of 1 or more
  kRelay,        ///< tcpq: whoever reaches the relay
  kFile,         ///< file and the like: no network at all
};

/// Whether the bus at `url` is UDP multicast (udpm).
bool IsUdpMulticast(const std::string& url);

/// As the URL says; udpm without a ttl is LCM's 0, and of two the smaller counts.
Reach ReachOf(const std::string& url);

/// In words for a person: "this machine only", "the network (ttl=1)", ...
std::string ReachText(const std::string& url);

/// Keeps out of LCM's receiving socket what the bus does not promise to carry, and what LCM cannot
/// bear. LCM 1.3 binds that socket to every address of the machine, so it would also take datagrams
/// sent to the machine alone, and multicast that comes in from outside (ttl=0 only limits what is
/// sent); and it trusts the headers of what it takes: a channel without its end, or a part of a
/// message beyond its size, ends the process. A filter on the socket (socket(7), SO_ATTACH_FILTER;
/// no rights needed) lets in datagrams to the bus's group alone, whole by LCM's format, and, with
/// ttl=0, only those that this machine sent. LCM does not show its sockets: while a HostFilter
/// lives, what its thread binds to the URL's port gets the filter first, so nothing unfiltered is
/// ever queued. This header and its source need nothing else of Prospect.
class HostFilter {
 public:
  explicit HostFilter(const std::string& url);
  ~HostFilter();
  HostFilter(const HostFilter&) = delete;
  HostFilter& operator=(const HostFilter&) = delete;
  /// To be asked once LCM has opened its sockets (it does at the first subscription). @return
  /// whether the filter is in force, or none is needed; false must end the bus
  bool InForce() const;

 private:
  std::string url_;
};

}  // namespace prospect::services
