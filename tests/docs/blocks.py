#!/usr/bin/env python3
"""Runs the shell blocks of the docs, each as a person would type it.

  blocks.py ROOT BUILD PAGE.md... [--full] [--list]

A block runs under `bash -e` with the programs in BUILD, on a bus of its own, in a scratch folder that looks like ROOT (one a page,
so that a block finds what those before it left). It must end with 0. An HTML comment before a block says otherwise:

  <!-- ends with: 3 -->           the exit code of its last command
  <!-- slow: why -->              takes more than a minute: only with --full
  <!-- not run: why -->           never

Ends with 1 if a block did not do what it should.
"""
import argparse
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from links import read, without_labelled

BLOCK = re.compile(r"(?:^ *<!-- (?P<mark>[^\n]*?) -->\n)?^(?P<indent> *)```\n(?P<code>.*?)^(?P=indent)```$", re.M | re.S)
SECONDS, FULL_SECONDS = 180, 3600


def blocks_of(path):
    text = without_labelled(read(path))
    for found in BLOCK.finditer(text):
        line = text.count("\n", 0, found.start("code")) + 1
        word, _, why = (found["mark"] or "run: 0").partition(": ")
        if word not in ("run", "ends with", "slow", "not run"):
            sys.exit(f"{path}:{line}: unknown mark '{found['mark']}'")
        yield line, word, why, found["code"]


def scratch_of(root, build):
    """`prospect` finds its root by its own place, so it is copied; everything else is only read."""
    folder = tempfile.mkdtemp(prefix="prospect-docs-")
    for name in os.listdir(root):
        if name not in ("prospect", "out", "build", ".git"):
            os.symlink(os.path.join(root, name), os.path.join(folder, name))
    shutil.copy(os.path.join(root, "prospect"), folder)
    for made in ("build", "run"):
        os.mkdir(os.path.join(folder, made), 0o700)
    os.symlink(build, os.path.join(folder, "build", "release"))
    return folder


def run(code, folder, root, build, seconds):
    """Returns the exit code, None for too long, and what was said."""
    environment = dict(os.environ, PROSPECT_BUILD=build, XDG_RUNTIME_DIR=folder + "/run", HOME=folder,
                       PROSPECT_DATA=folder + "/data")
    # Whatever the block leaves running ends with it.
    script = f"trap 'set +e; kill $(jobs -p) 2>/dev/null; ./prospect down >/dev/null 2>&1' EXIT\n{code}"
    with tempfile.TemporaryFile("w+") as said:
        child = subprocess.Popen([root + "/tests/integration/with_bus.sh", "bash", "-e", "-c", script], cwd=folder,
                                 env=environment, stdin=subprocess.DEVNULL, stdout=said, stderr=said, start_new_session=True)
        try:
            status = child.wait(seconds)
        except subprocess.TimeoutExpired:
            os.killpg(child.pid, signal.SIGTERM)
            status = None
            try:
                child.wait(15)
            except subprocess.TimeoutExpired:
                os.killpg(child.pid, signal.SIGKILL)
        said.seek(0)
        return status, said.read()


def try_block(place, word, why, code, where, full):
    """Whether the block did what it should."""
    if word == "not run" or (word == "slow" and not full):
        print(f"{place}: {word}: {why}")
        return True
    expected = int(why) if word == "ends with" else 0
    start = time.monotonic()
    status, said = run(code, *where, FULL_SECONDS if full else SECONDS)
    print(f"{place}: ended with {'a time-out' if status is None else status} after {time.monotonic() - start:.0f} s", flush=True)
    if status == expected:
        return True
    print(f"{place}: should end with {expected}:\n{code}\nIt said:\n{said}")
    return False


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", type=os.path.abspath)
    parser.add_argument("build", type=os.path.abspath)
    parser.add_argument("pages", nargs="+", help="relative to ROOT")
    parser.add_argument("--full", action="store_true", help="slow blocks, too")
    parser.add_argument("--list", action="store_true", help="only list the blocks")
    asked = parser.parse_args()
    good = True
    for page in asked.pages:
        folder = scratch_of(asked.root, asked.build)
        try:
            for line, word, why, code in blocks_of(os.path.join(asked.root, page)):
                if asked.list:
                    print(f"{page}:{line}: {word}: {why}: {code.splitlines()[0]}")
                else:
                    good &= try_block(f"{page}:{line}", word, why, code, (folder, asked.root, asked.build), asked.full)
        finally:
            shutil.rmtree(folder, ignore_errors=True)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
