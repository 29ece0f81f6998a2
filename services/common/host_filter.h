#pragma once

#include <string>
#include <vector>

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
std::string ReachInWords(const std::string& url);

/// Keeps out of LCM's receiving socket what the bus does not promise to carry. LCM 1.3 binds that
/// socket to every address of the machine, so it would also take datagrams sent to the machine
/// alone, and multicast that comes in from outside; ttl=0 only limits what is sent. A filter on
/// the socket (socket(7), SO_ATTACH_FILTER; no rights needed) lets in datagrams to the bus's group
/// alone and, with ttl=0, only those that this machine sent. LCM does not show its sockets:
/// construct one before the bus is opened and call Attach() once it has been.
class HostFilter {
 public:
  HostFilter();
  /// Filters every UDP socket on the URL's port that was opened since; does nothing for a bus that
  /// is not udpm. @return whether it is in force: false must end the bus
  bool Attach(const std::string& url) const;

 private:
  std::vector<int> before_;
};

}  // namespace prospect::services
