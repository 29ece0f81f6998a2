"""The Python client's own transport on a real bus: what it hears, and what it does not."""
import os
import socket
import subprocess
import sys
import time
import unittest

from prospect.fragments import split
from prospect.udpm import Udpm

URL = os.environ["LCM_DEFAULT_URL"]


def heard_by(receiver, channels, seconds):
    """Messages of these channels, until there is one of each or the time is over."""
    heard, end = {}, time.monotonic() + seconds
    for channel in channels:
        receiver.subscribe(channel, heard.__setitem__)
    while len(heard) < len(channels) and time.monotonic() < end:
        receiver.handle_timeout(20)
    return heard


class OnABus(unittest.TestCase):
    def setUp(self):
        self.receiver = Udpm(URL)
        self.addCleanup(lambda: (self.receiver.receiver.close(), self.receiver.sender.close()))

    def test_short_and_long_messages_of_another_process(self):
        code = "import sys; from prospect.udpm import Udpm; bus = Udpm(sys.argv[1]);" \
               "bus.publish('LONG', b'x' * 300_000); bus.publish('SHORT', b'y')"
        subprocess.run([sys.executable, "-c", code, URL], check=True)
        self.assertEqual(heard_by(self.receiver, ("LONG", "SHORT"), 10), {"LONG": b"x" * 300_000, "SHORT": b"y"})

    def test_fragments_of_two_senders_between_one_another(self):
        senders = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2)]
        parts = [split(name, name.encode() * 40_000, 1) for name in ("FIRST", "SECOND")]
        for some in zip(*parts):
            for sender, datagram in zip(senders, some):
                sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
                sender.sendto(datagram, self.receiver.place)
        for sender, rest in zip(senders, parts):
            for datagram in rest[min(map(len, parts)):]:
                sender.sendto(datagram, self.receiver.place)
            sender.close()
        self.assertEqual(heard_by(self.receiver, ("FIRST", "SECOND"), 10),
                         {"FIRST": b"FIRST" * 40_000, "SECOND": b"SECOND" * 40_000})

    def test_what_is_sent_to_the_machine_alone_is_not_heard(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            sender.sendto(split("PAST_THE_GROUP", b"", 1)[0], ("127.0.0.1", self.receiver.place[1]))
            sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
            sender.sendto(split("BY_THE_GROUP", b"", 2)[0], self.receiver.place)
        self.assertEqual(heard_by(self.receiver, ("BY_THE_GROUP", "PAST_THE_GROUP"), 1), {"BY_THE_GROUP": b""})


if __name__ == "__main__":
    unittest.main()
