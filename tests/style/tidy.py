#!/usr/bin/env python3
"""Runs clang-tidy with .clang-tidy over C++ files, its warnings as errors.

  tidy.py ROOT BUILD             files of the last commit and those that are not committed yet, but for those that include libtorch (whose headers take
                                 clang-tidy half a minute a file)
  tidy.py ROOT BUILD --all       every file
  tidy.py ROOT BUILD FILE...     these
  ... --jobs N                   processes; as many as there are processors otherwise

BUILD is a folder that CMake has configured and whose headers from messages are made. Ends with 0 if nothing is to be said, 1 if
something is, 77 (skipped) where clang-tidy or git is not to be had.
"""
import argparse
import concurrent.futures
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import time

from tree import reaches, read, sources

SKIPPED = 77
SLOW = "torch"
# The compiler's own: warnings that clang does not know, headers that GCC has precompiled.
OF_GCC = re.compile(r"-W.*|-fpch-preprocess|-O\d")


def git(root, *words):
    done = subprocess.run(["git", "-C", root, *words], capture_output=True, text=True, check=False)
    return done.stdout.split() if done.returncode == 0 else None


def base_of(root):
    """The commit before the last one; the last one where git knows no other."""
    return (git(root, "rev-parse", "HEAD~1") or git(root, "rev-parse", "HEAD") or [None])[0]


def changed(root):
    """None where git cannot tell."""
    base = base_of(root)
    if base is None:
        return None
    names = git(root, "diff", "--name-only", "--diff-filter=d", base) + git(root, "ls-files", "--others", "--exclude-standard")
    known = {}
    return [file for file in sources(root) if file in set(names) and not reaches(root, file, SLOW, known)]


def without_gcc(command):
    words, kept = shlex.split(command), []
    while words:
        word = words.pop(0)
        if word == "-include":
            words.pop(0)
        elif not OF_GCC.fullmatch(word):
            kept.append(word)
    return kept


def each_file(entry):
    """An entry of CMake's list of commands as one for each file that it compiles together."""
    words, unity = without_gcc(entry["command"]), entry["file"]
    files = [unity]
    if "/Unity/" in unity:
        files = re.findall(r'#include "([^"]+)"', read(unity)) if os.path.exists(unity) else []
    for file in files:
        yield {"directory": entry["directory"], "file": file, "arguments": [file if word == unity else word for word in words]}


def write_commands(build, folder):
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        entries = [each for entry in json.load(file) for each in each_file(entry)]
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, "compile_commands.json"), "w", encoding="utf-8") as file:
        json.dump(entries, file)


def check(program, root, folder, file):
    """What clang-tidy says of a file; empty: nothing."""
    command = [program, "-p", folder, "--quiet", "--extra-arg=-Wno-pragma-once-outside-header", os.path.join(root, file)]
    done = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
    said = done.stdout.strip() or (done.stderr.strip() if done.returncode else "")
    return said.replace(root + "/", "")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", type=os.path.realpath)
    parser.add_argument("build", type=os.path.realpath)
    parser.add_argument("files", nargs="*", metavar="FILE")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    return parser.parse_intermixed_args()


def main():
    options = arguments()
    program = shutil.which("clang-tidy")
    files = options.files or (sorted(sources(options.root)) if options.all else changed(options.root))
    if not program or files is None:
        print("clang-tidy was not found (Debian: clang-tidy)" if not program else "git does not tell what has changed")
        return SKIPPED
    folder = os.path.join(options.build, "tidy")
    write_commands(options.build, folder)
    begin, faulty = time.monotonic(), 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for said in pool.map(lambda file: check(program, options.root, folder, file), files):
            faulty += bool(said)
            print(said + "\n" if said else "", end="", flush=True)
    print(f"{len(files)} files, clang-tidy has something to say of {faulty}; {time.monotonic() - begin:.0f} s")
    return 1 if faulty else 0


if __name__ == "__main__":
    sys.exit(main())
