#!/usr/bin/env python3
"""The console among people who mean harm, without a browser: who is let in, what is answered to nonsense, who holds connections.

  safety_test.py BIN
"""
import json
import os
import sys
import threading
import time
import unittest

sys.dont_write_bytecode = True
os.environ["PROSPECT_TEST_BIN"] = sys.argv[1]
import deployment
import websocket
from deployment import until

MOST_MB = 128 + 32


class Safety(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.up = deployment.deployment()
        cls.folder = cls.up.__enter__()
        cls.console = deployment.Console(cls.folder, *deployment.console_arguments(cls.folder), "--control")
        cls.token = cls.console.url.split("#token=")[1]

    @classmethod
    def tearDownClass(cls):
        cls.console.stop()
        cls.up.__exit__(None, None, None)

    def tearDown(self):
        self.assertIsNone(self.console.process.poll(), "the console has ended: " + self.console.errors())
        with self.viewer() as viewer:
            viewer.until(lambda message: message.get("t") == "data")

    def viewer(self, **more):
        return websocket.WebSocket(self.console.port, self.token, **more)

    def get(self, *lines, seconds=10):
        answer = websocket.request("127.0.0.1", self.console.port, "\r\n".join(lines) + "\r\n\r\n", seconds)
        return answer.decode(errors="replace")

    def test_the_page_comes_with_a_policy_and_nothing_but_the_page_does(self):
        host = f"Host: {self.console.host}"
        page = self.get("GET / HTTP/1.1", host)
        self.assertIn("200 OK", page)
        policy = [line for line in page.split("\r\n") if line.startswith("Content-Security-Policy")][0]
        self.assertIn("script-src 'self'", policy)
        self.assertNotIn("unsafe", policy)
        self.assertNotRegex(page, r"<script(?![^>]*src=)|\son\w+=|style=", "nothing inline")
        for path in ("/../main.cpp", "/%2e%2e/main.cpp", "//etc/passwd", "/nothing", "/index.html/.."):
            self.assertIn("404", self.get(f"GET {path} HTTP/1.1", host), path)
        self.assertIn("405", self.get("POST / HTTP/1.1", host, "Content-Length: 0"))

    def test_other_names_and_other_sites_are_refused(self):
        own = self.console.host
        self.assertIn("403", self.get("GET / HTTP/1.1", f"Host: evil.example:{self.console.port}"))
        self.assertIn("403", self.get("GET / HTTP/1.1"))
        self.assertIn("403", self.get("GET / HTTP/1.1", f"Host: {own}", "Origin: http://evil.example"))
        for more in ({"origin": "http://evil.example"}, {"origin": ""}, {"origin": "null"},
                     {"host": f"evil.example:{self.console.port}"}):
            with self.assertRaises(websocket.Refused, msg=more) as refused:
                self.viewer(**more)
            self.assertIn("403", str(refused.exception))

    def test_without_the_token_nobody_gets_in(self):
        for token in ("", "0" * len(self.token), self.token[:-1], self.token + "0"):
            with self.assertRaises(websocket.Refused):
                websocket.WebSocket(self.console.port, token)

    def test_without_control_buttons_do_nothing(self):
        looking = deployment.Console(self.folder, *deployment.console_arguments(self.folder))
        try:
            with websocket.WebSocket(looking.port) as viewer:
                for request in ({"t": "run", "seed": 1, "samples": 5, "retries": 0}, {"t": "stop"}, {"t": "scale", "workers": 0}):
                    viewer.say(request)
                    wrong = viewer.until(lambda message: message.get("t") == "wrong")
                    self.assertIn("--control", wrong["words"])
                # It has just begun to listen: those two are heard when they next say HEALTH.
                viewer.until(lambda message: message.get("bus", {}).get("workers") == 2)
        finally:
            looking.stop()

    def test_listening_to_others_asks_for_the_token_even_to_look(self):
        console = deployment.Console(self.folder, *deployment.console_arguments(self.folder), "--listen", "0.0.0.0")
        try:
            with self.assertRaises(websocket.Refused):
                websocket.WebSocket(console.port)
            with websocket.WebSocket(console.port, console.url.split("#token=")[1]) as viewer:
                viewer.until(lambda message: message.get("bus", {}).get("workers") == 2)
        finally:
            console.stop()

    def test_workers_come_and_go_with_the_slider(self):
        with self.viewer() as viewer:
            viewer.until(lambda message: message.get("t") == "facts" and message["facts"]["may"]["scale"] == "")
            for workers in (3, 2):
                known = {}

                def settled(message):
                    """Both are told when they change, in either order."""
                    if message.get("t") == "facts":
                        known["scaling"] = message["facts"].get("scale", {}).get("running")
                    if "bus" in message:
                        known["workers"] = message["bus"].get("workers")
                    return known == {"scaling": False, "workers": workers}  # noqa: B023

                viewer.say({"t": "scale", "workers": workers})
                viewer.until(settled)

    def test_nonsense_is_refused_and_closes_only_who_said_it(self):
        with self.viewer() as other:
            for text in (b"\0" * 3000, b"GET\r\n\r\n", b"\xff" * 20000 + b"\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n",
                         b"GET /" + b"a" * 100000 + b" HTTP/1.1\r\n\r\n",
                         b"GET / HTTP/1.1\r\n" + b"A: b\r\n" * 20000 + b"\r\n",
                         b"GET / HTTP/1.1\r\nHost: " + self.console.host.encode() + b"\r\nContent-Length: 99999999999\r\n\r\n"):
                self.assertNotIn(b" 200 ", websocket.request("127.0.0.1", self.console.port, text, 3))
            for code, data, length in ((1, b"nonsense", None), (1, b"[" * 10000, None), (2, b"{}", None), (1, b"\xff\xfe", None),
                                       (1, b"{}", 1 << 62), (1, b"x" * 20000, None), (9, b"y" * 200, None), (5, b"", None)):
                with self.viewer() as viewer:
                    viewer.raw(code, data, length)
                    if length is None:
                        with self.assertRaises((ConnectionError, OSError), msg=(code, data[:10])):
                            while True:
                                viewer.message()
            other.until(lambda message: "bus" in message)

    def test_requests_that_are_no_use_are_told_so(self):
        with self.viewer() as viewer:
            for request in ({"t": "watch"}, {"t": "watch", "search": 5}, {"t": "want", "search": "1", "paths": 3},
                            {"t": "want", "search": "1", "paths": [[999]]}, {"t": "want", "search": "1", "paths": [[0] * 65]},
                            {"t": "choices", "search": "1", "node": "x"}, {"t": "judge", "search": "x", "path": []},
                            {"t": "run", "seed": "1; rm", "samples": 5, "retries": 0}, {"t": "scale", "workers": -1},
                            {"t": "scale", "workers": 1e300}, {"t": "unheard"}, {"t": "run", "seed": 1, "samples": 5,
                            "retries": 0, "goal": "--help"}):
                viewer.say(request)
                self.assertIn("words", viewer.until(lambda message: message.get("t") == "wrong"), request)

    def test_a_flood_of_requests_closes_its_sender(self):
        with self.viewer() as viewer, self.assertRaises((ConnectionError, OSError)):
            for _ in range(2000):
                viewer.say({"t": "choices", "search": "1", "node": 0})
            while True:
                viewer.message()

    def test_200_idle_connections_disturb_nobody(self):
        import socket
        with self.viewer() as viewer:
            before = self.console.memory_mb()
            idle = [socket.create_connection(("127.0.0.1", self.console.port), 10) for _ in range(200)]
            begun = time.monotonic()
            self.assertIn("200 OK", self.get("GET / HTTP/1.1", f"Host: {self.console.host}"))
            viewer.until(lambda message: "bus" in message)
            self.assertLess(time.monotonic() - begun, 5)
            self.assertLess(self.console.memory_mb() - before, 20)
            for connection in idle:
                connection.close()

    def test_too_many_viewers_are_sent_away_and_others_stay(self):
        viewers = []
        try:
            with self.assertRaises(websocket.Refused) as refused:
                for _ in range(40):
                    viewers.append(self.viewer())
            self.assertIn("503", str(refused.exception))
            viewers[0].until(lambda message: "bus" in message)
        finally:
            for viewer in viewers:
                viewer.close()
        until(lambda: self.can_enter(), "room again")

    def can_enter(self):
        try:
            self.viewer().close()
            return True
        except websocket.Refused:
            return False

    def test_slow_readers_cost_no_memory_and_others_no_time(self):
        slow = [self.viewer(receive_buffer=4096) for _ in range(10)]
        try:
            with self.viewer() as viewer:
                viewer.until(lambda message: message.get("t") == "facts" and message["facts"]["may"]["run"] == "")
                viewer.say({"t": "run", "seed": 2000000, "goal": "", "samples": 200, "threshold": 0, "retries": 0, "reset": True})
                ended = viewer.until(lambda message: message.get("t") == "facts" and message["facts"].get("run", {}).get("exit", -1) >= 0)
                self.assertIn(ended["facts"]["run"]["exit"], (0, 3, 4), ended)
            self.assertLess(self.console.memory_mb(), MOST_MB)
            # One that reads on gets what is so now, and is told.
            missed = slow[0].until(lambda message: "missed" in message)["missed"]
            self.assertTrue(missed["stalled_s"] > 0 or missed["pictures"] > 0, missed)
        finally:
            for viewer in slow:
                viewer.close()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
