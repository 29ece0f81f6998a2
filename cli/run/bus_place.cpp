#include "cli/run/bus_place.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <random>

#include "base/child_process.h"
#include "base/descriptor.h"
#include "base/exit_error.h"
#include "cli/options/bus.h"

namespace prospect::cli {
namespace {

bool WriteLine(const char* file, const std::string& line) {
  const base::Descriptor out(open(file, O_WRONLY | O_CLOEXEC));
  return out && write(out.get(), line.data(), line.size()) == static_cast<ssize_t>(line.size());
}

// As `unshare -n` or, for who may not, `unshare -rn`: a user namespace in which this user is root.
bool Unshare(int user_namespace) {
  const std::string user = std::to_string(geteuid()), group = std::to_string(getegid());
  if (unshare(CLONE_NEWNET | user_namespace) != 0) return false;
  return user_namespace == 0 || (WriteLine("/proc/self/setgroups", "deny") &&
                                 WriteLine("/proc/self/uid_map", "0 " + user + " 1") &&
                                 WriteLine("/proc/self/gid_map", "0 " + group + " 1"));
}

bool SetUpLoopback() {
  base::ChildOptions options;
  options.command = {"/bin/sh", "-c",
                     "ip link set lo up && ip link set lo multicast on && "
                     "ip route add 224.0.0.0/4 dev lo"};
  return base::RunCaptured(options, std::chrono::seconds(10)).status == 0;
}

// Tried by a child first: what it got half of would be ours to keep.
bool EnterNamespace() {
  for (const int user_namespace : {0, CLONE_NEWUSER}) {
    const auto enter = [=] { return Unshare(user_namespace) && SetUpLoopback(); };
    base::ChildProcess trial([&] { return enter() ? 0 : 1; });
    if (trial.Wait() == 0) return enter();
  }
  return false;
}

// Whether a UDP socket of this host is bound to it.
bool IsTaken(int port) {
  char end[8];
  std::snprintf(end, sizeof end, ":%04X ", static_cast<unsigned>(port));
  std::ifstream sockets("/proc/net/udp");
  for (std::string line; std::getline(sockets, line);)
    if (line.find(end) < line.find(':', line.find(':') + 1) + 6) return true;
  return false;
}

// Below the ports that the kernel gives out.
int FreePort() {
  std::random_device random;
  std::uniform_int_distribution<int> ports(20000, 31999);
  int port = ports(random);
  while (IsTaken(port)) port = ports(random);
  return port;
}

}  // namespace

std::string BusOf(const std::string& option) {
  if (!option.empty()) return option;
  const char* environment = std::getenv("LCM_DEFAULT_URL");
  return environment != nullptr && *environment != '\0' ? environment : kDefaultBusUrl;
}

bool HasRoute(const std::string& bus) {
  const std::string scheme = "udpm://";
  if (!bus.starts_with(scheme)) return true;
  const std::string place = bus.substr(scheme.size());
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(1);
  if (inet_pton(AF_INET, place.substr(0, place.find_first_of(":/?")).c_str(), &address.sin_addr) !=
      1)
    return false;
  const base::Descriptor socket_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  return connect(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
}

void RequireRoute(const std::string& bus) {
  if (HasRoute(bus)) return;
  throw ExitError(kExitBus,
                  "no multicast route for " + bus +
                      ": run 'ip link set lo up; ip route add 224.0.0.0/4 dev lo' as root");
}

std::string EnterPrivateBus() {
  std::string bus = kDefaultBusUrl;
  if (EnterNamespace()) return bus;
  RequireRoute(bus);
  const std::string port = ":7667";
  return bus.replace(bus.find(port), port.size(), ":" + std::to_string(FreePort()));
}

}  // namespace prospect::cli
