"""Runs in Blender: imports a GLB, and plays a point cache on its cloth. Prints what it finds as one line of JSON."""
import json
import sys

import bpy
import numpy

# Debian's numpy has no longer a name that Debian's Blender 3.4 uses.
if "bool" not in numpy.__dict__: numpy.bool = bool
glb, cache = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=glb, merge_vertices=False)
objects = bpy.data.objects
found = {"objects": sorted(o.name for o in objects)}
for name in ["body", "cloth"]:
    mesh = objects[name]
    found[name] = [list(mesh.matrix_world @ v.co) for v in mesh.data.vertices]
cloth = objects["cloth"]
action = cloth.data.shape_keys.animation_data.action
end = action.frame_range[1]
bpy.context.scene.frame_set(int(end), subframe=end - int(end))
found["values_at_end"] = [key.value for key in cloth.data.shape_keys.key_blocks[1:]]
bpy.context.scene.frame_set(0)
found["keys"] = [key.name for key in cloth.data.shape_keys.key_blocks]
last = cloth.data.shape_keys.key_blocks[-1]
found["last_key"] = [list(cloth.matrix_world @ point.co) for point in last.data]
first_child = objects["head_0"]
found["extras"] = {key: first_child[key] for key in ["index", "part", "hash"]}
plain = objects.new("plain", cloth.data.copy())
plain.data.transform(cloth.matrix_world)
bpy.context.scene.collection.objects.link(plain)
plain.shape_key_clear()
modifier = plain.modifiers.new("cache", "MESH_CACHE")
modifier.cache_format = "PC2" if cache.endswith(".pc2") else "MDD"
modifier.filepath = cache
modifier.forward_axis, modifier.up_axis = "POS_Z", "NEG_Y"
modifier.time_mode, modifier.play_mode, modifier.eval_factor = "FACTOR", "CUSTOM", 1.0
bpy.context.view_layer.update()
posed = plain.evaluated_get(bpy.context.evaluated_depsgraph_get())
found["cached"] = [list(v.co) for v in posed.data.vertices]
print("FOUND " + json.dumps(found))
