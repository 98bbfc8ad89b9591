"""bodice in Blender: fits ellipsoids to the active mesh, shows them, and drapes the other selected meshes over it.

Install this file under Edit > Preferences > Add-ons, and name the program there. Panel: View3D > Sidebar > bodice.
Blender 3.4 or later. Nothing but the program is needed; it is called, and its files are read.
"""
import json
import os
import shutil
import subprocess
import tempfile

import bpy
from mathutils import Matrix, Vector

bl_info = {"name": "bodice: body colliders and cloth", "author": "bodice", "version": (1, 0, 0), "blender": (3, 4, 0),
           "location": "View3D > Sidebar > bodice", "description": "Ellipsoids that fit a body, and cloth over it",
           "category": "Physics"}


class Preferences(bpy.types.AddonPreferences):
    bl_idname = __name__
    program: bpy.props.StringProperty(name="Program", subtype="FILE_PATH", default="bodice")

    def draw(self, context):
        self.layout.prop(self, "program")


def program():
    addon = bpy.context.preferences.addons.get(__name__)
    named = os.environ.get("BODICE_PROGRAM") or (addon.preferences.program if addon else "bodice")
    found = shutil.which(bpy.path.abspath(named)) or shutil.which(named)
    if not found: raise RuntimeError(f"There is no program '{named}': name it in the preferences of the add-on.")
    return found


def run(*arguments):
    """Runs the program; its one sentence on failure becomes Blender's."""
    done = subprocess.run([program(), *arguments], capture_output=True, text=True)
    if done.returncode: raise RuntimeError(done.stderr.strip() or f"bodice failed with {done.returncode}.")


def vertices(mesh_object):
    """World positions, modifiers applied: what is seen is what is fitted."""
    seen = mesh_object.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = seen.to_mesh()
    points = [mesh_object.matrix_world @ v.co for v in mesh.vertices]
    faces = [tuple(p.vertices) for p in mesh.polygons]
    seen.to_mesh_clear()
    return points, faces


def write_obj(mesh_object, file):
    points, faces = vertices(mesh_object)
    with open(file, "w") as out:
        for p in points: out.write(f"v {p.x:.9g} {p.y:.9g} {p.z:.9g}\n")
        for face in faces: out.write("f " + " ".join(str(v + 1) for v in face) + "\n")


def color_of(part):
    """A color that a part keeps: any will do, as long as parts differ."""
    turn = sum(ord(c) * (i + 7) for i, c in enumerate(part)) * 0.618034 % 1
    return tuple(0.35 + 0.5 * abs((turn + k / 3) % 1 * 2 - 1) for k in range(3)) + (1.0,)


def show(proxy_file, name):
    """An empty with a sphere an ellipsoid, of one shared mesh; radii are scales."""
    proxy = json.load(open(proxy_file))
    collection = bpy.data.collections.new(name + " ellipsoids")
    bpy.context.scene.collection.children.link(collection)
    bpy.ops.mesh.primitive_uv_sphere_add(segments=24, ring_count=12, radius=1)
    first = bpy.context.object
    sphere = first.data
    sphere.name = "bodice unit sphere"
    for polygon in sphere.polygons: polygon.use_smooth = True
    bpy.data.objects.remove(first)
    for k, e in enumerate(proxy["ellipsoids"]):
        shape = bpy.data.objects.new(f"{e['part']}_{k}", sphere)
        axes = Matrix([Vector(axis) for axis in e["axes"]]).transposed().to_4x4()
        shape.matrix_world = Matrix.Translation(e["center"]) @ axes @ Matrix.Diagonal(Vector((*e["radii"], 1)))
        shape["bodice_part"], shape["bodice_index"], shape["bodice_hash"] = e["part"], k, proxy["hash"]
        shape.color, shape.display_type = color_of(e["part"]), "SOLID"
        collection.objects.link(shape)
    return collection


def folder_of(mesh_object):
    """Beside the saved file, where point caches must stay; else a temporary folder."""
    if bpy.data.filepath:
        folder = os.path.join(os.path.dirname(bpy.data.filepath), "bodice")
        os.makedirs(folder, exist_ok=True)
        return folder
    return tempfile.mkdtemp(prefix="bodice_")


def fit(body, tier):
    folder = folder_of(body)
    mesh, proxy = os.path.join(folder, "body.obj"), os.path.join(folder, bpy.path.clean_name(body.name) + ".json")
    write_obj(body, mesh)
    run("fit", mesh, "--unit", "m", "--up", "z", "--tier", tier, "-o", proxy, "-q")
    return show(proxy, body.name)


def bake(body, garments, frames, fabric):
    """Drapes, and plays the result by a Mesh Cache modifier on each garment, in its own vertices."""
    folder = folder_of(body)
    files = [os.path.join(folder, "body.obj")]
    write_obj(body, files[0])
    for k, garment in enumerate(garments):
        files.append(os.path.join(folder, f"garment_{k + 1}.obj"))
        write_obj(garment, files[-1])
    report, glb = os.path.join(folder, "drape.json"), os.path.join(folder, "drape.glb")
    rate = bpy.context.scene.render.fps / bpy.context.scene.render.fps_base
    run("drape", *files, "--unit", "m", "--up", "z", "--position", "as-is", "--frames", str(frames), "--keep",
        str(max(2, frames)), "--dt", repr(1 / rate), "--fabric", fabric, "-o", glb, "--cache",
        os.path.join(folder, "cloth.pc2"), "--report", report, "--no-picture", "-q")
    for k, garment in enumerate(garments):
        cache = os.path.join(folder, "cloth.pc2" if k == 0 else f"cloth_{k + 1}.pc2")
        play(garment, files[k + 1], cache)
    return json.load(open(report))["drape"]


def play(garment, mesh_file, cache):
    """The cache has the vertices that triangles use, in the order of their first use; the garment has its own order."""
    order = {}
    for line in open(mesh_file):
        if line.startswith("f "):
            for word in line.split()[1:]: order.setdefault(int(word) - 1, len(order))
    import array
    import struct
    data = open(cache, "rb").read()
    head, (points, frames) = data[:32], (struct.unpack_from("<i", data, 16)[0], struct.unpack_from("<i", data, 28)[0])
    own = len(garment.data.vertices)
    if points != len(order) or own < len(order):
        raise RuntimeError(f"The cloth has {points} vertices, {garment.name} uses {len(order)}: merge doubles first.")
    rest, back = [garment.matrix_world @ v.co for v in garment.data.vertices], garment.matrix_world.inverted()
    values = array.array("f")
    values.frombytes(data[32:])
    moved = array.array("f")
    for f in range(frames):
        for v in range(own):
            at = 3 * (f * points + order[v]) if v in order else None
            p = back @ (Vector(values[at:at + 3]) if at is not None else rest[v])
            moved.extend(p)
    with open(cache, "wb") as out:
        out.write(head[:16] + struct.pack("<i", own) + head[20:])
        out.write(moved.tobytes())
    modifier = garment.modifiers.get("bodice") or garment.modifiers.new("bodice", "MESH_CACHE")
    modifier.cache_format, modifier.filepath = "PC2", cache
    modifier.forward_axis, modifier.up_axis = "POS_Y", "POS_Z"


def refused(operator, sentence):
    """Shows why an operator did nothing."""
    operator.report({"ERROR"}, sentence)
    return {"CANCELLED"}


class Fit(bpy.types.Operator):
    bl_idname, bl_label = "bodice.fit", "Fit ellipsoids"
    bl_description = "Fits ellipsoids to the active mesh and shows them"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        body, scene = context.active_object, context.scene
        if body is None or body.type != "MESH":
            return refused(self, "Select the body, a mesh.")
        try: fit(body, scene.bodice_tier)
        except RuntimeError as error:
            return refused(self, str(error))
        return {"FINISHED"}


class Bake(bpy.types.Operator):
    bl_idname, bl_label = "bodice.bake", "Drape and bake"
    bl_description = "Drapes the other selected meshes over the active one, and plays the result as a point cache"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        body, scene = context.active_object, context.scene
        garments = [o for o in context.selected_objects if o.type == "MESH" and o != body]
        if body is None or body.type != "MESH" or not garments:
            return refused(self, "Select garments, then the body last.")
        try: drape = bake(body, garments, scene.bodice_frames, scene.bodice_fabric)
        except RuntimeError as error:
            return refused(self, str(error))
        self.report({"INFO"}, f"Deepest in the skin: {drape['penetration']['max_mm']:.1f} mm")
        return {"FINISHED"}


class Panel(bpy.types.Panel):
    bl_idname, bl_label, bl_space_type, bl_region_type, bl_category = "BODICE_PT_panel", "bodice", "VIEW_3D", "UI", "bodice"

    def draw(self, context):
        self.layout.prop(context.scene, "bodice_tier")
        self.layout.operator(Fit.bl_idname)
        self.layout.prop(context.scene, "bodice_frames")
        self.layout.prop(context.scene, "bodice_fabric")
        self.layout.operator(Bake.bl_idname)


CLASSES = (Preferences, Fit, Bake, Panel)


def choices(names): return [(name, name, "") for name in names]


def register():
    for item in CLASSES: bpy.utils.register_class(item)
    scene = bpy.types.Scene
    scene.bodice_tier = bpy.props.EnumProperty(name="Accuracy", items=choices(["solid", "tight", "relief"]))
    scene.bodice_frames = bpy.props.IntProperty(name="Frames", default=60, min=1, max=10000)
    scene.bodice_fabric = bpy.props.EnumProperty(name="Fabric", items=choices(["cotton", "silk", "denim", "jersey", "leather"]))


def unregister():
    for item in reversed(CLASSES): bpy.utils.unregister_class(item)
    for name in ("bodice_tier", "bodice_frames", "bodice_fabric"): delattr(bpy.types.Scene, name)


if __name__ == "__main__": register()
