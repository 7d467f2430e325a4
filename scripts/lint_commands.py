#!/usr/bin/python3
"""The compile commands of a build as clang-tidy wants them: one for each source file, without GCC's precompiled headers.

    scripts/lint_commands.py BUILD/compile_commands.json OUT.json

Where CMake compiles several files at a time (PLUMBLINE_UNITY), the file that includes them has their command. Standard library only."""
import json
import re
import sys


def sources_of(path):
    """The files that one compilation is made of."""
    if not re.search(r"/Unity/unity_\d+_cxx\.cxx$", path):
        return [path]
    with open(path, encoding="utf-8") as file:
        return re.findall(r'^#include "(.+)"$', file.read(), re.MULTILINE)


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        entries = json.load(file)
    found = []
    for entry in entries:
        command = re.sub(r" -Winvalid-pch -include \S+", "", entry["command"])
        for source in sources_of(entry["file"]):
            found.append({"directory": entry["directory"], "command": command.replace(entry["file"], source), "file": source})
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        json.dump(found, file, indent=1)


if __name__ == "__main__":
    main()
