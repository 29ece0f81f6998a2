#!/usr/bin/env python3
"""Checks that every C++ file is laid out as .clang-format says.

  format.py ROOT [clang-format]    prints what is not and ends with 1 if there is something; 77 (skipped): no clang-format

To mend: clang-format -i FILE...
"""
import os
import shutil
import subprocess
import sys

from tree import sources

SKIPPED = 77


def main():
    root, program = sys.argv[1], shutil.which((sys.argv[2:] or ["clang-format"])[0])
    if not program:
        print("clang-format was not found (Debian: clang-format)")
        return SKIPPED
    files = sorted(sources(root))
    done = subprocess.run([program, "--dry-run", "--Werror"] + files, cwd=root, stderr=subprocess.PIPE, text=True, check=False)
    faulty = sorted({line.split(":")[0] for line in done.stderr.splitlines() if "error:" in line})
    for file in faulty:
        print(f"{file}: clang-format -i would change it")
    if done.returncode and not faulty:
        print(done.stderr)
    print(f"{len(files)} files, {len(faulty)} not laid out as .clang-format says")
    return 1 if done.returncode else 0


if __name__ == "__main__":
    sys.exit(main())
