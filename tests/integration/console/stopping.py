"""A robot that moves, somebody who commands it, and *stop* of a console, on the bus of the test (with_bus.sh)."""
import contextlib
import subprocess
import tempfile
import threading
import time

import deployment
import prospect
import websocket
from prospect import action_command_t, action_status_t

RUNNING, CANCELLED = action_status_t.STATE_RUNNING, action_status_t.STATE_CANCELLED
CANCEL = action_command_t.KIND_CANCEL
SECONDS = 30


@contextlib.contextmanager
def process(*command, **more):
    started = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **more)
    try:
        yield started
    finally:
        if started.poll() is None:
            started.terminate()
        started.wait()


@contextlib.contextmanager
def moving_table(robot):
    """The sorting table at a robot's own pace, where an action takes five seconds, and a console that may press. Gives the
    console and a folder."""
    with tempfile.TemporaryDirectory() as folder, process(*robot, "--speed", "1"):
        console = deployment.Console(folder, "--control")
        try:
            yield console, folder
        finally:
            console.stop()


class Bus:
    """What is said on the bus, as it is now."""

    def __init__(self):
        self.bus = prospect.Bus()
        self.status, self.cancel, self.cancelled_at = None, None, 0.0
        self.bus.subscribe(action_status_t, lambda status: setattr(self, "status", status))
        self.bus.subscribe(action_command_t, self._hear)

    def _hear(self, command):
        if command.kind == CANCEL and not self.cancel:
            self.cancel, self.cancelled_at = command, time.monotonic()

    def until(self, condition, what):
        end = time.monotonic() + SECONDS
        while not condition(self):
            if time.monotonic() > end:
                raise AssertionError(f"not within {SECONDS} s: {what}")
            self.bus.turn(0.05)


def press_when_moving(console, bus):
    """Presses *stop* as soon as the robot moves and the console knows. @return when that was"""
    with websocket.WebSocket(console.port) as viewer:
        bus.until(lambda b: b.status and b.status.state == RUNNING, "an action that runs")
        viewer.until(lambda message: message.get("t") == "facts" and message["facts"]["may"]["stop"] == "")
        pressed = time.monotonic()
        viewer.say({"t": "stop"})
        bus.until(lambda b: b.cancel, "CANCEL on the bus")
        bus.until(lambda b: b.status.state == CANCELLED, "an action that was cancelled")
    return pressed


class Commander(threading.Thread):
    """A program of somebody's own that carries actions out, and what became of them."""

    def __init__(self, actions):
        super().__init__()
        self.actions, self.done, self.lost = actions, [], None

    def run(self):
        try:
            with prospect.connect() as robot:
                robot.begin(0)
                for action in self.actions:
                    self.done.append(robot.carry_out(action))
        except prospect.Lost as lost:
            self.lost = str(lost)


def press_to_cancel_ms(console):
    """Milliseconds from a press to CANCEL on the bus."""
    bus, commander = Bus(), Commander([0])
    commander.start()
    pressed = press_when_moving(console, bus)
    commander.join()
    return 1000 * (bus.cancelled_at - pressed)
