"""Puts the colliders of a file of `bodice export --to unreal` into the physics asset of a skeletal mesh.

Import the rigged body that the proxy was fitted to (GLB or FBX), turn on the Python Editor Script Plugin, and type into
Unreal's console:

    py "/path/to/bodice_physics_asset.py" "/path/to/colliders.json" "/Game/Body/SK_Body"

Bones may have other axes than in the body's file, because importers differ: shapes are taken at rest, in the mesh's own
coordinates, and brought into each bone by the skeleton's reference pose. Where a bone of the file has no body nothing is
changed, and the bones are listed. For Unreal 5.1 or later.
"""
import json
import sys

import unreal


def vector(v):
    return unreal.Vector(v["X"], v["Y"], v["Z"])


def reference_pose(mesh):
    """The transform of each bone in the mesh's coordinates."""
    pose = unreal.AnimPoseExtensions.get_reference_pose(mesh.get_editor_property("skeleton"))
    return {str(name): unreal.AnimPoseExtensions.get_ref_bone_pose(pose, name, unreal.AnimPoseSpaces.WORLD)
            for name in unreal.AnimPoseExtensions.get_bone_names(pose)}


def element(kind, shape, bone):
    """A shape in the coordinates of its bone. The axis of capsules is z, and radius0 is at its upper end."""
    start, end = (unreal.MathLibrary.inverse_transform_location(bone, vector(shape[key])) for key in ("RestStart", "RestEnd"))
    scale = bone.scale3d.x or 1.0
    out = kind()
    out.set_editor_property("center", (start + end) * 0.5)
    if kind is not unreal.KSphereElem:
        out.set_editor_property("rotation", unreal.MathLibrary.make_rot_from_z(start - end))
        out.set_editor_property("length", (start - end).length())
    if kind is unreal.KTaperedCapsuleElem:
        out.set_editor_property("radius0", shape["RestRadius0"] / scale)
        out.set_editor_property("radius1", shape["RestRadius1"] / scale)
    else:
        out.set_editor_property("radius", shape["RestRadius0"] / scale)
    return out


def geometry(setup, bone):
    lists = setup["AggGeom"]
    out = unreal.KAggregateGeom()
    for name, key, kind in [("sphere_elems", "SphereElems", unreal.KSphereElem),
                            ("sphyl_elems", "SphylElems", unreal.KSphylElem),
                            ("tapered_capsule_elems", "TaperedCapsuleElems", unreal.KTaperedCapsuleElem)]:
        out.set_editor_property(name, [element(kind, shape, bone) for shape in lists[key]])
    return out


def bodies_of(asset):
    """The asset's bodies by the names of their bones. Some versions hide the list from scripts."""
    try:
        bodies = asset.get_editor_property("skeletal_body_setups")
    except Exception:
        bodies = [b for b in unreal.ObjectIterator(unreal.SkeletalBodySetup) if b.get_outer() == asset]
    return {str(body.get_editor_property("bone_name")): body for body in bodies}


def build(file, mesh_path):
    data = json.load(open(file, encoding="utf-8"))
    if data.get("format") != "bodice colliders for Unreal" or data.get("version") != 2:
        raise RuntimeError(f"{file}: not a file of version 2 of bodice's colliders for Unreal. Export it again.")
    mesh = unreal.load_asset(mesh_path)
    if not isinstance(mesh, unreal.SkeletalMesh):
        raise RuntimeError(f"{mesh_path}: not a skeletal mesh. Give the path of its asset, such as /Game/Body/SK_Body.")
    asset = mesh.get_editor_property("physics_asset") or \
        unreal.get_editor_subsystem(unreal.SkeletalMeshEditorSubsystem).create_physics_asset(mesh)
    bones, bodies = reference_pose(mesh), bodies_of(asset)
    wanted = {setup["BoneName"]: setup for setup in data["SkeletalBodySetups"]}
    strange = [name for name in wanted if name not in bones]
    if strange:
        raise RuntimeError(f"{mesh_path} has no bone {', '.join(map(repr, strange))}. Fit and export its own rig.")
    missing = [name for name in wanted if name not in bodies]
    if missing:
        raise RuntimeError(f"{asset.get_name()} has no body for {', '.join(missing)}. Add them in the physics asset's "
                           "skeleton tree (Add Shape), then run this again.")
    made = {name: geometry(setup, bones[name]) for name, setup in wanted.items()}
    with unreal.ScopedEditorTransaction("Colliders of bodice"):
        for name, shapes in made.items():
            bodies[name].modify()
            bodies[name].set_editor_property("agg_geom", shapes)
    unreal.EditorAssetLibrary.save_loaded_asset(asset)
    others = sorted(set(bodies) - set(wanted))
    unreal.log(f"bodice: {len(made)} bodies of {asset.get_name()} have new shapes."
               + (f" Left as they were: {', '.join(others)}." if others else ""))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise RuntimeError("Give the file of the colliders and the path of the skeletal mesh.")
    build(sys.argv[1], sys.argv[2])
