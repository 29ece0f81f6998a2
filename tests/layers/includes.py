#!/usr/bin/env python3
"""Checks the includes of all C++ files against the picture of the rooms in docs/architecture.md.

  includes.py ROOT    prints a line a fault and ends with 1 if there is one

What is allowed stands there in two blocks, and nowhere else:
  ```rooms        "sim: base planner/tower.h": a room may include whole rooms, folders or headers; *: everything
  ```libraries    "opencv2: report": the rooms that may include <opencv2/...>; tests may all
Faults are: an include that they do not allow, a room that they do not know, files that include each other in a circle, and
rooms that do. What lcm-gen makes ("prospect/...") counts as lcmtypes.
"""
import os
import re
import sys

SOURCE = (".h", ".cpp")
NO_ROOMS = ("build", "out", "shared", ".git")
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(["<])([^">\n]+)[">]', re.M)


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def block(text, name):
    """The lines "key: words" of a fenced block as {key: [words]}."""
    found = re.search(rf"^```{name}\n(.*?)^```", text, flags=re.M | re.S)
    if not found:
        raise ValueError(f"docs/architecture.md: has no block ```{name}")
    lines = (line.partition(":") for line in found.group(1).splitlines() if line.strip())
    return {key.strip(): words.split() for key, _, words in lines}


def sources(root):
    for folder, folders, files in os.walk(root):
        if folder == root:
            folders[:] = [f for f in folders if f not in NO_ROOMS]
        for file in sorted(files):
            if file.endswith(SOURCE):
                yield os.path.relpath(os.path.join(folder, file), root)


def room_of(path):
    room = path.split("/")[0]
    return "lcmtypes" if room == "prospect" else room


def allowed(path, words):
    within = (word for word in words if word.endswith("/"))
    return "*" in words or room_of(path) in words or path in words or any(path.startswith(word) for word in within)


def include_faults(file, quote, path, rooms, libraries):
    room = room_of(file)
    if quote == "<":
        users = libraries.get(path.split("/")[0])
        if users is not None and room not in users and room != "tests":
            yield f"{file}: <{path}> is for {' and '.join(users)} only"
    elif room == "examples" and "/" not in path:
        pass  # a project of its own, which is copied elsewhere: what lies beside the file
    elif room_of(path) not in rooms:
        yield f'{file}: "{path}" is of no room: includes are written from the root'
    elif room_of(path) != room and not allowed(path, rooms[room]):
        yield f'{file}: "{path}": {room}/ may not include {room_of(path)}/'


def circle(edges):
    """Some circle of a graph {node: {nodes}}, as a list whose first and last are the same; None if there is none."""
    done = set()
    for start in sorted(edges):
        way, left = [start], [sorted(edges[start])]
        while way and start not in done:
            if not left[-1]:
                done.add(way.pop())
                left.pop()
                continue
            node = left[-1].pop(0)
            if node in way:
                return way[way.index(node):] + [node]
            if node not in done:
                way.append(node)
                left.append(sorted(edges.get(node, ())))
    return None


def faults(root):
    text = read(os.path.join(root, "docs", "architecture.md"))
    rooms, libraries = block(text, "rooms"), block(text, "libraries")
    found, files, between = [], {}, {room: set() for room in rooms}
    for file in sources(root):
        room = room_of(file)
        if room not in rooms:
            found.append(f"{file}: docs/architecture.md knows no room {room}/")
            continue
        files[file] = set()
        for quote, path in INCLUDE.findall(read(os.path.join(root, file))):
            found += include_faults(file, quote, path, rooms, libraries)
            if quote == '"':
                files[file].add(path)
                between[room] |= {room_of(path)} & set(rooms) - {room}
    for what, edges in (("files", files), ("rooms", between)):
        round_trip = circle(edges)
        if round_trip:
            found.append(f"{what} include each other: {' > '.join(round_trip)}")
    return found


def main():
    found = faults(sys.argv[1])
    print("\n".join(found) if found else "includes are as docs/architecture.md has them")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
