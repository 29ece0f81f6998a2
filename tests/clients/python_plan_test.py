"""The Python client asks real services for a plan: the simulator, a model server by script, two workers.

  python_plan_test.py BIN     BIN: the folder of the programs
"""
import os
import subprocess
import sys
import tempfile
import unittest

import prospect

BIN = sys.argv[1]


def program(name, *arguments):
    return subprocess.Popen([os.path.join(BIN, name), *arguments], stderr=subprocess.DEVNULL)


class Plan(unittest.TestCase):
    def setUp(self):
        runtime = tempfile.TemporaryDirectory()  # no deployment of whoever runs the test is joined
        self.addCleanup(runtime.cleanup)
        os.environ["XDG_RUNTIME_DIR"] = runtime.name
        self.services = []
        self.addCleanup(lambda: [service.kill() or service.wait() for service in self.services])

    def start(self, *services):
        self.services += [program(*service) for service in services]

    def test_a_plan_with_its_pictures_is_read_and_carried_out(self):
        self.start(("prospect-simulator", "--objects", "7"), ("prospect-model-server", "--weights", "scripted:7"),
                   ("prospect-worker",), ("prospect-worker",))
        with prospect.connect(timeout=20) as robot:
            before = robot.look()
            self.assertEqual((before.width, before.height), (64, 64))
            plan = robot.plan(program=os.path.join(BIN, "prospect"))
            self.assertEqual(len(plan), 3, plan.reason)
            self.assertGreater(plan.score, 0)
            for step in plan:
                self.assertEqual(step.name, robot.actions()[step.action])
                self.assertEqual((step.picture.width, step.picture.height), (64, 64))
            self.assertNotEqual(plan[0].picture.pixels, plan[2].picture.pixels)
            self.assertEqual(robot.look().pixels, before.pixels, "a plan moves nothing")
            robot.carry_out(plan[0].action)
            self.assertNotEqual(robot.look().pixels, before.pixels)

    def test_without_workers_there_is_no_plan_and_no_other_scene_is_planned_for(self):
        self.start(("prospect-simulator",))
        with prospect.connect(timeout=20) as robot, self.assertRaises(prospect.Lost):
            robot.plan(program=os.path.join(BIN, "prospect"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
