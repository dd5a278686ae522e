#!/usr/bin/env python3
"""Are these files SVG that every viewer can draw? check_svg.py FILE...

Holds each to the rules of XML, its numbers to be finite, and what it draws to lie within the document. Prints a line for
each fault; exit code 1 where there is one.
"""
import math
import re
import sys
import xml.etree.ElementTree

NAMESPACE = "{http://www.w3.org/2000/svg}"
PLACES = {"x": 0, "x1": 0, "x2": 0, "cx": 0, "y": 1, "y1": 1, "y2": 1, "cy": 1}
NUMBERS = ["width", "height", "r", "opacity", "font-size", "stroke-width"]


def faults(path):
    try:
        root = xml.etree.ElementTree.parse(path).getroot()
    except xml.etree.ElementTree.ParseError as error:
        yield f"is not XML: {error}"
        return
    if root.tag != NAMESPACE + "svg":
        yield f"has the root element {root.tag}"
        return
    size = [float(value) for value in root.get("viewBox").split()[2:]]
    for node in root.iter():
        name = node.tag.removeprefix(NAMESPACE)
        places = [(PLACES[key], node.get(key)) for key in PLACES if node.get(key) is not None]
        # Pairs "x,y" of polylines and paths.
        for pair in re.findall(r"[^\sMLZ]+,[^\sMLZ]+", node.get("points", "") + " " + node.get("d", "")):
            places += enumerate(pair.split(","))
        for axis, text in places:
            if not -0.5 <= float(text) <= size[axis] + 0.5:
                yield f"<{name}> lies outside: {text} of {size[axis]}"
        for key in NUMBERS:
            if node.get(key) is not None and not (math.isfinite(float(node.get(key))) and float(node.get(key)) >= 0):
                yield f"<{name}> has the {key} {node.get(key)}"
        if name == "text" and not (node.text or "").strip():
            yield "<text> without text"


def main():
    found = [f"{path}: {fault}" for path in sys.argv[1:] for fault in faults(path)]
    print("\n".join(found))
    sys.exit(1 if found else 0)


main()
