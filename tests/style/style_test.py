#!/usr/bin/env python3
"""format.py, tidy.py and task_names.py find what is wrong in a tree made for it, and say nothing of what is right."""
import json
import os
import subprocess
import sys
import tempfile
import unittest

import tidy
from tree import reaches

HERE = os.path.dirname(os.path.abspath(__file__))
TREE = os.path.join(HERE, "..", "..")


class Style(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = os.path.realpath(self.folder.name)
        for name in (".clang-format", ".clang-tidy"):
            with open(os.path.join(TREE, name), encoding="utf-8") as file:
                self.write(name, file.read())

    def tearDown(self):
        self.folder.cleanup()

    def write(self, name, text):
        path = os.path.join(self.root, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def run_script(self, name, *words):
        command = [sys.executable, "-B", os.path.join(HERE, name), self.root, *words]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode == 77:
            self.skipTest(done.stdout)
        return done.returncode, done.stdout

    def test_layout(self):
        self.write("base/good.h", "int Good();\n")
        self.assertEqual(self.run_script("format.py")[0], 0)
        self.write("base/bad.h", "int  Bad( ) ;\n")
        code, said = self.run_script("format.py")
        self.assertEqual(code, 1)
        self.assertIn("base/bad.h: clang-format -i would change it", said)

    def test_names_of_tasks(self):
        self.write("tasks/juggling.yaml", "name: juggling\n")
        self.write("base/good.cpp", '// "juggling"\nconst char* a = "juggling: balls";\n')
        self.write("sim/may.cpp", 'const char* b = "juggling";\n')
        self.assertEqual(self.run_script("task_names.py"), (0, ""))
        self.write("base/bad.cpp", '/* two\nlines */ const char* c = "\\"";\nbool d = e == "juggling";\n')
        code, said = self.run_script("task_names.py")
        self.assertEqual(code, 1)
        self.assertIn('base/bad.cpp:3: names the task "juggling"', said)

    def test_unity_files_and_what_only_gcc_knows(self):
        good = self.write("base/good.cpp", "int* Good() { return nullptr; }\n")
        bad = self.write("base/bad.cpp", "int* Bad() { return 0; }\n")
        unity = self.write("build/Unity/all.cxx", f'#include "{good}"\n#include "{bad}"\n')
        command = f"c++ -std=c++20 -fpch-preprocess -Wno-restrict -include nowhere_pch.hxx -o all.o -c {unity}"
        self.write("build/compile_commands.json",
                   json.dumps([{"directory": self.root, "file": unity, "command": command}]))
        build = os.path.join(self.root, "build")
        self.assertEqual(self.run_script("tidy.py", build, "base/good.cpp")[0], 0)
        code, said = self.run_script("tidy.py", build, "base/good.cpp", "base/bad.cpp")
        self.assertEqual(code, 1)
        self.assertIn("base/bad.cpp:1:", said)
        self.assertIn("modernize-use-nullptr", said)

    def test_libtorch_is_seen_through_headers(self):
        self.write("base/near.h", "#include <torch/torch.h>\n")
        self.write("base/far.cpp", '#include "base/near.h"\n')
        self.write("base/not.cpp", '#include "base/other.h"\n#include <torching>\n')
        self.assertTrue(reaches(self.root, "base/far.cpp", "torch"))
        self.assertFalse(reaches(self.root, "base/not.cpp", "torch"))

    def test_changed_files_are_those_of_the_last_commit_and_after(self):
        git = ["git", "-C", self.root, "-c", "user.name=a", "-c", "user.email=a@b"]

        def run(*words):
            subprocess.run(git + list(words), check=True, capture_output=True)

        run("init", "--initial-branch=main")
        self.write("base/old.cpp", "")
        run("add", "."), run("commit", "-m", "one")
        self.write("base/committed.cpp", "")
        run("add", "."), run("commit", "-m", "two")
        self.write("base/torch.cpp", "#include <torch/torch.h>\n")
        self.write("base/new.cpp", "")
        self.assertEqual(sorted(tidy.changed(self.root)), ["base/committed.cpp", "base/new.cpp"])


if __name__ == "__main__":
    unittest.main()
