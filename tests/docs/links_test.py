#!/usr/bin/env python3
"""Each kind of fault that links.py looks for is found in a folder made for it."""
import os
import tempfile
import unittest

import links

GOOD = "# Results\n\nFigures.\n\n## Blocks\n\n| solved | 86.0 % |\n"


class Faults(unittest.TestCase):
    def faults(self, readme, page="# A page\n\nWhat it answers.\n"):
        with tempfile.TemporaryDirectory() as root:
            os.mkdir(os.path.join(root, "docs"))
            for name, text in (("README.md", readme), ("docs/results.md", GOOD), ("docs/page.md", page)):
                with open(os.path.join(root, name), "w", encoding="utf-8") as file:
                    file.write(text)
            return links.faults(root)

    def test_what_is_in_order(self):
        self.assertEqual(self.faults("[a](docs/results.md#blocks) solves 86.0 %, `[not](a link)`\n"), [])

    def test_a_file_that_is_not_there(self):
        self.assertIn("no such file", self.faults("![a](docs/none.png)")[0])

    def test_a_heading_that_is_not_there(self):
        self.assertIn("no such heading", self.faults("[a](docs/results.md#stacking)")[0])

    def test_a_figure_that_was_not_measured(self):
        for figure in ("87 %", "6.0 %", "20 ms", "3 min"):
            self.assertIn(figure, self.faults(f"It solves {figure}.")[0])

    def test_a_long_readme(self):
        self.assertIn("bytes", self.faults("x" * 9217)[0])

    def test_a_path_of_one_machine(self):
        self.assertIn("one machine", self.faults("It lies in `/" + "root/x`.")[0])

    def test_a_page_that_does_not_say_what_it_answers(self):
        self.assertIn("what it answers", self.faults("", "# A page\n\n## At once\n")[0])


if __name__ == "__main__":
    unittest.main()
