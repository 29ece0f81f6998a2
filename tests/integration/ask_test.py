#!/usr/bin/env python3
"""A robot that cannot tell whether its actions worked, and a person at a terminal who can: what the person says ends the episode
and becomes the recording's labels. Run on a bus of its own (with_bus.sh).

  ask_test.py BIN ROBOT     BIN: the folder of the programs; ROBOT: made_robot
"""
import json
import os
import pty
import select
import signal
import subprocess
import sys
import tempfile
import time
import unittest

BIN, ROBOT = sys.argv[1:3]
PATIENCE = 60  # s
TASK = """name: rover
picture: {width: 32, height: 48}
actions: [scan, drive(hill), drive(lake), report]
first: scan
follows:
  scan: drive
  drive: [drive(other), report]
  report: []
plan_length: 4
tick_seconds: 0.1
action_time_limit: 5
"""


class Terminal:
    """A program at a terminal."""

    def __init__(self, *command):
        self.screen, other = pty.openpty()
        self.said = ""
        self.process = subprocess.Popen(command, stdin=other, stdout=other, stderr=other, start_new_session=True)
        os.close(other)

    def until(self, text):
        """Reads on until `text` is on the screen; what stood before it is forgotten."""
        end = time.monotonic() + PATIENCE
        while text not in self.said:
            ready, _, _ = select.select([self.screen], [], [], max(0, end - time.monotonic()))
            if not ready:
                raise AssertionError(f"'{text}' did not come, but: {self.said}")
            try:
                self.said += os.read(self.screen, 4096).decode()
            except OSError as error:  # the program has left
                raise AssertionError(f"'{text}' did not come, but: {self.said}") from error
        self.said = self.said[self.said.index(text) + len(text):]

    def answer(self, text):
        os.write(self.screen, (text + "\n").encode())

    def close(self):
        os.close(self.screen)


class Ask(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.started = []
        self.log = self.path("site.lcmlog")
        with open(self.path("rover.yaml"), "w", encoding="utf-8") as file:
            file.write(TASK)
        self.start("lcm-logger", "-q", self.log)
        while not os.path.exists(self.log):
            time.sleep(0.01)
        self.start(ROBOT, self.path("rover.yaml"), "--judges", "no")

    def tearDown(self):
        for process in self.started:
            process.terminate()
            process.wait()
        self.folder.cleanup()

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def start(self, *command):
        self.started.append(subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))

    def command(self, *arguments):
        return [os.path.join(BIN, "prospect-executive"), "--no-reset", "--policy", "plan:0,1,2,3", "--out", self.path("out"), *arguments]

    def episode(self, *arguments):
        terminal = Terminal(*self.command(*arguments))
        self.addCleanup(terminal.close)
        return terminal

    def data_set(self, expect=0):
        """What `dataset from-log` says of the recording, by its report."""
        for process in self.started:
            process.terminate()
            process.wait()
        self.started = []
        report = self.path("report.json")
        done = subprocess.run([os.path.join(BIN, "prospect-data"), "from-log", self.log, "--out", self.path("site.h5"), "--json", report],
                              check=False, capture_output=True, text=True)
        self.assertEqual(done.returncode, expect, done.stdout + done.stderr)
        with open(report, encoding="utf-8") as file:
            return json.load(file)["rows"]

    def test_what_a_person_says_is_the_outcome_and_the_label(self):
        episode = self.episode("--ask")
        for name in ("scan", "drive(hill)", "drive(lake)"):
            episode.until(f"{name}: did it work? [y/n]")
            episode.answer("yes" if name == "scan" else "y")
        episode.until("report: did it work? [y/n]")
        episode.answer("perhaps")
        episode.until("report: did it work? [y/n]")
        episode.answer("n")
        self.assertEqual(episode.process.wait(PATIENCE), 4, episode.said)
        rows = self.data_set()
        self.assertEqual([row["outcome"] for row in rows], ["failure"])
        self.assertEqual(rows[0]["frames"], 21)

    def test_all_that_worked_is_solved(self):
        episode = self.episode("--ask")
        for name in ("scan", "drive(hill)", "drive(lake)", "report"):
            episode.until(f"{name}: did it work? [y/n]")
            episode.answer("y")
        self.assertEqual(episode.process.wait(PATIENCE), 0, episode.said)
        self.assertEqual([row["outcome"] for row in self.data_set()], ["success"])

    def test_what_was_typed_before_the_question_is_no_answer(self):
        episode = self.episode("--ask")
        episode.answer("y")
        episode.until("scan: did it work? [y/n]")
        episode.answer("n")
        episode.until("scan: failed")
        self.assertEqual(episode.process.wait(PATIENCE), 4)

    def test_a_stop_while_asking_leaves_no_trial(self):
        episode = self.episode("--ask")
        episode.until("scan: did it work? [y/n]")
        episode.process.send_signal(signal.SIGINT)
        self.assertEqual(episode.process.wait(PATIENCE), 130)
        rows = self.data_set(expect=14)
        self.assertEqual(rows[0]["reason"], "nobody said whether scan worked: record with run --ask")

    def test_nobody_to_ask_is_said_before_anything_moves(self):
        done = subprocess.run(self.command("--ask"), check=False, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=PATIENCE)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("the input is no terminal", done.stderr)
        rows = self.data_set(expect=14)
        self.assertTrue(all(row["frames"] <= 1 for row in rows))

    def test_without_ask_a_robot_that_cannot_tell_is_not_believed(self):
        done = subprocess.run(self.command(), check=False, capture_output=True, text=True, timeout=PATIENCE)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertIn("cannot tell whether scan worked: with --ask you are asked", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
