"""LCM's datagrams: a message whole ("LC02"), or one of its parts ("LC03") where it is larger than a datagram."""
import struct

WHOLE, PART = 0x4C433032, 0x4C433033
LARGEST_WHOLE = 65499  # channel, zero and message
PART_BYTES = 65487
LARGEST_MESSAGE = 1 << 24  # liblcm's own limit
LONGEST_CHANNEL = 63


def split(channel, message, sequence):
    """The datagrams that carry this message."""
    payload = channel.encode() + b"\0" + message
    if not 0 < len(channel) <= LONGEST_CHANNEL or len(message) > LARGEST_MESSAGE:
        raise ValueError(f"{channel}: {len(message)} bytes cannot be sent")
    if len(payload) <= LARGEST_WHOLE:
        return [struct.pack(">II", WHOLE, sequence) + payload]
    ends = range(0, len(payload), PART_BYTES)
    return [struct.pack(">IIIIHH", PART, sequence, len(message), max(0, start - len(channel) - 1), number, len(ends))
            + payload[start:start + PART_BYTES] for number, start in enumerate(ends)]


class Assembler:
    """Messages from datagrams. Parts may come in any order, and those of several messages and senders between one another."""
    KEPT = 64  # messages under way: the oldest goes

    def __init__(self):
        self.under_way = {}

    def take(self, datagram, sender):
        """(channel, message) where this datagram completes one, else None; so, too, for what is not LCM's."""
        magic = datagram[:4]
        if magic == struct.pack(">I", WHOLE):
            return self._named(datagram[8:])
        if magic == struct.pack(">I", PART) and len(datagram) > 20:
            return self._take_part(datagram, sender)
        return None

    def _take_part(self, datagram, sender):
        sequence, size, offset, number, count = struct.unpack(">IIIHH", datagram[4:20])
        if size > LARGEST_MESSAGE or number >= count or (offset == 0) != (number == 0):
            return None
        name = (sender, sequence, size, count)
        parts = self.under_way.setdefault(name, {})
        parts[number] = datagram[20:]
        if len(parts) < count:
            if len(self.under_way) > self.KEPT:
                del self.under_way[next(iter(self.under_way))]
            return None
        del self.under_way[name]
        whole = self._named(b"".join(parts[i] for i in range(count)))
        return whole if whole and len(whole[1]) == size else None

    @staticmethod
    def _named(payload):
        channel, zero, message = payload.partition(b"\0")
        return (channel.decode("ascii", "replace"), message) if zero and 0 < len(channel) <= LONGEST_CHANNEL else None
