"""Runs the import script for Unreal with a stand-in for Unreal's module, which has what the script uses of it: shapes lie
where they lie at rest, for skeletons with axes as importers of FBX and of glTF leave them. No Unreal runs here."""
import importlib.util
import json
import math
import os
import shutil
import sys
import types

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support", "python"))
from program_check import check, failures, run

SCRATCH, SCRIPT = sys.argv[2], os.path.abspath(sys.argv[3])


class Vector:
    def __init__(self, x, y, z): self.x, self.y, self.z = x, y, z
    def __add__(self, o): return Vector(self.x + o.x, self.y + o.y, self.z + o.z)
    def __sub__(self, o): return Vector(self.x - o.x, self.y - o.y, self.z - o.z)
    def __mul__(self, k): return Vector(k * self.x, k * self.y, k * self.z)
    def list(self): return [self.x, self.y, self.z]
    def length(self): return math.sqrt(sum(v * v for v in self.list()))


class Frame:
    """A transform: rows of a rotation, a translation, one scale."""
    def __init__(self, rows, at, scale): self.rows, self.at, self.scale3d = rows, at, Vector(scale, scale, scale)
    def apply(self, p): return [self.scale3d.x * sum(r * v for r, v in zip(row, p)) + t for row, t in zip(self.rows, self.at)]
    def undo(self, p):
        d = [v - t for v, t in zip(p, self.at)]
        return [sum(self.rows[r][c] * d[r] for r in range(3)) / self.scale3d.x for c in range(3)]


class Item:
    def __init__(self, **values): self.values = values
    def get_editor_property(self, name): return self.values[name]
    def set_editor_property(self, name, value):
        check(name in self.KNOWN, f"{type(self).__name__} has no property {name}")
        self.values[name] = value


# Properties by the pages of Unreal's Python API.
def kind(name, *known): return type(name, (Item,), {"KNOWN": known})


KSphereElem = kind("KSphereElem", "center", "radius")
KSphylElem = kind("KSphylElem", "center", "rotation", "radius", "length")
KTaperedCapsuleElem = kind("KTaperedCapsuleElem", "center", "rotation", "radius0", "radius1", "length")
KAggregateGeom = kind("KAggregateGeom", "sphere_elems", "sphyl_elems", "tapered_capsule_elems")
SkeletalBodySetup = kind("SkeletalBodySetup", "agg_geom")
SkeletalBodySetup.modify = lambda self: None
SkeletalMesh = kind("SkeletalMesh")


class Scope:
    def __init__(self, name): pass
    def __enter__(self): pass
    def __exit__(self, *_): pass


def stand_in(bones, bodies):
    """The module, with one mesh that has these bones and bodies."""
    asset = types.SimpleNamespace(get_name=lambda: "PA_Body")
    def hidden(name): raise RuntimeError("the list is hidden")
    asset.get_editor_property = hidden
    for body in bodies.values(): body.get_outer = lambda: asset
    mesh = SkeletalMesh(skeleton=bones, physics_asset=asset)
    return types.SimpleNamespace(
        Vector=Vector, KSphereElem=KSphereElem, KSphylElem=KSphylElem, KTaperedCapsuleElem=KTaperedCapsuleElem,
        KAggregateGeom=KAggregateGeom, SkeletalBodySetup=SkeletalBodySetup, SkeletalMesh=SkeletalMesh,
        AnimPoseSpaces=types.SimpleNamespace(WORLD=1), ScopedEditorTransaction=Scope, log=print,
        AnimPoseExtensions=types.SimpleNamespace(
            get_reference_pose=lambda skeleton: skeleton, get_bone_names=list, get_ref_bone_pose=lambda pose, bone, space: pose[bone]),
        MathLibrary=types.SimpleNamespace(
            inverse_transform_location=lambda frame, v: Vector(*frame.undo(v.list())), make_rot_from_z=lambda z: z),
        EditorAssetLibrary=types.SimpleNamespace(save_loaded_asset=lambda item: check(item is asset, "another asset is saved")),
        ObjectIterator=lambda of: [b for b in bodies.values() if isinstance(b, of)], load_asset=lambda path: mesh)


def script_with(module):
    sys.modules["unreal"] = module
    spec = importlib.util.spec_from_file_location("bodice_physics_asset", SCRIPT)
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    return script


def unreal_point(p): return [100 * p[0], 100 * p[2], 100 * p[1]]


def skeleton(axes):
    """The rig's joints in Unreal. `axes` names where each of Unreal's axes of a joint comes from in its file."""
    bones = {}
    for bone in json.load(open("unity.json"))["bones"]:
        m = bone["rest"]
        scale = math.sqrt(m[0] ** 2 + m[4] ** 2 + m[8] ** 2)
        columns = []
        for column, sign in axes:  # Unity's file has x negated on both sides
            v = [m[4 * r + column] * (-1 if (r == 0) != (column == 0) else 1) / scale for r in range(3)]
            columns.append([sign * c / 100 for c in unreal_point(v)])
        rows = [list(row) for row in zip(*columns)]
        det = sum(rows[0][k] * (rows[1][(k + 1) % 3] * rows[2][(k + 2) % 3] - rows[1][(k + 2) % 3] * rows[2][(k + 1) % 3])
                  for k in range(3))
        check(abs(det - 1) < 1e-6, f"axes of {bone['name']} are no rotation")
        bones[bone["name"]] = Frame(rows, unreal_point([-m[3], m[7], m[11]]), scale)
    return bones


def ends_by_unity():
    """Ends and radii of each shape in the imported mesh, by the file for Unity, which read_back.py checks."""
    data, found = json.load(open("unity.json")), []
    rest = {bone["name"]: bone["rest"] for bone in data["bones"]}
    for shape in data["shapes"]:
        m, ends = rest[shape["bone"]], []
        scale = math.sqrt(m[0] ** 2 + m[4] ** 2 + m[8] ** 2)
        for end, radius in (("a", "radiusA"), ("b", "radiusB")):
            p = [sum(m[4 * r + c] * shape[end]["xyz"[c]] for c in range(3)) + m[4 * r + 3] for r in range(3)]
            ends.append(unreal_point([-p[0], p[1], p[2]]) + [100 * scale * shape[radius]])
        found.append(sorted(ends))
    return sorted(found)


def ends_of(bodies, bones):
    found = []
    for name, body in bodies.items():
        lists = body.get_editor_property("agg_geom").values
        for shape in (s.values for shapes in lists.values() for s in shapes):
            center, scale = shape["center"], bones[name].scale3d.x
            up = shape["rotation"] * (0.5 * shape["length"] / shape["rotation"].length()) if "rotation" in shape else Vector(0, 0, 0)
            radii = shape.get("radius0", shape.get("radius")), shape.get("radius1", shape.get("radius"))
            found.append(sorted(bones[name].apply(end.list()) + [scale * r] for end, r in zip((center + up, center - up), radii)))
    return sorted(found)


def compare(kind_of_shape, axes, what):
    run("export", "bound.json", "--to", "unity", "-o", "unity.json", "--shapes", kind_of_shape, "-q")
    run("export", "bound.json", "--to", "unreal", "-o", "unreal.json", "--shapes", kind_of_shape, "-q")
    bones = skeleton(axes)
    bodies = {name: SkeletalBodySetup(bone_name=name) for name in bones}
    script_with(stand_in(bones, bodies)).build("unreal.json", "/Game/Body")
    expected, found = ends_by_unity(), ends_of(bodies, bones)
    check(len(expected) == len(found) > 20, f"{what}: {len(found)} shapes of {len(expected)}")
    apart = max(abs(a - b) for e, f in zip(expected, found) for p, q in zip(e, f) for a, b in zip(p, q))
    check(apart < 1e-3, f"{what}, {kind_of_shape}: shapes are {apart} cm off")


def refusals():
    bones = skeleton(FBX)
    first = next(iter(bones))
    def refused(file, bones, bodies, words):
        try: script_with(stand_in(bones, bodies)).build(file, "/Game/Body")
        except RuntimeError as error:
            check(words in str(error), f"refused with other words: {error}")
            check(not any("agg_geom" in body.values for body in bodies.values()), "a body was changed")
        else: check(False, f"not refused: {words}")
    bodies = {name: SkeletalBodySetup(bone_name=name) for name in bones if name != first}
    refused("unreal.json", bones, bodies, f"no body for {first}")
    refused("unreal.json", {n: f for n, f in bones.items() if n != first}, dict(bodies), "has no bone")
    refused("unity.json", bones, dict(bodies), "not a file of version 2")


FBX = [(0, 1), (1, -1), (2, 1)]   # x, -y, z of the joint
GLTF = [(0, 1), (2, 1), (1, 1)]   # x, z, y


def main():
    shutil.rmtree(SCRATCH, ignore_errors=True)
    os.makedirs(SCRATCH)
    os.chdir(SCRATCH)
    run("make", "--vertices", "2000", "-o", "body.obj", "-q")
    run("rig", "body.obj", "-o", "rigged.glb", "--clip", "none", "-q")
    run("fit", "rigged.glb", "--tier", "solid", "-o", "bound.json", "-q")
    for shapes in ["capsules", "tapered", "spheres"]:
        compare(shapes, FBX, "FBX")
        compare(shapes, GLTF, "glTF")
    refusals()
    print("Unreal's script:", "failed" if failures else "passed")
    return 1 if failures else 0


sys.exit(main())
