#!/usr/bin/env python3
"""Prints the mean of a channel of an EXR that diptych wrote: exr-mean.py FILE [CHANNEL [LEFT TOP RIGHT BOTTOM]].

Needs no package. It reads what diptych writes, which is one part of float channels in ZIP blocks of 16 lines.
"""
import struct
import sys
import zlib


def header(data):
    attributes, at = {}, 8
    while data[at]:
        end = data.index(0, at)
        kind = data.index(0, end + 1)
        size = struct.unpack_from("<i", data, kind + 1)[0]
        attributes[data[at:end].decode()] = data[kind + 5 : kind + 5 + size]
        at = kind + 5 + size
    return attributes, at + 1


def unpacked(block, size):
    if len(block) == size:  # stored as it is, where ZIP does not make it smaller
        return block
    bytes_ = bytearray(zlib.decompress(block))
    for i in range(1, size):  # each byte is the difference to the byte before
        bytes_[i] = (bytes_[i - 1] + bytes_[i] - 128) & 255
    half = (size + 1) // 2
    result = bytearray(size)
    result[0::2], result[1::2] = bytes_[:half], bytes_[half:]
    return result


def channel(path, name):
    data = open(path, "rb").read()
    attributes, at = header(data)
    assert attributes["compression"] == b"\x03", "not ZIP"
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    names, list_ = [], attributes["channels"]
    while list_[0]:
        end = list_.index(0)
        assert list_[end + 1] == 2, "not float"
        names.append(list_[:end].decode())
        list_ = list_[end + 17 :]
    column, rows = names.index(name), []
    for offset in struct.unpack_from(f"<{(height + 15) // 16}Q", data, at):
        first, packed = struct.unpack_from("<2i", data, offset)
        lines = min(16, bottom + 1 - first)
        block = unpacked(data[offset + 8 : offset + 8 + packed], 4 * width * len(names) * lines)
        for line in range(lines):
            rows.append(struct.unpack_from(f"<{width}f", block, 4 * width * (line * len(names) + column)))
    return rows


name = sys.argv[2] if len(sys.argv) > 2 else "G"
pixels = channel(sys.argv[1], name)
left, top, right, bottom = map(int, sys.argv[3:7]) if len(sys.argv) > 6 else (0, 0, len(pixels[0]), len(pixels))
values = [value for row in pixels[top:bottom] for value in row[left:right]]
print(f"{sum(values) / len(values):.4f}")
