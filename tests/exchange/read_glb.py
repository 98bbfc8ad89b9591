"""GLBs as the program writes them, read by a reader of our own: meters with y up whatever the input was, the ellipsoids
that the proxy has, names of morph targets, and frames that small integers hold."""
import json
import math
import os
import shutil
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support", "python"))
from glb import Glb, apply, most_apart
from program_check import check, failures, run

SCRATCH = sys.argv[2]


def vertices(file):
    return [[float(v) for v in line.split()[1:4]] for line in open(file) if line.startswith("v ")]


def in_centimeters_z_up(source, target):
    with open(target, "w") as out:
        for line in open(source):
            fields = line.split()
            if fields[:1] == ["v"]:
                x, y, z = (100 * float(v) for v in fields[1:4])
                line = f"v {x!r} {-z!r} {y!r}\n"
            out.write(line)


def every_file_is_in_meters_with_y_up():
    run("make", "--vertices", "2000", "-o", "m.obj", "-q")
    in_centimeters_z_up("m.obj", "cm.obj")
    truth = vertices("m.obj")
    for name in ["m", "cm"]:
        run("fit", name + ".obj", "--tier", "solid", "-o", name + ".json", "--glb", name + ".glb", "-q")
        glb, proxy = Glb(name + ".glb"), json.load(open(name + ".json"))
        apart = most_apart(sorted(glb.points("body")), sorted(truth))
        check(apart < 2e-5, f"{name}: the body is {apart} m off its position in meters, y up")
        up = proxy["up"]
        turn = {"y": lambda v: v, "z": lambda v: [v[0], v[2], -v[1]]}[up]
        top = glb.nodes[glb.find("ellipsoids")]
        check(top["extras"]["hash"] == proxy["hash"] and top["extras"]["tier"] == "solid", "the proxy's hash")
        check(len(top["children"]) == len(proxy["ellipsoids"]), "not a node an ellipsoid")
        for k, (node, e) in enumerate(zip(top["children"], proxy["ellipsoids"])):
            extras = glb.nodes[node]["extras"]
            check(extras["index"] == k and extras["part"] == e["part"] and extras["hash"] == proxy["hash"],
                  f"{name}: extras of ellipsoid {k}")
            map_, unit = glb.world(node), proxy["metres_per_unit"]
            for axis, radius, column in zip(e["axes"], e["radii"], zip(*map_)):
                tip = turn([c + radius * a for c, a in zip(e["center"], axis)])
                here = min((math.dist([unit * v for v in tip], apply(map_, [s * (i == j) for j in range(3)]))
                            for i in range(3) for s in (-1, 1)))
                check(here < 1e-6, f"{name}: ellipsoid {k} has no end of an axis within {here} m of the proxy's")
        rooted = [glb.nodes[n]["name"] for n in glb.document["scenes"][0]["nodes"]]
        check(rooted == (["body", "ellipsoids"] if name == "m" else ["input"]), f"{name}: roots {rooted}")


def bones_are_named():
    run("rig", "m.obj", "-o", "rigged.glb", "--clip", "none", "-q")
    run("fit", "rigged.glb", "--tier", "solid", "-o", "bound.json", "--glb", "bound.glb", "-q")
    glb, proxy = Glb("bound.glb"), json.load(open("bound.json"))
    for node, e in zip(glb.nodes[glb.find("ellipsoids")]["children"], proxy["ellipsoids"]):
        check(glb.nodes[node]["extras"].get("bone") == proxy["binding"]["joints"][e["bone"]], "the name of a bone")


def mdd_frames(file):
    data = open(file, "rb").read()
    frames, points = struct.unpack_from(">2I", data)
    flat = struct.unpack_from(f">{3 * points * frames}f", data, 8 + 4 * frames)
    return [[list(flat[3 * (f * points + p):3 * (f * points + p) + 3]) for p in range(points)] for f in range(frames)]


def subdivided(source, target):
    """Cuts each triangle in four, so that a garment has more vertices."""
    points, triangles, middle = vertices(source), [], {}
    for line in open(source):
        if line.startswith("f "): triangles.append([int(f.split("/")[0]) - 1 for f in line.split()[1:4]])
    def between(a, b):
        key = (min(a, b), max(a, b))
        if key not in middle:
            middle[key] = len(points)
            points.append([0.5 * (u + v) for u, v in zip(points[a], points[b])])
        return middle[key]
    with open(target, "w") as out:
        faces = []
        for a, b, c in triangles:
            ab, bc, ca = between(a, b), between(b, c), between(c, a)
            faces += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        for p in points: print("v", *p, file=out)
        for face in faces: print("f", *[v + 1 for v in face], file=out)
    return len(points)


def long_drapes_are_small():
    run("make", "--vertices", "2000", "-o", "body.obj", "--garment", "skirt", "--garment-out", "skirt.obj", "-q")
    file, count = "skirt.obj", len(vertices("skirt.obj"))
    while count < 10000: file, count = "fine.obj", subdivided(file, "fine.obj")
    frames = 120 * 10000 // count
    run("drape", "body.obj", file, "--tier", "solid", "--frames", str(frames), "--keep", str(frames), "--substeps", "2",
        "--motion", "walk", "-o", "long.glb", "--cache", "long.mdd", "--no-picture", "-q")
    glb, size = Glb("long.glb"), os.path.getsize("long.glb")
    exact = mdd_frames("long.mdd")
    per_frame = size / (frames * count)
    print(f"{frames} frames of {count} vertices: {size / 1e6:.2f} MB, {per_frame:.2f} bytes a vertex and frame")
    check(size < 10e6 and frames * count > 1.1e6, f"{frames} frames of {count} vertices take {size} bytes")
    check(glb.document["extensionsRequired"] == ["KHR_mesh_quantization"], "the extension is declared")
    scale = glb.nodes[glb.find("cloth")].get("scale", [1])[0]
    names = glb.document["meshes"][glb.nodes[glb.find("cloth")]["mesh"]]["extras"]["targetNames"]
    check(len(names) == len(exact) == frames and len(set(names)) == frames, f"{len(names)} names of targets")
    for f in [0, 1, frames // 2, frames - 1]:
        apart = max(abs(a - b) for p, q in zip(glb.points("cloth", f), exact[f]) for a, b in zip(p, q))
        check(apart < scale / 65534 + 2e-7, f"frame {f} is {apart} m off at a scale of {scale}")
    check(most_apart(exact[0], exact[-1]) > 0.01, "the cloth stands still")


def normals_turn_with_the_cloth():
    """A normal of a frame is that of its triangles, in frames that have normals of their own: every third, the last."""
    glb = Glb("long.glb")
    primitive = glb.primitive("cloth")
    triangles = [i for row in glb.numbers(primitive["indices"]) for i in row]
    base = glb.numbers(primitive["attributes"]["NORMAL"])
    for f in [3, 30, len(primitive["targets"]) - 1]:
        at = glb.points("cloth", f)
        sums = [[0.0] * 3 for _ in at]
        for a, b, c in zip(triangles[0::3], triangles[1::3], triangles[2::3]):
            u, v = ([q - p for p, q in zip(at[a], at[k])] for k in (b, c))
            cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
            for k in (a, b, c): sums[k] = [s + x for s, x in zip(sums[k], cross)]
        moved = glb.numbers(primitive["targets"][f]["NORMAL"])
        off = []
        for total, b, d in zip(sums, base, moved):
            n = [p + q for p, q in zip(b, d)]
            length = math.hypot(*total) * math.hypot(*n)
            if length: off.append(math.degrees(math.acos(max(-1, min(1, sum(p * q for p, q in zip(total, n)) / length)))))
        off.sort()
        check(f == 30 or primitive["targets"][f - 1]["NORMAL"] != primitive["targets"][f]["NORMAL"], "normals shared")
        check(off[len(off) // 2] < 3, f"frame {f}: normals are {off[len(off) // 2]:.1f} degrees off in the middle")


def main():
    shutil.rmtree(SCRATCH, ignore_errors=True)
    os.makedirs(SCRATCH)
    os.chdir(SCRATCH)
    every_file_is_in_meters_with_y_up()
    bones_are_named()
    long_drapes_are_small()
    normals_turn_with_the_cloth()
    print("GLBs:", "failed" if failures else "passed")
    return 1 if failures else 0


sys.exit(main())
