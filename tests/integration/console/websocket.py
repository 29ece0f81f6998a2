"""As much of a WebSocket as a test needs that wants to break its rules, too (RFC 6455)."""
import base64
import json
import os
import socket
import struct
import time


class Refused(Exception):
    """The server's answer was not 101."""


def request(host, port, text, seconds=10):
    """Sends bytes as they are. @return all that is answered until the server closes, or falls silent."""
    with socket.create_connection((host, port), seconds) as connection:
        connection.sendall(text if isinstance(text, bytes) else text.encode())
        connection.settimeout(seconds)
        answer = b""
        try:
            while chunk := connection.recv(65536):
                answer += chunk
                head, _, body = answer.partition(b"\r\n\r\n")
                for line in head.split(b"\r\n"):
                    if line.lower().startswith(b"content-length:") and len(body) >= int(line.split(b":")[1]):
                        return answer
        except (socket.timeout, ConnectionResetError):
            pass
        return answer


class WebSocket:
    def __init__(self, port, token="", host=None, origin=None, target="/live", receive_buffer=0):
        name = host or f"127.0.0.1:{port}"
        self.socket = socket.socket()
        if receive_buffer:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        self.socket.settimeout(20)
        self.socket.connect(("127.0.0.1", port))
        query = f"?token={token}" if token else ""
        lines = [f"GET {target}{query} HTTP/1.1", f"Host: {name}", "Upgrade: websocket", "Connection: Upgrade",
                 f"Sec-WebSocket-Key: {base64.b64encode(os.urandom(16)).decode()}", "Sec-WebSocket-Version: 13"]
        if origin != "":
            lines.append(f"Origin: {origin or 'http://' + name}")
        self.socket.sendall(("\r\n".join(lines) + "\r\n\r\n").encode())
        self.rest = b""
        while b"\r\n\r\n" not in self.rest:
            chunk = self.socket.recv(4096)
            if not chunk:
                break
            self.rest += chunk
        head, _, self.rest = self.rest.partition(b"\r\n\r\n")
        if b" 101 " not in head.split(b"\r\n")[0]:
            self.socket.close()
            raise Refused((head + b"\r\n" + self.rest).decode(errors="replace"))

    def _take(self, count):
        while len(self.rest) < count:
            chunk = self.socket.recv(1 << 16)
            if not chunk:
                raise ConnectionError("closed")
            self.rest += chunk
        taken, self.rest = self.rest[:count], self.rest[count:]
        return taken

    def message(self):
        """The next message: JSON, or the header of a picture."""
        parts = b""
        while True:
            first = self._take(1)[0]
            length = self._take(1)[0] & 127
            if length == 126:
                length = struct.unpack(">H", self._take(2))[0]
            elif length == 127:
                length = struct.unpack(">Q", self._take(8))[0]
            data = self._take(length)
            code = first & 15
            if code == 9:  # ping
                self.raw(10, data)
                continue
            if code == 8:
                raise ConnectionError("closed")
            if code in (1, 2):
                kind = code
            parts += data
            if first & 128:
                break
        if kind == 1:
            return json.loads(parts)
        length = struct.unpack("<I", parts[:4])[0]
        header = json.loads(parts[4:4 + length])
        header["bytes"] = len(parts) - 4 - length
        return header

    def until(self, condition, seconds=60):
        """The first message for which a condition holds."""
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            message = self.message()
            if condition(message):
                return message
        raise AssertionError(f"no such message within {seconds} s")

    def raw(self, opcode, data, length=None):
        """A masked frame; `length`: what its header says instead of the truth."""
        size = len(data) if length is None else length
        head = bytes([128 | opcode])
        if size < 126:
            head += bytes([128 | size])
        elif size < 1 << 16:
            head += bytes([128 | 126]) + struct.pack(">H", size)
        else:
            head += bytes([128 | 127]) + struct.pack(">Q", size)
        mask = os.urandom(4)
        self.socket.sendall(head + mask + bytes(b ^ mask[i % 4] for i, b in enumerate(data)))

    def say(self, request_):
        self.raw(1, json.dumps(request_).encode())

    def close(self):
        self.socket.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
