"""Runs in Blender: imports an OBJ with its materials, and exports it as FBX, Collada, GLB and glTF. Prints the files."""
import json
import sys

import bpy
import numpy

# Debian's numpy has no longer a name that Debian's Blender 3.4 uses.
if "bool" not in numpy.__dict__: numpy.bool = bool
source, target = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.wm.obj_import(filepath=source)
bpy.ops.export_scene.fbx(filepath=target + ".fbx", path_mode="COPY", embed_textures=True, axis_forward="-Z", axis_up="Y",
                         apply_unit_scale=True, bake_space_transform=True)
bpy.ops.wm.collada_export(filepath=target + ".dae", apply_global_orientation=True, export_global_up_selection="Y",
                          export_global_forward_selection="-Z")
bpy.ops.export_scene.gltf(filepath=target + ".glb")
bpy.ops.export_scene.gltf(filepath=target + ".gltf", export_format="GLTF_SEPARATE")
print("FOUND " + json.dumps([target + extension for extension in [".fbx", ".dae", ".glb", ".gltf"]]))
