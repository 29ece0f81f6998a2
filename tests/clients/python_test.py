"""What the Python client does without a bus: datagrams, messages, keys, pictures."""
import os
import random
import struct
import tempfile
import unittest
import zlib

from prospect import Picture, action_status_t, health_t, task_t
from prospect.bus import Bus, channel_of, decode
from prospect.fragments import LARGEST_WHOLE, Assembler, split

ONE, OTHER = ("10.0.0.1", 1), ("10.0.0.2", 1)


def message_of(size, seed=1):
    return random.Random(seed).randbytes(size)


def assembled(datagrams):
    """What comes of (datagram, sender), in the order of completion."""
    assembler = Assembler()
    return [whole for datagram, sender in datagrams if (whole := assembler.take(datagram, sender))]


class Datagrams(unittest.TestCase):
    def test_any_size_arrives(self):
        full = LARGEST_WHOLE - len("TASK") - 1
        for size, count in ((0, 1), (full, 1), (full + 1, 2), (200_000, 4), (1 << 24, 257)):
            datagrams = split("TASK", message_of(size), 7)
            self.assertEqual(len(datagrams), count)
            self.assertEqual(assembled((datagram, ONE) for datagram in datagrams), [("TASK", message_of(size))])

    def test_parts_in_any_order(self):
        datagrams = split("OBSERVATION", message_of(300_000), 7)
        for seed in range(20):
            random.Random(seed).shuffle(datagrams)
            self.assertEqual(assembled((datagram, ONE) for datagram in datagrams), [("OBSERVATION", message_of(300_000))])

    def test_parts_of_two_senders_between_one_another(self):
        mine = split("OBSERVATION", message_of(300_000, 1), 7)
        others = split("OBSERVATION", message_of(300_000, 2), 7)
        between = [pair for a, b in zip(mine, others) for pair in ((a, ONE), (b, OTHER))]
        self.assertEqual({message for _, message in assembled(between)}, {message_of(300_000, 1), message_of(300_000, 2)})

    def test_parts_of_two_messages_of_one_sender_between_one_another(self):
        between = [pair for a, b in zip(split("A", message_of(200_000, 1), 7), split("B", message_of(200_000, 2), 8))
                   for pair in ((b, ONE), (a, ONE))]
        self.assertEqual(dict(assembled(between)), {"A": message_of(200_000, 1), "B": message_of(200_000, 2)})

    def test_a_lost_part_loses_its_message_alone(self):
        lossy = split("A", message_of(200_000), 7)[:-1] + split("B", b"after", 8)
        self.assertEqual(assembled((datagram, ONE) for datagram in lossy), [("B", b"after")])

    def test_a_part_twice_counts_once(self):
        datagrams = split("A", message_of(200_000), 7)
        self.assertEqual(len(assembled((datagram, ONE) for datagram in datagrams[:1] * 5 + datagrams)), 1)

    def test_messages_never_completed_are_forgotten(self):
        assembler = Assembler()
        for sequence in range(1000):
            assembler.take(split("A", message_of(70_000), sequence)[0], ONE)
        self.assertLessEqual(len(assembler.under_way), Assembler.KEPT)

    def test_garbage_is_no_message(self):
        dice = random.Random(1)
        good = split("TASK", b"message", 1)[0], *split("TASK", message_of(70_000), 2)
        for _ in range(20_000):
            datagram = bytearray(dice.choice(good)[:dice.randrange(64)])
            for _ in range(dice.randrange(4)):
                if datagram:
                    datagram[dice.randrange(len(datagram))] = dice.randrange(256)
            assembled([(bytes(datagram), ONE)])
        for datagram in (b"", b"LC02", b"LC02\0\0\0\1channel without its end", b"LC02\0\0\0\1\0unnamed"):
            self.assertEqual(assembled([(datagram, ONE)]), [])

    def test_what_no_receiver_would_take_is_not_sent(self):
        for channel, size in (("", 1), ("C" * 64, 1), ("A", (1 << 24) + 1)):
            with self.assertRaises(ValueError):
                split(channel, bytes(size), 1)


class Messages(unittest.TestCase):
    def test_channels(self):
        self.assertEqual([channel_of(kind) for kind in (health_t, action_status_t)], ["HEALTH", "ACTION_STATUS"])

    def test_cut_and_lengthened_messages_are_none(self):
        health = health_t()
        health.service = "simulator"
        data = health.encode()
        self.assertEqual(decode(health_t, data).service, "simulator")
        for wrong in [data[:size] for size in range(len(data))] + [data + b"\0", task_t().encode()]:
            with self.assertRaises(ValueError):
                decode(health_t, wrong)

    def test_any_bytes_are_a_message_or_none(self):
        dice, data = random.Random(1), bytearray(task_t().encode())
        for _ in range(5_000):
            changed = bytearray(data)
            changed[dice.randrange(8, len(data))] = dice.randrange(256)
            try:
                decode(task_t, bytes(changed))
            except ValueError:
                pass


class Wire:
    """In a transport's place: what is published is heard at once."""

    def __init__(self, _=None):
        self.handlers, self.sent = {}, []

    def subscribe(self, channel, handler):
        self.handlers[channel] = handler

    def publish(self, channel, data):
        self.sent.append((channel, data))


class Keys(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def bus(self, digit):
        path = os.path.join(self.folder.name, digit)
        with open(os.open(path, os.O_CREAT | os.O_WRONLY, 0o600), "w") as file:
            file.write(digit * 64)
        import prospect.bus
        real, prospect.bus.Transport = prospect.bus.Transport, Wire
        try:
            return Bus("udpm://", path)
        finally:
            prospect.bus.Transport = real

    def test_only_who_has_the_key_is_heard_and_once(self):
        sender, friend, stranger = self.bus("1"), self.bus("1"), self.bus("2")
        sender.publish(health_t())
        heard = []
        for receiver in (friend, friend, stranger):
            receiver.subscribe(health_t, heard.append)
            for channel, data in sender.transport.sent:
                receiver.transport.handlers[channel](channel, data)
        self.assertEqual(len(heard), 1)
        self.assertEqual((friend.refused, stranger.refused), (1, 1))


class Pictures(unittest.TestCase):
    def test_png_holds_the_pixels(self):
        picture = Picture(5, 3, bytes(range(45)))
        self.assertEqual(picture.at(1, 2), (33, 34, 35))
        png, chunks, at = picture.png(), {}, 8
        while at < len(png):
            size, kind = struct.unpack(">I4s", png[at:at + 8])
            chunks[kind] = png[at + 8:at + 8 + size]
            self.assertEqual(zlib.crc32(kind + chunks[kind]), struct.unpack(">I", png[at + 8 + size:at + 12 + size])[0])
            at += 12 + size
        self.assertEqual(chunks[b"IHDR"][:8], struct.pack(">II", 5, 3))
        rows = zlib.decompress(chunks[b"IDAT"])
        self.assertEqual(b"".join(rows[16 * y + 1:16 * y + 16] for y in range(3)), picture.pixels)


if __name__ == "__main__":
    unittest.main()
