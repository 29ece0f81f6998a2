"""The C++ files of the tree, and what a file includes, however far away."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "layers"))
from includes import INCLUDE, read, sources  # noqa: E402,F401 (sources is for those who import this)


def reaches(root, file, library, known=None):
    """Whether a file includes <LIBRARY/...>, itself or through our headers."""
    known = {} if known is None else known
    if file in known:
        return known[file]
    known[file] = False  # while it is looked at
    path = os.path.join(root, file)
    found = INCLUDE.findall(read(path)) if os.path.exists(path) else []
    known[file] = any(name.startswith(library + "/") if quote == "<" else reaches(root, name, library, known)
                      for quote, name in found)
    return known[file]
