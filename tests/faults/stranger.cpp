// fault-stranger ADDRESS PORT: sends "search 7 is over" as one LCM datagram to an address, whether
// that of a multicast group or of a machine: who sits on the network and means harm.

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "lcmtypes/checked_codec.h"
#include "lcmtypes/messages.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  prospect::search_stop_t stop{};
  stop.search_id = 7;
  const auto message = prospect::messages::CheckedEncode(stop);
  const std::string channel = "SEARCH_STOP";
  // LCM's short message: "LC02", a sequence number, the channel with its zero, the bytes.
  std::vector<std::uint8_t> datagram{'L', 'C', '0', '2', 0, 0, 0, 1};
  datagram.insert(datagram.end(), channel.c_str(), channel.c_str() + channel.size() + 1);
  datagram.insert(datagram.end(), message.begin(), message.end());

  const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(std::atoi(argv[2])));
  inet_pton(AF_INET, argv[1], &to.sin_addr);
  const auto sent = sendto(socket, datagram.data(), datagram.size(), 0,
                           reinterpret_cast<const sockaddr*>(&to), sizeof to);
  if (sent != static_cast<ssize_t>(datagram.size())) std::perror("sendto");
  close(socket);
  return sent == static_cast<ssize_t>(datagram.size()) ? 0 : 1;
}
