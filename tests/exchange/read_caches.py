"""Point caches of drapes, read by the words of their formats: the frames are those of the GLB."""
import os
import shutil
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support", "python"))
from glb import Glb, most_apart
from program_check import check, failures, run

SCRATCH = sys.argv[2]


def grouped(flat, frames, points):
    rows = [list(flat[i:i + 3]) for i in range(0, len(flat), 3)]
    return [rows[f * points:(f + 1) * points] for f in range(frames)]


def read_pc2(file):
    data = open(file, "rb").read()
    signature, version, points, start, rate, frames = struct.unpack_from("<12siiffi", data)
    check(signature == b"POINTCACHE2\0" and version == 1 and start == 0 and rate == 1, f"{file}: head")
    check(len(data) == 32 + 12 * points * frames, f"{file}: {len(data)} bytes")
    return grouped(struct.unpack_from(f"<{3 * points * frames}f", data, 32), frames, points)


def read_mdd(file):
    data = open(file, "rb").read()
    frames, points = struct.unpack_from(">2i", data)
    check(len(data) == 8 + 4 * frames + 12 * points * frames, f"{file}: {len(data)} bytes")
    times = struct.unpack_from(f">{frames}f", data, 8)
    return times, grouped(struct.unpack_from(f">{3 * points * frames}f", data, 8 + 4 * frames), frames, points)


def main():
    shutil.rmtree(SCRATCH, ignore_errors=True)
    os.makedirs(SCRATCH)
    os.chdir(SCRATCH)
    run("make", "--vertices", "2000", "-o", "body.obj", "--garment-out", "a.obj", "-q")
    run("make", "body.obj", "--garment", "poncho", "--garment-out", "b.obj", "-q")
    for extension in ["pc2", "mdd"]:
        run("drape", "body.obj", "a.obj", "b.obj", "--tier", "solid", "--frames", "12", "--keep", "5", "--substeps", "2",
            "-o", "d.glb", "--cache", "d." + extension, "--no-picture", "-q")
        glb = Glb("d.glb")
        for name, file in [("cloth", "d." + extension), ("cloth_2", "d_2." + extension)]:
            times, frames = read_mdd(file) if extension == "mdd" else (None, read_pc2(file))
            check(len(frames) == len(glb.primitive(name)["targets"]) == 5, f"{file}: {len(frames)} frames")
            for f, points in enumerate(frames):
                check(most_apart(points, glb.points(name, f)) < 1e-6, f"{file}: frame {f} is not that of the GLB")
            if times:
                channel = glb.document["animations"][0]
                keys = [t for (t,) in glb.numbers(channel["samplers"][0]["input"])]
                check(max(abs(t - times[0] - k) for t, k in zip(times, keys)) < 1e-6, f"{file}: times {times}")
    printed = run("drape", "--cache", "d.abc", "-o", "x.glb", code=2)
    check(".pc2" in printed and printed.count("\n") == 1, f"an extension that is no cache's: {printed}")
    printed = run("drape", "--cache", "no/such/d.pc2", "-o", "x.glb", code=1)
    check("folder" in printed and printed.count("\n") == 1, f"a folder that is not there: {printed}")
    check(not os.path.exists("x.glb"), "a file was left behind")
    print("caches:", "failed" if failures else "passed")
    return 1 if failures else 0


sys.exit(main())
