#!/usr/bin/env python3
"""An example robot, whatever its language: it keeps to the rules, and its table is that of examples/robots/python/world.py.

  example_robot_test.py BIN ROBOT...      BIN: the folder of the programs; ROBOT...: the robot's command
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

import prospect
import world
from prospect import observation_t

BIN, ROBOT = sys.argv[1], sys.argv[2:]
SOLVES = (0, 8, 5, 11)  # of seed 0, as are these, each of which ends with what its action fails of
SEED, FAILURES = 0, {"blocked": [2], "reach": [4], "lid": [0, 9], "gone": [0, 8, 4], "full": [0, 8, 1, 8]}


class Process:
    """The robot, as long as a test needs it."""

    def __init__(self, speed):
        self.process = subprocess.Popen(ROBOT + ["--speed", str(speed)], stderr=subprocess.DEVNULL)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()


def run(program, *arguments):
    """Exit code and the report."""
    with tempfile.TemporaryDirectory() as folder:
        report = os.path.join(folder, "report.json")
        code = subprocess.run([os.path.join(BIN, program), *arguments, "--json", report], check=False,
                              stdout=subprocess.DEVNULL).returncode
        with open(report, encoding="utf-8") as file:
            return code, json.load(file)


def plan_text(plan):
    return "plan:" + ",".join(map(str, plan))


def pictures_of(seed, plan):
    """What the world in Python shows: a picture a tick, up to the end of the plan or a failure; and the cause."""
    table = world.World(seed)
    pictures = [table.picture()]
    for action in plan:
        table.begin(action)
        goes_on = True
        while goes_on:
            goes_on = table.tick()
            pictures.append(table.picture())
        if table.cause:
            break
    return pictures, table.cause


class ExampleRobot(unittest.TestCase):
    def test_keeps_to_all_rules(self):
        with Process(speed=1):
            code, report = run("prospect-bus", "check-robot")
        self.assertEqual(code, 0, report)
        self.assertEqual({row["verdict"] for row in report["rows"]} - {"note"}, {"ok"}, report)

    def test_a_plan_that_works_solves_and_wrong_orders_fail_with_their_cause(self):
        with Process(speed=0):
            code, result = run("prospect-executive", "--seed", str(SEED), "--policy", plan_text(SOLVES))
            self.assertEqual((code, result["outcome"]), (0, "solved"), result)
            for cause, plan in FAILURES.items():
                code, result = run("prospect-executive", "--seed", str(SEED), "--policy", plan_text(plan))
                self.assertEqual((code, result["outcome"]), (4, "failed"), result)
                self.assertEqual((len(result["acts"]), result["acts"][-1]["reason"]), (len(plan), cause))
                self.assertIn(world.CAUSES[cause], result["reason"])

    def test_each_picture_is_the_one_of_its_scene_and_plan(self):
        with Process(speed=0), prospect.connect() as robot:
            seen = {}

            def see(picture):
                seen[picture.frame] = picture.data
                robot._see(picture)

            robot.bus.subscribe(observation_t, see)
            for plan in (SOLVES, *FAILURES.values()):
                robot.begin(SEED)
                seen.clear()
                for action in plan:
                    if not robot.carry_out(action):
                        break
                expected, cause = pictures_of(SEED, plan)
                self.assertEqual(robot.status.reason, cause)
                for frame in range(1, len(expected)):
                    self.assertEqual(seen.get(frame), expected[frame], f"{plan}, frame {frame}")

    def test_a_reset_heeds_its_seed(self):
        with Process(speed=0), prospect.connect() as robot:
            first = {}
            for seed in list(range(20)) + list(range(20)):
                robot.begin(seed)
                self.assertEqual(robot.look().pixels, world.World(seed).picture())
                first[seed] = robot.look().pixels
            self.assertGreater(len(set(first.values())), 15)

    def test_trials_are_counted_and_go_on_where_they_were_left(self):
        with Process(speed=0), tempfile.TemporaryDirectory() as out:
            collect = ["prospect-executive", "--policy", "collect", "--seed", "100", "--out", out, "--episodes"]
            code, counts = run(*collect, "15")
            self.assertEqual((code, counts["episodes"]), (0, 15))
            code, counts = run(*collect, "40")
        self.assertEqual((code, counts["episodes"], counts["first_seed"]), (0, 40, 100))
        self.assertEqual(sum(counts["outcomes"].values()), 40)
        self.assertEqual([row["name"] for row in counts["actions"]], [world.name(i) for i in range(12)])
        tried, succeeded = (sum(row[key] for row in counts["actions"]) for key in ("tried", "succeeded"))
        # Each failed trial ends with the one action that failed.
        self.assertEqual(tried - succeeded, counts["outcomes"]["failed"])
        self.assertGreaterEqual(succeeded, 4 * counts["outcomes"]["solved"])

    def test_a_person_who_sets_scenes_up_is_waited_for(self):
        with Process(speed=0), tempfile.TemporaryDirectory() as out:
            collect = [os.path.join(BIN, "prospect-executive"), "--policy", "collect", "--episodes", "3", "--out", out, "--quiet"]
            ended = subprocess.run([*collect, "--pause"], input=b"\n\n", check=False, capture_output=True)
            self.assertEqual(ended.returncode, 130, ended.stderr)
            with open(os.path.join(out, "trials.json"), encoding="utf-8") as file:
                self.assertEqual(json.load(file)["episodes"], 2)

    def test_without_a_reset_each_trial_must_be_a_new_episode(self):
        with Process(speed=0), tempfile.TemporaryDirectory() as out:
            ended = subprocess.run([os.path.join(BIN, "prospect-executive"), "--policy", "collect", "--episodes", "3", "--out", out,
                                    "--no-reset", "--scene-timeout-ms", "1000"], check=False, capture_output=True)
            self.assertEqual(ended.returncode, 16, ended.stderr)
            with open(os.path.join(out, "trials.json"), encoding="utf-8") as file:
                self.assertEqual(json.load(file)["episodes"], 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
