"""A deployment's key for a robot in Python: the standard library is all it takes.

    tag = Tagger(read_key("key"))
    lc.publish(channel, tag.sign(channel, message.encode()))       # sending
    payload = tag.verify(channel, data)                            # in a handler; None: refuse it

What a tag is: docs/security.md. Run as a program, it signs or verifies standard input:
    keyed.py sign|verify KEYFILE CHANNEL
"""
import hashlib
import hmac
import os
import struct
import sys


def read_key(path):
    with open(path) as file:
        if os.fstat(file.fileno()).st_mode & 0o077:
            raise PermissionError(f"{path} is open to other users: chmod 600")
        return bytes.fromhex(file.read().strip())


class Tagger:
    WINDOW = 4096  # how far messages may overtake one another on the way

    def __init__(self, key):
        self.key, self.sender, self.sequence, self.heard = key, os.urandom(4), 0, {}

    def _mac(self, channel, covered):
        return hmac.new(self.key, channel.encode() + b"\0" + covered, hashlib.sha256).digest()[:12]

    def sign(self, channel, message):
        self.sequence += 1
        covered = message + self.sender + struct.pack(">Q", self.sequence)
        return covered + self._mac(channel, covered)

    def verify(self, channel, data):
        """The message without its tag, or None for one that must not be believed."""
        covered, mac = data[:-12], data[-12:]
        if len(data) < 24 or not hmac.compare_digest(mac, self._mac(channel, covered)):
            return None
        sender, sequence = covered[-12:-8], struct.unpack(">Q", covered[-8:])[0]
        heard = self.heard.setdefault(sender, {"oldest": sequence, "newest": 0, "taken": set()})
        oldest = max(heard["oldest"], heard["newest"] - self.WINDOW)
        if sequence < oldest or sequence in heard["taken"]:
            return None  # played again
        heard["newest"] = max(heard["newest"], sequence)
        heard["taken"].add(sequence)
        if len(heard["taken"]) > 2 * self.WINDOW:
            heard["taken"] = {number for number in heard["taken"] if number >= oldest}
        return covered[:-12]


if __name__ == "__main__":
    what, key_file, name = sys.argv[1:]
    tagger, given = Tagger(read_key(key_file)), sys.stdin.buffer.read()
    result = tagger.sign(name, given) if what == "sign" else tagger.verify(name, given)
    if result is None:
        sys.exit("not authentic")
    sys.stdout.buffer.write(result)
