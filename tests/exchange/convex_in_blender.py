"""Runs in Blender: imports convex pieces, and prints of each how many of its edges are not manifold, and its volume."""
import json
import sys

import bmesh
import bpy
import numpy

# Debian's numpy has no longer a name that Debian's Blender 3.4 uses.
if "bool" not in numpy.__dict__: numpy.bool = bool
gltf, obj = sys.argv[sys.argv.index("--") + 1:]


def pieces():
    found = {}
    for item in bpy.data.objects:
        if item.type != "MESH": continue
        mesh = bmesh.new()
        mesh.from_mesh(item.data)
        mesh.transform(item.matrix_world)
        found[item.name] = {"open_edges": sum(not edge.is_manifold for edge in mesh.edges),
                            "volume": mesh.calc_volume(signed=True)}
    return found


found = {}
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=gltf, merge_vertices=False)
found["gltf"] = pieces()
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.wm.obj_import(filepath=obj)
found["obj"] = pieces()
print("FOUND " + json.dumps(found))
