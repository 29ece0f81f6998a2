#!/usr/bin/env python3
"""Reads what `prospect dataset export` writes the way robomimic's own loader does: attributes, masks, shapes, windows of frames.

  robomimic_test.py PROSPECT_DATA    h5py is Debian's python3-h5py
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy

PROGRAM = sys.argv.pop(1)


def run(*arguments):
    subprocess.run([PROGRAM, *arguments], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


class Export(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        path = lambda name: os.path.join(cls.folder.name, name)
        run("collect", "--task", "navigation", "--trials", "8", "--seed", "0", "--jobs", "1", "--out", path("set.h5"))
        run("export", path("set.h5"), "--next-obs", "--out", path("robomimic.hdf5"), "--segments", path("segments.csv"))
        run("export", path("set.h5"), "--out", path("plain.hdf5"))
        cls.ours = h5py.File(path("set.h5"), "r")
        cls.file = h5py.File(path("robomimic.hdf5"), "r")
        cls.plain = h5py.File(path("plain.hdf5"), "r")

    @classmethod
    def tearDownClass(cls):
        for file in (cls.ours, cls.file, cls.plain):
            file.close()
        cls.folder.cleanup()

    def demos(self, part=None):
        if part is None:
            return list(self.file["data"].keys())
        return [name.decode("utf-8") for name in numpy.array(self.file[f"mask/{part}"][:])]

    def test_the_environment_is_described(self):
        env = json.loads(self.file["data"].attrs["env_args"])
        self.assertEqual(env["env_name"], "navigation")
        self.assertIsInstance(env["type"], int)
        self.assertIsInstance(env["env_kwargs"], dict)

    def test_masks_name_each_demonstration_once(self):
        named = [name for part in ("train", "valid", "test") for name in self.demos(part)]
        self.assertEqual(sorted(named), sorted(self.demos()))
        self.assertTrue(self.demos("train"))

    def test_names_end_with_numbers(self):
        self.assertEqual(sorted(int(name[5:]) for name in self.demos()), list(range(8)))

    def test_total_is_the_sum_of_samples(self):
        samples = [int(self.file[f"data/{name}"].attrs["num_samples"]) for name in self.demos()]
        self.assertEqual(int(self.file["data"].attrs["total"]), sum(samples))

    def test_rows_are_of_one_length(self):
        for name in self.demos():
            demo = self.file[f"data/{name}"]
            samples = int(demo.attrs["num_samples"])
            for key in ("obs/agentview_image", "next_obs/agentview_image", "actions", "rewards", "dones"):
                self.assertEqual(demo[key].shape[0], samples, key)
            self.assertEqual(demo["actions"].dtype, numpy.float32)
            self.assertEqual(demo["obs/agentview_image"].dtype, numpy.uint8)
            self.assertEqual(demo["obs/agentview_image"].shape[1:], (64, 64, 3))

    def test_actions_lead_to_the_next_picture(self):
        for name in self.demos():
            actions = self.file[f"data/{name}/actions"][()]
            labels = self.ours[f"data/{name}/actions"][:, 0]
            self.assertTrue(set(numpy.unique(actions)) <= {0.0, 1.0}, "within robomimic's -1 to 1")
            numpy.testing.assert_array_equal(actions[:-1].argmax(axis=1), labels[1:])

    def test_next_obs_is_a_frame_later(self):
        for name in self.demos():
            now = self.file[f"data/{name}/obs/agentview_image"][()]
            later = self.file[f"data/{name}/next_obs/agentview_image"][()]
            numpy.testing.assert_array_equal(later[:-1], now[1:])
            numpy.testing.assert_array_equal(later[-1], now[-1])
            numpy.testing.assert_array_equal(now, self.ours[f"data/{name}/obs/agentview_image"][()])

    def test_next_obs_comes_on_request(self):
        self.assertNotIn("next_obs", self.plain["data/demo_0"])

    def test_a_window_of_frames_is_read(self):
        demo = self.file["data/demo_0"]
        self.assertEqual(demo["obs/agentview_image"][2:5].shape, (3, 64, 64, 3))
        self.assertEqual(int(demo["dones"][()].sum()), 1)


if __name__ == "__main__":
    unittest.main()
