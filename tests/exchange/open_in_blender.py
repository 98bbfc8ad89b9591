"""GLBs and point caches in Blender, headless: positions are those that the files hold. Skipped where it is not installed."""
import json
import os
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "support", "python"))
from glb import Glb, most_apart
from program_check import check, failures, run

SCRATCH = sys.argv[2]
# Blender takes its Python's modules from beside the python3 that it finds, which must be Debian's.
SYSTEM = dict(os.environ, PATH="/usr/bin:/bin")


def in_blender(blender, glb, cache):
    done = subprocess.run([blender, "--background", "--factory-startup", "--python-exit-code", "1", "--python",
                           os.path.join(HERE, "in_blender.py"), "--", glb, cache],
                          capture_output=True, text=True, timeout=200, env=SYSTEM)
    lines = [line for line in done.stdout.splitlines() if line.startswith("FOUND ")]
    check(done.returncode == 0 and len(lines) == 1, f"Blender failed on {glb}:\n{done.stdout}\n{done.stderr}")
    return json.loads(lines[0][6:]) if lines else None


def y_up(points):
    return [[x, z, -y] for x, y, z in points]


def compare(blender, name, glb_file, cache):
    found = in_blender(blender, os.path.abspath(glb_file), os.path.abspath(cache))
    if not found: return
    glb = Glb(glb_file)
    frames = len(glb.primitive("cloth")["targets"])
    check(most_apart(y_up(found["cloth"]), glb.points("cloth")) < 1e-5, f"{name}: the cloth is elsewhere")
    check(len(found["keys"]) == frames + 1, f"{name}: {len(found['keys'])} shape keys of {frames} frames")
    names = glb.document["meshes"][glb.nodes[glb.find("cloth")]["mesh"]]["extras"]["targetNames"]
    check(found["keys"][1:] == names, f"{name}: keys are {found['keys'][1:3]}, ...")
    check(most_apart(y_up(found["last_key"]), glb.points("cloth", frames - 1)) < 1e-5, f"{name}: the last frame")
    node = glb.nodes[glb.find("head_0")]
    check(found["extras"] == {key: node["extras"][key] for key in found["extras"]}, f"{name}: extras")
    check(most_apart(y_up(found["cached"]), glb.points("cloth", frames - 1)) < 1e-4,
          f"{name}: {cache} ends {most_apart(y_up(found['cached']), glb.points('cloth', frames - 1))} m elsewhere")


def main():
    blender = os.environ.get("BODICE_BLENDER", "")
    if not os.path.exists(blender):
        print("skipped: no Blender here (Debian: blender)")
        return 0
    if subprocess.run(["/usr/bin/python3", "-c", "import numpy"], capture_output=True).returncode != 0:
        print("skipped: Blender's reader of glTF needs numpy (Debian: python3-numpy)")
        return 0
    shutil.rmtree(SCRATCH, ignore_errors=True)
    os.makedirs(SCRATCH)
    os.chdir(SCRATCH)
    few = ["--tier", "solid", "--substeps", "2", "--no-picture", "-q"]
    run("make", "--vertices", "2000", "-o", "body.obj", "--garment-out", "skirt.obj", "-q")
    run("drape", "body.obj", "skirt.obj", "--frames", "12", "--keep", "4", "-o", "still.glb", "--cache", "still.pc2", *few)
    compare(blender, "floats", "still.glb", "still.pc2")
    run("drape", "body.obj", "skirt.obj", "--frames", "160", "--keep", "160", "-o", "long.glb", "--cache", "long.mdd", *few)
    check(Glb("long.glb").document.get("extensionsRequired"), "the long drape is not quantized")
    compare(blender, "small integers", "long.glb", "long.mdd")
    print("Blender:", "failed" if failures else "passed")
    return 1 if failures else 0


sys.exit(main())
