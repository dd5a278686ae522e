#!/usr/bin/env python3
"""The rooms of the house and the arrows between them: check_includes.py [--picture]

Reads every #include, and fails where a room includes one that rooms.txt does not let it. --picture lists all arrows as
they are, for a reader.
"""
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOPS = ["include", "python", "shared_glsl_cpp", "common", "cpu_ref", "vk_backend", "shaders", "stability", "app"]
SOURCES = {".h", ".cpp", ".glsl", ".comp", ".rgen", ".rchit", ".rahit", ".rmiss", ".vert", ".frag"}
INCLUDE = re.compile(r'^\s*#\s*include\s+(?:"([^"]+)"|<(CLI)/)', re.MULTILINE)


def room_of(file):
    """`file` is relative to the root: "app/commands/verify/suite.cpp" is in app/commands, and a file of app itself in app."""
    return "/".join(file.parts[:-1][:2])


def sources():
    for top in TOPS:
        for path in sorted((ROOT / top).rglob("*")):
            if path.suffix in SOURCES:
                yield path.relative_to(ROOT)


def resolve(file, name):
    """The file of the project that is meant; none for others' and generated ones."""
    for folder in [file.parent, *map(pathlib.Path, TOPS)]:
        path = ROOT / folder / name
        if path.is_file():
            return path.resolve().relative_to(ROOT)
    return None


def arrows():
    """(from, to) -> files that draw it."""
    found = collections.defaultdict(set)
    for file in sources():
        for name, cli in INCLUDE.findall((ROOT / file).read_text()):
            path = None if cli else resolve(file, name)
            if path and path.name == "leaves.h" and file.name.endswith(".kernel.h"):
                continue  # kernels are included after it, and it before any of them
            target = "CLI11" if cli else path and room_of(path)
            if target and target != room_of(file):
                found[room_of(file), target].add(str(file))
    return found


def allowed():
    """room -> rooms that it may include; a room's own line adds what it names and what these may include themselves."""
    rules, order = {}, []
    for line in (pathlib.Path(__file__).parent / "rooms.txt").read_text().splitlines():
        line = line.split("#")[0].strip()
        if line:
            room, _, names = line.partition(":")
            direct = names.split()
            for name in direct:
                if name not in rules:
                    sys.exit(f"rooms.txt: {room} names {name}, which stands above it or nowhere")
            inherited = set().union(*(rules[name] for name in direct)) - {"CLI11"}
            rules[room] = inherited | set(direct)
            order.append(room)
    return rules, order


def main():
    found = arrows()
    if sys.argv[1:] == ["--picture"]:
        for room in sorted({a for a, _ in found}):
            print(f"{room}: {' '.join(sorted(b for a, b in found if a == room))}")
        return
    rules, order = allowed()
    wrong = [f"{a} may not include {b}: {', '.join(sorted(files))}" for (a, b), files in sorted(found.items())
             if b not in rules.get(a, ())]
    rooms = {room_of(file) for file in sources()}
    wrong += [f"{room} has no line in rooms.txt" for room in sorted(rooms - set(order))]
    wrong += [f"rooms.txt: there is no room {room}" for room in order if room not in rooms and room != "CLI11"]
    print("\n".join(wrong) or f"{len(order)} rooms, {len(found)} arrows, none upward")
    sys.exit(1 if wrong else 0)


main()
