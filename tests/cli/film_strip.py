"""A film strip shows the side on which the motion is seen: a walk from the left, where the feet come apart and together; a
body that stands from the front, where its feet stay as they are."""
import os
import shutil
import struct
import sys
import zlib

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support", "python"))
from program_check import check, failures, run

SCRATCH = sys.argv[2]


def read_png(file):
    """Rows of bytes, three a pixel, of an 8-bit RGB image that is not interlaced."""
    data, at, packed = open(file, "rb").read(), 8, b""
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"IHDR": width, height, depth, color, _, _, interlaced = struct.unpack_from(">IIBBBBB", data, at + 8)
        if kind == b"IDAT": packed += data[at + 8:at + 8 + length]
        at += 12 + length
    check((depth, color, interlaced) == (8, 2, 0), f"{file}: another kind of PNG")
    raw, size, rows = zlib.decompress(packed), 3 * width, []
    above = bytearray(size)
    for y in range(height):
        kind, row = raw[y * (size + 1)], bytearray(raw[y * (size + 1) + 1:(y + 1) * (size + 1)])
        for i in range(size):
            left, up, corner = row[i - 3] if i >= 3 else 0, above[i], above[i - 3] if i >= 3 else 0
            if kind == 1: add = left
            elif kind == 2: add = up
            elif kind == 3: add = (left + up) // 2
            elif kind == 4:
                p = left + up - corner
                add = min((left, up, corner), key=lambda v: abs(p - v))
            else: add = 0
            row[i] = (row[i] + add) & 255
        rows.append(row)
        above = row
    return rows


def spread_of_feet(file):
    """The width of the feet, in pixels, in each of eight views of 240 pixels."""
    rows, widths = read_png(file), []
    check(len(rows[0]) == 3 * 8 * 240, f"{file}: {len(rows[0]) // 3} pixels wide")
    for view in range(8):
        drawn = [x for row in rows[300:345] for x in range(240)
                 if (p := row[3 * (240 * view + x):3 * (240 * view + x) + 3]) and max(p) - min(p) > 14]
        widths.append(max(drawn) - min(drawn) + 1 if drawn else 0)
    check(min(widths) > 10, f"{file}: no feet, {widths}")
    return widths


def main():
    shutil.rmtree(SCRATCH, ignore_errors=True)
    os.makedirs(SCRATCH)
    os.chdir(SCRATCH)
    few = ["--vertices", "3000", "--tier", "solid", "--substeps", "2", "--no-picture", "-o", "a.glb", "-q"]
    run("drape", "--motion", "walk", "--frames", "40", "--film-strip", "walk.png", *few)
    widths = spread_of_feet("walk.png")
    check(max(widths) > 1.5 * min(widths), f"the walk is not seen from the side: feet of {widths} pixels")
    run("drape", "--frames", "20", "--film-strip", "still.png", *few)
    widths = spread_of_feet("still.png")
    check(max(widths) - min(widths) <= 1, f"a body that stands moves its feet: {widths}")
    print("film strips:", "failed" if failures else "passed")
    return 1 if failures else 0


sys.exit(main())
