#!/usr/bin/env python3
"""Parses every `./prospect ...` of the docs by the table of options, without carrying it out.

  commands.py ROOT PROSPECT    PROSPECT: the program, bin/prospect; prints a line a fault and ends with 1 if there is one

In blocks of code each command must parse as it stands, typed in ROOT (--dry-run). In running text `./prospect COMMAND` must have a help, and one
with options must parse, unless it holds a word in capitals, which stands for something.
"""
import os
import re
import shlex
import subprocess
import sys

from links import markdown_files, read, without_labelled

BLOCK = re.compile(r"^( *)```\n(.*?)^\1```$", re.M | re.S)
INLINE = re.compile(r"(?<!`)`\./prospect ([^`\n]+)`(?!`)")


def words_of(line):
    lexer = shlex.shlex(line, posix=True, punctuation_chars=True)
    lexer.wordchars += ",:*@%+$"
    return list(lexer)


def commands_in(words):
    """Arguments of each ./prospect among shell words."""
    for start, word in enumerate(words):
        if word == "./prospect":
            rest = words[start + 1:]
            yield rest[:next((i for i, w in enumerate(rest) if set(w) <= set(";&|()<>")), len(rest))]


def block_commands(text):
    for found in BLOCK.finditer(text):
        line = text.count("\n", 0, found.start(2)) + 1
        for number, command in enumerate(found.group(2).replace("\\\n", "  ").split("\n")):
            # Within "$(...)", too, where quotes hide it.
            command = command.replace('"$(', " ( ").replace(')"', " ) ")
            if "./prospect" not in command:
                continue
            try:
                words = words_of(command)
            except ValueError:  # a string that goes on in the next line
                continue
            for arguments in commands_in(words):
                if not any("$" in word for word in arguments):  # a loop's variable
                    yield line + number, arguments


def inline_commands(text):
    for found in INLINE.finditer(re.sub(BLOCK, lambda block: "\n" * block.group().count("\n"), text)):
        arguments = words_of(found.group(1))
        arguments = next(commands_in(["./prospect"] + arguments))
        if any(re.fullmatch(r"[A-Z]+|\.\.\.", word) for word in arguments):
            continue
        takes_options = any(word.startswith("-") or "=" in word for word in arguments)
        yield text.count("\n", 0, found.start()) + 1, arguments if takes_options else arguments + ["--help"]


def fault_of(root, prospect, arguments):
    said = subprocess.run([prospect, "--dry-run"] + arguments, cwd=root, capture_output=True, text=True, timeout=20)
    return None if said.returncode == 0 else said.stderr.strip() or f"ended with {said.returncode}"


def faults(root, prospect):
    count = 0
    for name in markdown_files(root):
        text = without_labelled(read(os.path.join(root, name)))
        for line, arguments in list(block_commands(text)) + list(inline_commands(text)):
            count += 1
            fault = fault_of(root, prospect, arguments)
            if fault:
                yield f"{name}:{line}: ./prospect {' '.join(arguments)}: {fault}"
    if count < 50:
        yield f"only {count} commands were found: is this the root of the docs?"


def main():
    found = list(faults(*sys.argv[1:3]))
    print("\n".join(found) or "every command parses")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
