"""Reads each exported file with Python's own parsers, puts the shapes back on the body by the conventions of the
engine, and measures the skin's distances from them: they are those that the program reported."""
import json
import math
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as xml

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support", "python"))
from program_check import check, failures, run

SCRATCH = sys.argv[2]
KEEP = "--keep" in sys.argv


# Vectors of three and matrices, without numpy; written out, since they take most of the time.
def add(a, b): return [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
def sub(a, b): return [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
def scale(k, a): return [k * a[0], k * a[1], k * a[2]]
def dot(a, b): return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
def norm(a): return math.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])
def apply(rows, v): return [dot(row, v) for row in rows]
def transpose(rows): return [list(column) for column in zip(*rows)]
def product(a, b): return [[dot(row, column) for column in zip(*b)] for row in a]


def rows_of_quaternion(w, x, y, z):
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


def rows_of_angles(roll, pitch, yaw):
    c, s = math.cos, math.sin
    about_x = [[1, 0, 0], [0, c(roll), -s(roll)], [0, s(roll), c(roll)]]
    about_y = [[c(pitch), 0, s(pitch)], [0, 1, 0], [-s(pitch), 0, c(pitch)]]
    about_z = [[c(yaw), -s(yaw), 0], [s(yaw), c(yaw), 0], [0, 0, 1]]
    return product(about_z, product(about_y, about_x))


IDENTITY = ([[1, 0, 0], [0, 1, 0], [0, 0, 1]], [0, 0, 0])


def to_world(frame, v): return add(apply(frame[0], v), frame[1])


# Signed distances by search, not by the program's formulas.
def hull_distance(p, shape):
    """The hull of two balls: the least over a convex function, by golden section."""
    a, b, ra, rb = shape
    value = lambda t: norm(sub(p, add(a, scale(t, sub(b, a))))) - (ra + t * (rb - ra))
    low, high, g = 0.0, 1.0, 0.6180339887498949
    left, right = high - g * (high - low), low + g * (high - low)
    at_left, at_right = value(left), value(right)
    for _ in range(40):  # one of the two inner points stays
        if at_left < at_right:
            high, right, at_right = right, left, at_left
            left = high - g * (high - low)
            at_left = value(left)
        else:
            low, left, at_left = left, right, at_right
            right = low + g * (high - low)
            at_right = value(right)
    return min(value(0.0), value(1.0), value(0.5 * (low + high)))


def ellipsoid_distance(p, ellipsoid):
    center, rows, radii = ellipsoid
    y = [abs(v) + 1e-15 for v in apply(transpose(rows), sub(p, center))]
    low = max(r * v - r * r for r, v in zip(radii, y))
    high = norm([r * v for r, v in zip(radii, y)])
    for _ in range(70):  # the closest point is r^2 y / (t + r^2), on the ellipsoid
        t = 0.5 * (low + high)
        if norm([r * v / (t + r * r) for r, v in zip(radii, y)]) > 1: low = t
        else: high = t
    close = [r * r * v / (high + r * r) for r, v in zip(radii, y)]
    inside = sum((v / r) ** 2 for r, v in zip(radii, y)) < 1
    return norm(sub(close, y)) * (-1 if inside else 1)


def union_distance(p, solids, distance, center, reach):
    best = math.inf
    for solid in sorted(solids, key=lambda s: norm(sub(p, center(s))) - reach(s)):
        if norm(sub(p, center(solid))) - reach(solid) > best: break
        best = min(best, distance(p, solid))
    return best


def errors(points, solids):
    if len(solids[0]) == 4 and solids[0][3] is None:
        value = lambda p: pieces_distance(p, solids)
    elif len(solids[0]) == 3:
        value = lambda p: union_distance(p, solids, ellipsoid_distance, lambda s: s[0], lambda s: max(s[2]))
    else:
        value = lambda p: union_distance(p, solids, hull_distance, lambda s: s[0],
                                         lambda s: norm(sub(s[1], s[0])) + max(s[2], s[3]))
    gaps = sorted((abs(value(p)), area) for p, area in points if area > 0)
    total, below = sum(area for _, area in gaps), 0.0
    for gap, area in gaps:
        below += area
        if below >= 0.95 * total: break
    return {"mean": 1e3 * sum(g * a for g, a in gaps) / total, "p95": 1e3 * gap, "worst": 1e3 * gaps[-1][0]}


def skin_of(file):
    points, area = [], []
    for line in open(file):
        fields = line.split()
        if fields[:1] == ["v"]:
            points.append([float(v) for v in fields[1:4]])
            area.append(0.0)
        if fields[:1] == ["f"]:
            corners = [int(f.split("/")[0]) - 1 for f in fields[1:4]]
            a, b, c = (points[k] for k in corners)
            u, v = sub(b, a), sub(c, a)
            cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
            for k in corners: area[k] += norm(cross) / 6
    return list(zip(points, area))


# One reader a format. Each returns solids in meters, y up, right-handed.
def read_unity(file, joints):
    data = json.load(open(file))
    rest = {bone["name"]: bone["rest"] for bone in data["bones"]}
    solids = []
    for shape in data["shapes"]:
        m = rest.get(shape["bone"], [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0])
        frame = ([m[0:3], m[4:7], m[8:11]], [m[3], m[7], m[11]])
        ends = []
        for end in "ab":
            x, y, z = to_world(frame, [shape[end][axis] for axis in "xyz"])
            ends.append([-x, y, z])
        solids.append((*ends, shape["radiusA"], shape["radiusB"]))
    return solids


def read_unreal(file, joints):
    solids = []
    for setup in json.load(open(file))["SkeletalBodySetups"]:
        frame = joints.get(setup["BoneName"])
        def back(v):
            if frame is None: return scale(0.01, [v[0], v[2], v[1]])
            return to_world(frame, scale(0.01, [v[0], -v[1], v[2]]))
        vector = lambda v: [v[axis] for axis in "XYZ"]
        geometry = setup["AggGeom"]
        for s in geometry["SphereElems"]:
            solids.append((back(vector(s["Center"])),) * 2 + (s["Radius"] / 100,) * 2)
        for s in geometry["SphylElems"] + geometry["TaperedCapsuleElems"]:
            q = s["Rotation"]
            half = scale(0.5 * s["Length"], apply(rows_of_quaternion(q["W"], q["X"], q["Y"], q["Z"]), [0, 0, 1]))
            solids.append((back(add(vector(s["Center"]), half)), back(sub(vector(s["Center"]), half)),
                           s.get("Radius", s.get("Radius0")) / 100, s.get("Radius", s.get("Radius1")) / 100))
    return solids


def read_godot(file, joints):
    text = open(file).read()
    sections = re.findall(r"^\[(.*?)\]\n((?:[a-z_]+ = .*\n)*)", text, re.M)
    resources, frames, solids = {}, {".": IDENTITY}, []
    for head, body in sections:
        tags = dict(re.findall(r'(\w+)="([^"]*)"', head))
        values = dict(re.findall(r"^([a-z_]+) = (.*)$", body, re.M))
        if "type" in tags: check(set(values) <= set(GODOT[tags["type"]]), f"{file}: properties {list(values)} of {tags['type']}")
        if head.startswith("sub_resource"):
            resources[tags["id"]] = (float(values["radius"]), float(values.get("height", 0)))
        elif head.startswith("node") and "parent" in tags:
            frame = frames[tags["parent"]]
            if "transform" in values:
                n = [float(v) for v in values["transform"][len("Transform3D("):-1].split(",")]
                own = ([n[0:3], n[3:6], n[6:9]], n[9:12])
                frame = (product(frame[0], own[0]), to_world(frame, own[1]))
            path = tags["name"] if tags["parent"] == "." else tags["parent"] + "/" + tags["name"]
            frames[path] = frame
            if "shape" in values:
                radius, height = resources[re.search(r'"(.*)"', values["shape"])[1]]
                half = [0, max(0.0, 0.5 * height - radius), 0]
                solids.append((to_world(frame, half), to_world(frame, scale(-1, half)), radius, radius))
    return solids


def read_vrm(file, joints):
    data = json.load(open(file))
    check(data["extensionsUsed"] == ["VRMC_springBone"], "the extension of VRM is declared")
    solids = []
    for collider in data["extensions"]["VRMC_springBone"]["colliders"]:
        m = data["nodes"][collider["node"]]["matrix"]
        frame = ([m[0::4][:3], m[1::4][:3], m[2::4][:3]], m[12:15])
        (shape,) = collider["shape"].values()
        solids.append((to_world(frame, shape["offset"]), to_world(frame, shape.get("tail", shape["offset"])),
                       shape["radius"], shape["radius"]))
    return solids


def lie_down(frame):
    back = [[1, 0, 0], [0, 0, 1], [0, -1, 0]]  # z up to y up
    return product(back, frame[0]), apply(back, frame[1])


def read_mujoco(file, joints):
    numbers = lambda element, name: [float(v) for v in element.get(name).split()]
    solids = []
    for body in xml.parse(file).getroot().iter("body"):
        outer = (rows_of_quaternion(*numbers(body, "quat")), numbers(body, "pos"))
        for geom in body.iter("geom"):
            check(geom.get("type") == "ellipsoid", "MuJoCo takes ellipsoids")
            turn = product(outer[0], rows_of_quaternion(*numbers(geom, "quat")))
            rows, at = lie_down((turn, to_world(outer, numbers(geom, "pos"))))
            solids.append((at, rows, numbers(geom, "size")))
    return solids


def read_sdformat(file, joints):
    numbers = lambda element, path: [float(v) for v in element.find(path).text.split()]
    solids = []
    for link in xml.parse(file).getroot().iter("link"):
        pose = numbers(link, "pose")
        outer = (rows_of_angles(*pose[3:]), pose[:3])
        for collision in link.iter("collision"):
            pose = numbers(collision, "pose")
            rows, at = lie_down((product(outer[0], rows_of_angles(*pose[3:])), to_world(outer, pose[:3])))
            solids.append((at, rows, numbers(collision, "geometry/ellipsoid/radii")))
    return solids


# The same by the parsers of MuJoCo and SDFormat, in programs that print what these see.
def read_by(reader):
    def read(file, joints):
        done = subprocess.run([reader, file], capture_output=True, text=True, timeout=60)
        check(done.returncode == 0, f"{os.path.basename(reader)} refuses {file}: {done.stderr}")
        solids = []
        for line in done.stdout.splitlines():
            name, *v = line.split()
            v = [float(n) for n in v]
            check(name in joints if joints else name == "body", f"{file}: a body {name}")
            rows, at = lie_down(([v[3:6], v[6:9], v[9:12]], v[0:3]))
            solids.append((at, rows, v[12:15]))
        return solids
    return read


def modules_of(package):
    """The folder of Node's modules that has a package: BODICE_NODE_MODULES, or node_modules in the repository's build."""
    root = os.environ.get("BODICE_ROOT", ".")
    for folder in [os.environ.get("BODICE_NODE_MODULES", ""), *(os.path.join(root, *p, "node_modules") for p in [(), ("build",), ("..",)])]:
        if folder and os.path.isdir(os.path.join(folder, package)): return os.path.abspath(folder)
    return None


def read_by_three_vrm(node, modules):
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "readers", "by_three_vrm.mjs")
    def read(file, joints):
        done = subprocess.run([node, script, modules, file], capture_output=True, text=True, timeout=60)
        check(done.returncode == 0, f"three-vrm refuses {file}: {done.stderr}")
        found = [json.loads(line) for line in done.stdout.splitlines()]
        return [(c["a"], c["b"], c["radius"], c["radius"]) for c in found]
    return read


def read_by_unity_script(program):
    """The importer for Unity itself, on a stand-in of Unity's classes: no Unity runs here."""
    def read(file, joints):
        done = subprocess.run(["mono", program, file], capture_output=True, text=True, timeout=60)
        check(done.returncode == 0, f"the importer for Unity refuses {file}: {done.stderr}")
        found = [[float(v) for v in line.split()] for line in done.stdout.splitlines()]
        return [([-v[0], v[1], v[2]], [-v[3], v[4], v[5]], v[6], v[7]) for v in found]
    return read


def compiled_unity_script():
    here = os.path.dirname(os.path.abspath(__file__))
    program = os.path.abspath(os.path.join(SCRATCH, "..", "unity_stand_in.exe"))
    os.makedirs(os.path.dirname(program), exist_ok=True)
    done = subprocess.run(["mcs", "-out:" + program, os.path.join(here, "UnityStandIn.cs"),
                           os.path.join(here, "..", "..", "modules", "colliders", "unity", "BodiceColliders.cs")],
                          capture_output=True, text=True, timeout=120)
    check(done.returncode == 0, f"BodiceColliders.cs does not compile: {done.stdout}{done.stderr}")
    return program


# Convex pieces: planes, and triangles for points outside of them.
def cross(u, v): return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def piece_of(points, faces):
    edges = set()
    for f in faces:
        for k in range(3):
            edge = (f[k], f[(k + 1) % 3])
            check(edge not in edges, f"edge {edge} has two triangles on one side")
            edges.add(edge)
    check(all((b, a) in edges for a, b in edges), "an edge has one triangle")
    planes = []
    for f in faces:
        n = cross(sub(points[f[1]], points[f[0]]), sub(points[f[2]], points[f[0]]))
        if norm(n) > 0: planes.append((scale(1 / norm(n), n), dot(n, points[f[0]]) / norm(n)))
    above = max(dot(n, p) - h for n, h in planes for p in points)
    check(above < 2e-5, f"a piece is not convex by {above} m")
    return points, faces, planes, None


def triangle_distance(p, a, b, c):
    """By the projection if it is inside, else by the edges."""
    n = cross(sub(b, a), sub(c, a))
    inside = all(dot(cross(sub(v, u), sub(p, u)), n) >= 0 for u, v in ((a, b), (b, c), (c, a)))
    if inside and norm(n) > 0: return abs(dot(n, sub(p, a))) / norm(n)
    best = math.inf
    for u, v in ((a, b), (b, c), (c, a)):
        d = sub(v, u)
        t = max(0.0, min(1.0, dot(d, sub(p, u)) / (dot(d, d) or 1.0)))
        best = min(best, norm(sub(p, add(u, scale(t, d)))))
    return best


def pieces_distance(p, pieces):
    bounds = sorted(((max(dot(n, p) - h for n, h in planes), i) for i, (_, _, planes, _) in enumerate(pieces)))
    best = math.inf
    for bound, i in bounds:
        if bound >= best: break
        if bound <= 0: return bound
        points, faces = pieces[i][:2]
        best = min(best, min(triangle_distance(p, *(points[k] for k in f)) for f in faces))
    return best


def read_convex_gltf(file, joints):
    import base64
    import struct
    data = json.load(open(file))
    buffer = base64.b64decode(data["buffers"][0]["uri"].split(",", 1)[1], validate=True)
    check(len(buffer) == data["buffers"][0]["byteLength"], "length of the buffer")
    def numbers(index, code, width):
        accessor = data["accessors"][index]
        at = data["bufferViews"][accessor["bufferView"]]["byteOffset"]
        flat = struct.unpack_from(f"<{accessor['count'] * width}{code}", buffer, at)
        return [list(flat[i:i + width]) for i in range(0, len(flat), width)]
    above = {child: node for node in data["nodes"] for child in node.get("children", [])}
    pieces = []
    for i, node in enumerate(data["nodes"]):
        if "mesh" not in node: continue
        check(bool(joints) == (i in above), "pieces of a rig hang on joints")
        check(not joints or above[i]["name"] == node["extras"]["bone"], "the joint's name")
        m = above[i]["matrix"] if i in above else [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
        frame = ([m[0::4][:3], m[1::4][:3], m[2::4][:3]], m[12:15])
        primitive = data["meshes"][node["mesh"]]["primitives"][0]
        points = [to_world(frame, p) for p in numbers(primitive["attributes"]["POSITION"], "f", 3)]
        corners = [k for (k,) in numbers(primitive["indices"], "H", 1)]
        pieces.append(piece_of(points, [tuple(corners[k:k + 3]) for k in range(0, len(corners), 3)]))
    return pieces


def read_convex_obj(file, joints):
    points, pieces, faces = [], [], []
    for line in open(file):
        fields = line.split()
        if fields[0] == "v": points.append([float(v) for v in fields[1:]])
        if fields[0] == "o" and faces: pieces.append(faces); faces = []
        if fields[0] == "f": faces.append(tuple(int(v) - 1 for v in fields[1:]))
    out = []
    for own in pieces + [faces]:
        first = min(min(f) for f in own)
        last = max(max(f) for f in own)
        out.append(piece_of(points[first:last + 1], [tuple(k - first for k in f) for f in own]))
    return out


FORMATS = [("convex", ".gltf", read_convex_gltf, [None]), ("convex", ".obj", read_convex_obj, [None]),
           ("unity", ".json", read_unity, ["capsules", "tapered", "spheres"]),
           ("unreal", ".json", read_unreal, ["capsules", "tapered", "spheres"]),
           ("godot", ".tscn", read_godot, ["capsules", "spheres"]),
           ("vrm", ".gltf", read_vrm, ["capsules", "spheres"]),
           ("mujoco", ".xml", read_mujoco, [None]),
           ("sdformat", ".sdf", read_sdformat, [None])]
READERS = os.path.abspath(sys.argv[3]) if len(sys.argv) > 3 else ""
for name, extension in [("mujoco", ".xml"), ("sdformat", ".sdf")]:
    reader = os.path.join(READERS, "read_by_" + name)
    if os.path.exists(reader): FORMATS.append((name, extension, read_by(reader), [None]))
    else: print(f"{name}'s own parser is not here, so that the file is read by Python's alone")

node, modules = os.environ.get("BODICE_NODE", ""), modules_of("@pixiv/three-vrm-springbone")
if os.path.exists(node) and modules: FORMATS.append(("vrm", ".gltf", read_by_three_vrm(node, modules), ["capsules", "spheres"]))
else: print("three-vrm is not here (npm: three, @pixiv/three-vrm-springbone), so that VRM is read by Python alone")

if shutil.which("mcs") and shutil.which("mono"):
    FORMATS.append(("unity", ".json", read_by_unity_script(compiled_unity_script()), ["capsules", "tapered", "spheres"]))
else: print("mono is not here (Debian: mono-mcs), so that the importer for Unity is not compiled")

# What Godot's pages of its classes list, of what the files use.
GODOT = {"Node3D": [], "AnimatableBody3D": ["sync_to_physics"], "CollisionShape3D": ["transform", "shape"],
         "BoneAttachment3D": ["transform", "bone_name", "use_external_skeleton", "external_skeleton"],
         "CapsuleShape3D": ["radius", "height"], "SphereShape3D": ["radius"]}


def obeys_schema(name, file):
    """By the schemas beside this file, where Python has a validator (Debian: python3-jsonschema)."""
    schema = os.path.join(os.path.dirname(os.path.abspath(__file__)), "schemas", name + ".schema.json")
    if not os.path.exists(schema): return
    try: import jsonschema
    except ImportError: return
    for error in jsonschema.Draft202012Validator(json.load(open(schema))).iter_errors(json.load(open(file))):
        check(False, f"{file} breaks {name}.schema.json at {list(error.absolute_path)}: {error.message[:200]}")


def read_back(proxy, body, points, joints):
    for name, extension, reader, kinds in FORMATS:
        if name == "vrm" and not joints: continue
        for kind in kinds:
            file = f"{name}_{kind}{extension}"
            run("export", proxy, "--to", name, "-o", file, "--body", body, "--report", "cost.json", "-q",
                *(["--shapes", kind, "--count", "24"] if kind else ["--count", "24"] if name == "convex" else []))
            obeys_schema(name, file)
            solids = reader(file, joints)
            check(kind is None and name != "convex" or 12 <= len(solids) <= 24, f"{file}: {len(solids)} shapes of 24")
            stated, found = json.load(open("cost.json"))["error_mm"], errors(points, solids)
            for what in stated:
                check(abs(stated[what] - found[what]) < 1e-3,
                      f"{file}: {what} is {found[what]:.5f} mm when read back, {stated[what]:.5f} as reported")
            print(f"{file}: {len(solids)} solids, mean {found['mean']:.2f} mm, worst {found['worst']:.2f} mm")


def refusals():
    printed = run("export", "free.json", "--to", "vrm", "-o", "none.gltf", code=2)
    check("bound to none" in printed and printed.count("\n") == 1, f"a proxy without a rig, in one sentence: {printed}")
    printed = run("export", "free.json", "--to", "quake", "-o", "none.json", code=2)
    check("unity" in printed and printed.count("\n") == 1, f"a format that does not exist: {printed}")
    printed = run("export", "free.json", "--to", "unity", "-o", "no/such/folder.json", code=1)
    check("folder" in printed and printed.count("\n") == 1, f"a folder that does not exist: {printed}")
    for output, report in [("/proc/none.json", "none_report.json"), ("none.json", "/proc/none.json")]:  # where no file can be
        printed = run("export", "free.json", "--to", "unity", "-o", output, "--report", report, code=1)
        check("could not be written" in printed and printed.count("\n") == 1, f"a folder that cannot be written: {printed}")
    printed = run("export", "free.json", "--to", "unity", "-o", "none.tscn", code=2)
    check("extension" in printed, f"an extension that is not the format's: {printed}")
    printed = run("export", "free.json", "--to", "mujoco", "--shapes", "capsules", "-o", "none.xml", code=2)
    check("takes ellipsoids" in printed, f"shapes where ellipsoids are written: {printed}")
    printed = run("export", "free.json", "--to", "convex", "--shapes", "capsules", "-o", "none.obj", code=2)
    check("takes convex pieces" in printed, f"shapes where pieces are written: {printed}")
    printed = run("export", "free.json", "--to", "godot", "--shapes", "tapered", "-o", "none.tscn", code=2)
    check("tapered" in printed, f"tapered capsules for Godot: {printed}")
    for file in os.listdir("."): check(not file.startswith("none"), f"{file} was left behind")


def main():
    shutil.rmtree(SCRATCH, ignore_errors=True)
    os.makedirs(SCRATCH)
    os.chdir(SCRATCH)
    run("make", "--vertices", "2000", "-o", "body.obj", "-q")
    run("rig", "body.obj", "-o", "rigged.glb", "--clip", "none", "-q")
    run("fit", "body.obj", "--tier", "solid", "-o", "free.json", "-q")
    run("fit", "rigged.glb", "--tier", "solid", "-o", "bound.json", "-q")
    points = skin_of("body.obj")
    read_back("free.json", "body.obj", points, {})
    # Unreal's file has no rest pose: joints are those of VRM's nodes, by name.
    run("export", "bound.json", "--to", "vrm", "-o", "joints.gltf", "--body", "body.obj", "-q")
    joints = {}
    for node in json.load(open("joints.gltf"))["nodes"]:
        m = node["matrix"]
        joints[node["name"]] = ([m[0::4][:3], m[1::4][:3], m[2::4][:3]], m[12:15])
    read_back("bound.json", "body.obj", points, joints)
    refusals()
    print("read back:", "failed" if failures else "passed")
    return 1 if failures else 0


sys.exit(main())
