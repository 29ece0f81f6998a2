"""Messages of Prospect on an LCM bus, with a deployment's key where it has one (docs/security.md)."""
import io
import os
import struct
import time

from .keyed import Tagger, read_key
from .udpm import Udpm

try:
    from lcm import LCM as Transport  # any URL of LCM's, tcpq:// included; it has no host_filter
except ImportError:
    Transport = Udpm

URL = "udpm://239.255.76.67:7667?ttl=0"


def channel_of(kind):
    """health_t is said on HEALTH, and so on."""
    return kind.__name__.removesuffix("_t").upper()


def decode(kind, data):
    """The message; ValueError for bytes that are none."""
    rest = io.BytesIO(data)
    try:
        message = kind.decode(rest)
    except (struct.error, IndexError, OverflowError, MemoryError) as error:
        raise ValueError(str(error)) from error
    if rest.read(1):
        raise ValueError("longer than its type")
    return message


class Bus:
    """url: by default the environment's LCM_DEFAULT_URL, or this machine alone; key: the file, by default PROSPECT_KEY_FILE's;
    without one the bus is open, and whoever can send is believed. One thread."""

    def __init__(self, url=None, key=None):
        self.url = url or os.environ.get("LCM_DEFAULT_URL") or URL
        key = key or os.environ.get("PROSPECT_KEY_FILE")
        self.tagger = Tagger(read_key(key)) if key else None
        self.transport = Transport(self.url)
        self.refused = 0  # messages that were not authentic or no messages at all

    def subscribe(self, kind, handler):
        """handler(message) for each message of this type that can be believed."""

        def hear(channel, data):
            known = self.tagger.verify(channel, bytes(data)) if self.tagger else data
            try:
                message = None if known is None else decode(kind, known)
            except ValueError:
                message = None
            if message is None:
                self.refused += 1
            else:
                handler(message)

        self.transport.subscribe(channel_of(kind), hear)

    def publish(self, message):
        """Stamps the message with the time and says it on its type's channel."""
        message.utime = time.time_ns() // 1000
        channel, data = channel_of(type(message)), message.encode()
        self.transport.publish(channel, self.tagger.sign(channel, data) if self.tagger else data)

    def turn(self, seconds):
        """Waits so long at most for a message, then handles all that have come."""
        milliseconds = max(0, round(1000 * seconds))
        while self.transport.handle_timeout(milliseconds):
            milliseconds = 0
