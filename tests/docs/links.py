#!/usr/bin/env python3
"""Checks the docs: links and anchors resolve, the README is short and repeats only figures that are measured.

  links.py ROOT    prints a line a fault and ends with 1 if there is one

What is checked of every *.md file that git knows (or, without git, that lies outside build and out): each relative link and
each anchor, also of pictures; that no path of one machine stands in it. Of README.md: at most 9,216 bytes; each share and time
(86.0 %, 20 ms) stands in docs/results.md, too. Of docs/*.md: a first paragraph after the title.
"""
import os
import re
import subprocess
import sys

README_BYTES = 9216
FIGURE = re.compile(r"(?<![\d.,])\d[\d,]*(?:\.\d+)? ?(?:%|ms|s|min|minutes|hours)(?![\w/])")
MACHINE = re.compile(r"(?:^|[\s`'\"(=])/(?:root|work|home|tmp)/\S*")


def markdown_files(root):
    listed = subprocess.run(["git", "-C", root, "ls-files", "-co", "--exclude-standard", "*.md"],
                            capture_output=True, text=True)
    if listed.returncode == 0 and listed.stdout:
        return sorted(name for name in listed.stdout.split() if os.path.exists(os.path.join(root, name)))
    found = []
    for folder, folders, files in os.walk(root):
        folders[:] = [f for f in folders if f not in ("build", "out", ".git")]
        found += [os.path.relpath(os.path.join(folder, f), root) for f in files if f.endswith(".md")]
    return sorted(found)


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def without_labelled(text):
    """Blocks of another language than the shell's are left empty; lines keep their numbers."""
    return re.sub(r"^( *)```\w+\n.*?^\1```$", lambda block: "\n" * block.group().count("\n"), text, flags=re.M | re.S)


def without_code(text):
    text = re.sub(r"^( *)```.*?^\1```", "", text, flags=re.M | re.S)
    return re.sub(r"`[^`\n]*`", lambda code: code.group().replace("[", " ").replace("](", " "), text)


def anchors(text):
    """As GitHub makes them of headings."""
    seen = {}
    for heading in re.findall(r"^#{1,6} +(.*)$", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S), flags=re.M):
        slug = re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")
        count = seen.get(slug, 0)
        seen[slug] = count + 1
        yield f"{slug}-{count}" if count else slug


def link_faults(root, name):
    text = read(os.path.join(root, name))
    for target in re.findall(r"\]\(([^)\s]+)\)", without_code(text)):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        file = os.path.normpath(os.path.join(root, os.path.dirname(name), path)) if path else os.path.join(root, name)
        if not os.path.exists(file):
            yield f"{name}: {target}: there is no such file"
        elif anchor and anchor not in anchors(read(file)):
            yield f"{name}: {target}: there is no such heading"


def page_faults(root, name):
    text = read(os.path.join(root, name))
    for path in MACHINE.findall(text):
        yield f"{name}: {path.strip()} is a path of one machine"
    if re.match(r"docs/[^/]*\.md$", name) and not re.match(r"# [^\n]+\n\n[A-Z`]", text):
        yield f"{name}: does not begin with a title and a line that says what it answers"


def readme_faults(root):
    text = read(os.path.join(root, "README.md"))
    if len(text.encode()) > README_BYTES:
        yield f"README.md: {len(text.encode())} bytes, more than {README_BYTES}"
    results = read(os.path.join(root, "docs", "results.md"))
    for figure in FIGURE.findall(re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)):
        if not re.search(r"(?<![\d.,])" + re.escape(figure) + r"(?!\w)", results):
            yield f"README.md: '{figure}' does not stand in docs/results.md"


def faults(root):
    found = list(readme_faults(root))
    for name in markdown_files(root):
        found += list(link_faults(root, name)) + list(page_faults(root, name))
    return found


def main():
    found = faults(sys.argv[1])
    print("\n".join(found) or "every link and figure is in order")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
