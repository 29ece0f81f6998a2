"""LCM's UDP multicast with the standard library alone, for machines without LCM's Python module."""
import select
import socket
import struct
from urllib.parse import parse_qs, urlsplit

from . import host_filter
from .fragments import Assembler, split

GROUP, PORT, BUFFER = "239.255.76.67", 7667, 4194304


class Udpm:
    """What lcm.LCM has and a robot needs, for "udpm://GROUP:PORT?ttl=N&recv_buf_size=N". One thread."""

    def __init__(self, url):
        parts = urlsplit(url)
        if parts.scheme != "udpm":
            raise ValueError(f"{url}: without LCM's Python module a bus is udpm://GROUP:PORT?ttl=N")
        given = parse_qs(parts.query)
        # Of two the smaller counts, as in the other programs.
        ttl = min((int(value) for value in given.get("ttl", ["0"])), default=0)
        self.place = (parts.hostname or GROUP, parts.port or PORT)
        self.handlers, self.assembler, self.sequence = {}, Assembler(), 0
        self.receiver = self._open_receiver(ttl, int(given.get("recv_buf_size", [BUFFER])[0]))
        self.sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, ttl)
        self.sender.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, BUFFER)

    def _open_receiver(self, ttl, buffer):
        receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        receiver.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, buffer)
        host_filter.attach(receiver, self.place[0], this_machine_only=ttl == 0)
        receiver.bind(("", self.place[1]))
        member = struct.pack("=4sI", socket.inet_aton(self.place[0]), socket.INADDR_ANY)
        receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, member)
        receiver.setblocking(False)
        return receiver

    def subscribe(self, channel, handler):
        """handler(channel, bytes) for each message of the channel."""
        self.handlers[channel] = handler

    def publish(self, channel, message):
        self.sequence = (self.sequence + 1) & 0xFFFFFFFF
        for datagram in split(channel, message, self.sequence):
            self.sender.sendto(datagram, self.place)

    def handle_timeout(self, milliseconds):
        """Waits for a datagram and hands on the message that it completes. Returns 0 where none came in that time."""
        if not select.select([self.receiver], [], [], milliseconds / 1000)[0]:
            return 0
        datagram, sender = self.receiver.recvfrom(65536)
        whole = self.assembler.take(datagram, sender)
        if whole and whole[0] in self.handlers:
            self.handlers[whole[0]](*whole)
        return 1
