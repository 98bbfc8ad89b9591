"""Runs in Blender: installs the add-on from its file, fits a body and bakes a garment. Prints JSON."""
import importlib.util
import json
import sys

import bpy

addon, body_file, skirt_file = sys.argv[sys.argv.index("--") + 1:]
spec = importlib.util.spec_from_file_location("bodice_addon", addon)
module = importlib.util.module_from_spec(spec)
sys.modules["bodice_addon"] = module
spec.loader.exec_module(module)
module.register()


def mesh_of(name, file):
    points, faces = [], []
    for line in open(file):
        fields = line.split()
        if fields[:1] == ["v"]: points.append([float(v) for v in fields[1:4]])
        if fields[:1] == ["f"]: faces.append([int(v.split("/")[0]) - 1 for v in fields[1:4]])
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(x, -z, y) for x, y, z in points], [], faces)
    item = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(item)
    return item


bpy.ops.wm.read_factory_settings(use_empty=True)
module.unregister()
module.register()
body, skirt = mesh_of("Body", body_file), mesh_of("Skirt", skirt_file)
bpy.context.view_layer.objects.active = body
found = {"refused": None}
try: bpy.ops.bodice.bake()
except RuntimeError as error: found["refused"] = str(error)
bpy.context.scene.bodice_tier = "solid"
found["fit"] = list(bpy.ops.bodice.fit())
shapes = bpy.data.collections["Body ellipsoids"].objects
bpy.context.view_layer.update()
found["ellipsoids"] = [[list(row) for row in shape.matrix_world] for shape in shapes]
found["skin"] = [list(v.co) for v in body.data.vertices]
for item in bpy.context.selected_objects: item.select_set(False)
skirt.select_set(True)
body.select_set(True)
bpy.context.view_layer.objects.active = body
bpy.context.scene.bodice_frames = 6
found["before"] = [list(v.co) for v in skirt.data.vertices]
found["bake"] = list(bpy.ops.bodice.bake())
frames = []
for frame in (0, 5):
    bpy.context.scene.frame_set(frame)
    seen = skirt.evaluated_get(bpy.context.evaluated_depsgraph_get())
    frames.append([list(v.co) for v in seen.data.vertices])
found["frames"] = frames
print("FOUND " + json.dumps(found))
