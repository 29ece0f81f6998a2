#!/usr/bin/env python3
"""Checks that no C++ source outside sim/ and tasks/ compares with, or defaults to, the name of a task: what is known of a task
stands in its file (docs/task-files.md).

  task_names.py ROOT    prints a line a fault and ends with 1 if there is one

A name counts where it is a whole string, in code: "stacking", not "stacking: blocks in the tower" and not in a comment. Tests,
and examples, which are robots of some task, may name one.
"""
import os
import re
import sys

from tree import read, sources

MAY = ("sim", "tasks", "tests", "examples", "clients")
CODE = re.compile(r'"(?:[^"\\\n]|\\.)*"|//[^\n]*|/\*.*?\*/', re.S)


def names(root):
    return {file[:-len(".yaml")] for file in os.listdir(os.path.join(root, "tasks")) if file.endswith(".yaml")}


def faults(root):
    known = names(root)
    for file in sorted(sources(root)):
        if file.split("/")[0] in MAY:
            continue
        text = read(os.path.join(root, file))
        for found in CODE.finditer(text):
            if found[0][0] == '"' and found[0][1:-1] in known:
                line = text.count("\n", 0, found.start()) + 1
                yield f"{file}:{line}: names the task {found[0]}: let its file say what is to be known of it"


def main():
    found = list(faults(sys.argv[1]))
    for fault in found:
        print(fault)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
