#!/usr/bin/env python3
"""Each kind of fault that includes.py looks for is found in a tree made for it."""
import os
import tempfile
import unittest

import includes

PICTURE = """# Rooms

```rooms
base:
planner: base
sim: base planner/rules.h
tests: *
```

```libraries
ode: sim
```
"""
GOOD = {
    "base/a.h": '#include <vector>\n#include "base/b.h"\n',
    "base/b.h": "",
    "planner/rules.h": '#include "base/a.h"\n',
    "planner/search.h": '#include "planner/rules.h"\n',
    "sim/world.cpp": '#include <ode/ode.h>\n#include "planner/rules.h"\n',
    "tests/world_test.cpp": '#include <ode/ode.h>\n#include "sim/world.h"\n#include "planner/search.h"\n',
}


class Faults(unittest.TestCase):
    def faults(self, changes, picture=PICTURE):
        with tempfile.TemporaryDirectory() as root:
            for name, text in {"docs/architecture.md": picture, **GOOD, **changes}.items():
                os.makedirs(os.path.dirname(os.path.join(root, name)), exist_ok=True)
                with open(os.path.join(root, name), "w", encoding="utf-8") as file:
                    file.write(text)
            return includes.faults(root)

    def expect(self, changes, *words):
        found = self.faults(changes)
        self.assertEqual(len(found), 1, found)
        for word in words:
            self.assertIn(word, found[0])

    def test_what_is_in_order(self):
        self.assertEqual(self.faults({}), [])

    def test_a_room_that_may_not(self):
        self.expect({"planner/goal.cpp": '#include "sim/world.h"\n', "sim/world.cpp": ""}, "planner/goal.cpp",
                    "may not include sim/")

    def test_a_header_that_is_not_the_allowed_one(self):
        self.expect({"sim/plan.h": '#include "planner/search.h"\n'}, "sim/plan.h", "planner/search.h")

    def test_a_folder_of_a_room(self):
        picture = PICTURE.replace("planner/rules.h", "planner/rules.h planner/plain/")
        self.assertEqual(self.faults({"sim/plan.h": '#include "planner/plain/a.h"\n', "planner/plain/a.h": ""}, picture), [])
        self.assertIn("planner/plainer.h", self.faults({"sim/plan.h": '#include "planner/plainer.h"\n'}, picture)[0])

    def test_a_library_of_another_room(self):
        self.expect({"base/b.h": "#include <ode/ode.h>\n"}, "base/b.h", "is for sim only")

    def test_a_room_that_nobody_drew(self):
        self.expect({"viewer/main.cpp": ""}, "no room viewer/")

    def test_an_include_from_somewhere_else(self):
        self.expect({"sim/world.cpp": '#include "world.h"\n'}, "of no room")

    def test_files_in_a_circle(self):
        self.expect({"base/b.h": '# include "base/c.h"\n', "base/c.h": '#include "base/a.h"\n'}, "files",
                    "base/a.h > base/b.h > base/c.h > base/a.h")

    def test_rooms_in_a_circle(self):
        picture = PICTURE.replace("base:", "base: sim/world.h")
        found = self.faults({"base/c.cpp": '#include "sim/world.h"\n', "sim/world.h": '#include "base/a.h"\n'}, picture)
        self.assertEqual(len(found), 1, found)
        self.assertIn("rooms include each other: base > sim > base", found[0])

    def test_a_picture_that_is_gone(self):
        with self.assertRaises(ValueError):
            self.faults({}, "# Rooms\n")


if __name__ == "__main__":
    unittest.main()
