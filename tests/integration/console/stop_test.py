#!/usr/bin/env python3
"""*Stop* of a console that did not begin what moves: an executive of this machine, one of another, a program of somebody's own.

  stop_test.py BIN ROBOT...      BIN: the folder of the programs; ROBOT...: an example robot's command
"""
import os
import shutil
import sys
import unittest

sys.dont_write_bytecode = True
os.environ["PROSPECT_TEST_BIN"] = sys.argv[1]
import prospect
import stopping
import websocket
from deployment import program, until

ROBOT = sys.argv[2:]
PLAN = "0,8,5,11"  # solves scene 0
INTERRUPTED = 130


class Stop(unittest.TestCase):
    def setUp(self):
        self.table = stopping.moving_table(ROBOT)
        self.console, self.folder = self.table.__enter__()
        self.bus = stopping.Bus()

    def tearDown(self):
        self.table.__exit__(None, None, None)

    def executive(self, *before):
        return stopping.process(*before, program("prospect-executive"), "--policy", "plan:" + PLAN, "--seed", "0", "--out",
                                os.path.join(self.folder, "out"))

    def stays_still(self):
        """The status after the stop is the last word: nothing of that executive's is obeyed any more."""
        self.assertEqual(self.bus.status.state, stopping.CANCELLED)
        self.assertEqual(self.bus.status.command_id, self.bus.cancel.command_id)

    def test_an_executive_of_this_machine(self):
        with self.executive() as executive:
            stopping.press_when_moving(self.console, self.bus)
            self.assertEqual(until(executive.poll, "the executive's end"), INTERRUPTED)
        self.stays_still()

    def test_an_executive_of_another_machine(self):
        if os.environ.get("PROSPECT_PRIVATE_BUS") != "namespace" or not shutil.which("unshare"):
            self.skipTest("no other host name without namespaces")
        with self.executive("unshare", "--uts", "sh", "-c", 'hostname elsewhere; exec "$@"', "sh") as executive:
            stopping.press_when_moving(self.console, self.bus)
            self.assertEqual(until(executive.poll, "the executive's end"), INTERRUPTED)
        self.stays_still()

    def test_between_two_actions(self):
        with prospect.connect() as robot, websocket.WebSocket(self.console.port) as viewer:
            robot.begin(0)
            viewer.say({"t": "stop"})
            self.bus.until(lambda bus: bus.cancel, "CANCEL on the bus")
            with self.assertRaises(prospect.Lost):
                robot.carry_out(0)
        self.assertNotEqual(self.bus.status.state, stopping.RUNNING)

    def test_a_program_of_somebodys_own(self):
        commander = stopping.Commander([0, 8, 5, 11])
        commander.start()
        stopping.press_when_moving(self.console, self.bus)
        commander.join(stopping.SECONDS)
        self.assertFalse(commander.is_alive(), "it still waits for its action to end")
        self.assertIn("stopped from a console", commander.lost)
        self.assertEqual(commander.done, [])
        self.stays_still()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
