"""Whoever commands a robot or the simulator: looks, asks for a plan, carries actions out."""
import json
import os
import random
import shutil
import socket
import subprocess
import tempfile
import time

from .action_command_t import action_command_t
from .action_status_t import action_status_t
from .bus import Bus
from .health_t import health_t
from .model_info_t import model_info_t
from .observation_t import observation_t
from .picture import Picture
from .predict_reply_t import predict_reply_t
from .predict_request_t import predict_request_t
from .sim_command_t import sim_command_t
from .task_t import task_t

FOUND, REFUSED = 0, 3  # exit codes of explain
HEARTBEAT, REPEAT, NOTICE, SILENT, SLACK = 1.0, 0.05, 5.0, 3.0, 30.0  # seconds


class Lost(Exception):
    """Who was to answer did not, or somebody else holds the robot. It moves no more by our command."""


class Step:
    """One action of a plan: `action` (its index), `name`, `score` and `value` (0 to 1), and `picture`, what the networks
    imagine that the camera will show after it."""

    def __init__(self, row, picture):
        self.action, self.name, self.score, self.value = row["action"], row["name"], row["score"], row["V"]
        self.picture = picture


class Plan(list):
    """Steps; none where acting is not advised. `reason` says why then, `score` (0 to 1) how the plan was judged."""

    def __init__(self, steps, score, reason):
        super().__init__(steps)
        self.score, self.reason = score, reason


def connect(url=None, key=None, timeout=10.0):
    """A Robot, once TASK, ACTION_STATUS and a picture were heard; url and key as for Bus."""
    return Robot(Bus(url, key), key, timeout)


class Robot:
    """Used with `with`: at its end, whatever ended it, an action that runs is cancelled and the robot is free. It says HEALTH
    only while a function of it runs: who does something else for more than 3 s lets go of the robot. One thread."""

    def __init__(self, bus, key=None, timeout=10.0):
        self.bus, self.key = bus, key or os.environ.get("PROSPECT_KEY_FILE")
        self.id, self.commands, self.beat = random.getrandbits(62) + 1, 0, 0.0
        self.task = self.picture = self.status = self.model = self.reply = None
        self.heard = 0.0  # when the latest status was
        bus.subscribe(task_t, lambda message: setattr(self, "task", message))
        bus.subscribe(observation_t, self._see)
        bus.subscribe(action_status_t, self._hear_status)
        bus.subscribe(model_info_t, lambda message: setattr(self, "model", message))
        bus.subscribe(predict_reply_t, self._hear_reply)
        if not self._until(lambda: self.task and self.status and self.picture, timeout):
            raise Lost(f"no robot and no simulator on {bus.url}: is it up, and has it the same key?")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def actions(self):
        """Names of the action table, by index."""
        return [action.name for action in self.task.actions]

    def look(self):
        """The latest picture."""
        self.bus.turn(0)
        return Picture(self.picture.width, self.picture.height, self.picture.data)

    def begin(self, seed=0):
        """A new episode: a simulator, and a robot that can, puts the scene of this seed up."""
        command = sim_command_t()
        command.sender_id, command.command_id, command.kind = self.id, self._next_id(), sim_command_t.KIND_RESET
        command.present_episode_id, command.seed = self.status.episode_id, seed
        command.episode_id = random.getrandbits(62) + 1
        begun = lambda: self.picture.episode_id == self.status.episode_id == command.episode_id  # noqa: E731
        if not self._until(begun, NOTICE, command):
            raise Lost("no new episode was begun: somebody else holds the robot, or it obeys no SIM_COMMAND")

    def plan(self, program="prospect"):
        """Searches from what the camera shows now, with the workers and the model server that are up: `prospect explain`.
        program: where prospect is, the checkout's ./prospect too."""
        path = shutil.which(program)
        if not path:
            raise FileNotFoundError(f"{program}: give plan() the path of ./prospect")
        with tempfile.TemporaryDirectory() as out:
            command = [path, "explain", "--no-reset", "--bus", self.bus.url, "--out", out, "--quiet"]
            search = subprocess.Popen(command + (["--key", self.key] if self.key else []))
            while search.poll() is None:
                self._turn(0.02)
            if search.returncode not in (FOUND, REFUSED):
                raise Lost(f"prospect explain ended with {search.returncode}")  # and has said why
            with open(os.path.join(out, "result.json"), encoding="utf-8") as file:
                result = json.load(file)
        found = result["searches"][0] if result["searches"] else {"score": 0.0}
        if search.returncode == REFUSED:
            return Plan([], found["score"], result["reason"])
        path, steps = [], []
        for row in result["steps"]:
            path.append(row["action"])
            steps.append(Step(row, self.imagine(path)))
        return Plan(steps, found["score"], "")

    def imagine(self, actions):
        """The picture that the networks imagine after these actions, from where the latest search began."""
        request = predict_request_t()
        request.client_id, request.request_id = self.id, random.getrandbits(31)
        if not self._until(lambda: self.model and self.model.search_id, NOTICE):
            raise Lost("no model server knows a search")
        request.search_id, request.epoch = self.model.search_id, self.model.epoch
        request.path.num_actions, request.path.actions, request.want_image = len(actions), bytes(actions), True
        self.reply = None
        if not self._until(lambda: self.reply and self.reply.request_id == request.request_id, NOTICE, request):
            raise Lost("the model server does not answer")
        if not self.reply.width:
            raise Lost(f"the model server has no picture: {self.reply.reason}")
        return Picture(self.reply.width, self.reply.height, self.reply.data)

    def carry_out(self, action):
        """Carries an action out, by index or name, to its end. True: it succeeded; None: it ended, and the robot cannot tell;
        else `status` says what became of it."""
        if isinstance(action, str):
            action = self.actions().index(action)
        command = self._command(action_command_t.KIND_START, action)
        try:
            if not self._until(lambda: self._named(command) or self._stopped(command), NOTICE, command):
                raise Lost("the robot takes no notice of a command")
            self._await_end(command)
        except BaseException:
            self._cancel()
            raise
        last = self.status.frame
        self._until(lambda: self.picture.episode_id == self.status.episode_id and self.picture.frame >= last, NOTICE)
        return None if self.status.state == action_status_t.STATE_ENDED else self.status.state == action_status_t.STATE_SUCCEEDED

    def close(self):
        """Lets go of the robot."""
        if self.status and self.status.holder_id == self.id and self.status.state == action_status_t.STATE_RUNNING:
            self._cancel()
        self._say_health(health_t.STATE_DRAINING)

    def _await_end(self, command):
        end = time.monotonic() + self.task.action_time_limit + SLACK
        while not self._ended(command):
            if time.monotonic() > end:
                raise Lost(f"{self.actions()[command.action]} did not end in time")
            if time.monotonic() - self.heard > SILENT:
                raise Lost("ACTION_STATUS fell silent for 3 s")
            self._turn(0.02)
        if self._stopped(command):
            raise Lost(f"{self.actions()[command.action]} was stopped from a console")

    def _cancel(self):
        command = self._command(action_command_t.KIND_CANCEL, -1)
        self._until(lambda: self._ended(command), 1.0, command)

    def _command(self, kind, action):
        command = action_command_t()
        command.executive_id, command.command_id, command.episode_id = self.id, self._next_id(), self.status.episode_id
        command.kind, command.action = kind, action
        return command

    def _next_id(self):
        self.commands += 1  # lower ones are old news
        return self.commands

    def _named(self, command):
        return (self.status.executive_id, self.status.command_id) == (self.id, command.command_id)

    def _stopped(self, command):
        """Whether somebody stopped this robot from a console: nobody else sends a command of ours, with an id beyond ours."""
        return self.status.executive_id == self.id and self.status.command_id > command.command_id

    def _ended(self, command):
        return (self._named(command) or self._stopped(command)) and self.status.state != action_status_t.STATE_RUNNING

    def _see(self, picture):
        if not self.picture or picture.episode_id != self.picture.episode_id or picture.frame >= self.picture.frame:
            self.picture = picture

    def _hear_status(self, status):
        self.status, self.heard = status, time.monotonic()

    def _hear_reply(self, reply):
        if reply.client_id == self.id:
            self.reply = reply

    def _say_health(self, state):
        health = health_t()
        health.service, health.instance_id, health.state = "executive", self.id, state
        health.pid, health.host = os.getpid(), socket.gethostname()
        self.bus.publish(health)
        self.beat = time.monotonic()

    def _turn(self, seconds):
        if time.monotonic() - self.beat >= HEARTBEAT:
            self._say_health(health_t.STATE_BUSY)
        self.bus.turn(seconds)

    def _until(self, condition, seconds, message=None):
        """Listens until the condition holds (True) or the time is over (False); `message` is said again and again."""
        end, due = time.monotonic() + seconds, 0.0
        while not condition():
            now = time.monotonic()
            if now >= end:
                return False
            if message and now >= due:
                self.bus.publish(message)
                due = now + REPEAT
            self._turn(0.02)
        return True
