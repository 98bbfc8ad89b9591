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
from textured import write_textured

SCRATCH = sys.argv[2]
# Blender takes its Python's modules from beside the python3 that it finds, which must be Debian's.
SYSTEM = dict(os.environ, PATH="/usr/bin:/bin", BODICE_PROGRAM=os.path.abspath(sys.argv[1]))


def in_blender(blender, script, *arguments):
    done = subprocess.run([blender, "--background", "--factory-startup", "--python-exit-code", "1", "--python",
                           os.path.join(HERE, script), "--", *arguments],
                          capture_output=True, text=True, timeout=200, env=SYSTEM)
    lines = [line for line in done.stdout.splitlines() if line.startswith("FOUND ")]
    check(done.returncode == 0 and len(lines) == 1, f"Blender failed in {script}:\n{done.stdout}\n{done.stderr}")
    return json.loads(lines[0][6:]) if lines else None


def y_up(points):
    return [[x, z, -y] for x, y, z in points]


def compare(blender, name, glb_file, cache):
    found = in_blender(blender, "in_blender.py", os.path.abspath(glb_file), os.path.abspath(cache))
    if not found: return
    glb = Glb(glb_file)
    frames = len(glb.primitive("cloth")["targets"])
    check(most_apart(y_up(found["cloth"]), glb.points("cloth")) < 1e-5, f"{name}: the cloth is elsewhere")
    check(len(found["keys"]) == frames + 1, f"{name}: {len(found['keys'])} shape keys of {frames} frames")
    values = found["values_at_end"]
    check(abs(values[-1] - 1) < 1e-3 and sum(v > 1e-3 for v in values) == 1, f"{name}: weights at the end are {values[-3:]}")
    names = glb.document["meshes"][glb.nodes[glb.find("cloth")]["mesh"]]["extras"]["targetNames"]
    check(found["keys"][1:] == names, f"{name}: keys are {found['keys'][1:3]}, ...")
    check(most_apart(y_up(found["last_key"]), glb.points("cloth", frames - 1)) < 1e-5, f"{name}: the last frame")
    node = glb.nodes[glb.find("head_0")]
    check(found["extras"] == {key: node["extras"][key] for key in found["extras"]}, f"{name}: extras")
    check(most_apart(y_up(found["cached"]), glb.points("cloth", frames - 1)) < 1e-4,
          f"{name}: {cache} ends {most_apart(y_up(found['cached']), glb.points('cloth', frames - 1))} m elsewhere")


def convex(blender):
    """Each convex piece is one closed mesh in Blender, and holds what the file has."""
    run("fit", "body.obj", "--tier", "solid", "-o", "p.json", "-q")
    run("export", "p.json", "--to", "convex", "--count", "16", "-o", "pieces.gltf", "-q")
    run("export", "p.json", "--to", "convex", "--count", "16", "-o", "pieces.obj", "-q")
    found = in_blender(blender, "convex_in_blender.py", os.path.abspath("pieces.gltf"), os.path.abspath("pieces.obj"))
    if not found: return
    nodes = json.load(open("pieces.gltf"))["nodes"]
    check(len(found["gltf"]) == len(found["obj"]) == sum("mesh" in node for node in nodes) > 8, "number of pieces")
    for name, piece in {**found["gltf"], **found["obj"]}.items():
        check(piece["open_edges"] == 0, f"{name}: {piece['open_edges']} edges are not manifold")
        check(piece["volume"] > 0, f"{name}: wound inward, {piece['volume']} m3")
    apart = max(abs(a["volume"] - b["volume"]) for a, b in
                zip(*(sorted(pieces.values(), key=lambda piece: piece["volume"]) for pieces in found.values())))
    check(apart < 1e-7, f"pieces of glTF and OBJ differ by {apart} m3")


def corners_of(glb, node):
    """Position, texture coordinate and material of each corner, sorted, without the last digits."""
    mesh, map_, found = glb.document["meshes"][glb.nodes[node]["mesh"]], glb.world(node), []
    for p in mesh["primitives"]:
        at, uv = (glb.numbers(p["attributes"][name]) for name in ("POSITION", "TEXCOORD_0"))
        name = glb.document["materials"][p["material"]]["name"]
        for (i,) in glb.numbers(p["indices"]):
            point = [row[0] * at[i][0] + row[1] * at[i][1] + row[2] * at[i][2] + row[3] for row in map_]
            found.append((name, *[round(v, 3) for v in point + uv[i]]))
    return sorted(found)


def looks(blender):
    """A garment that Blender exports in four formats comes back with its textures, materials, image and name."""
    write_textured("skirt.obj", "checked.obj")
    exported = in_blender(blender, "export_from_blender.py", os.path.abspath("checked.obj"), os.path.abspath("garment"))
    if not exported: return
    image, first = open("checks.png", "rb").read(), None
    for file in ["checked.obj", *exported]:
        run("drape", "body.obj", os.path.relpath(file), "--unit", "m", "--up", "y", "--tier", "solid", "--substeps", "1", "--frames",
            "1", "--no-picture", "-o", "look.glb", "-q")
        glb = Glb("look.glb")
        (node,) = glb.nodes[glb.find("cloth")]["children"]
        check(glb.nodes[node]["name"] == "Skirt", f"{file}: the name is {glb.nodes[node]['name']}")
        view = glb.document["bufferViews"][glb.document["images"][0]["bufferView"]]
        check(glb.buffer[view["byteOffset"]:view["byteOffset"] + view["byteLength"]] == image, f"{file}: another image")
        checks = next(m for m in glb.document["materials"] if m["name"] == "Checks")
        check("baseColorTexture" in checks["pbrMetallicRoughness"], f"{file}: no texture")
        corners = corners_of(glb, node)
        first = first or corners
        apart = sum(a[0] != b[0] or max(abs(p - q) for p, q in zip(a[1:], b[1:])) > 0.0015 for a, b in zip(first, corners))
        check(len(first) == len(corners) and apart < 0.01 * len(first), f"{file}: {apart} of {len(corners)} corners are others")


def addon(blender):
    """The add-on fits, shows and bakes: its ellipsoids hold the skin as the proxy does, and the cloth moves."""
    file = os.path.join(os.environ["BODICE_ROOT"], "modules", "colliders", "blender", "bodice_addon.py")
    found = in_blender(blender, "addon_in_blender.py", file, os.path.abspath("body.obj"), os.path.abspath("skirt.obj"))
    if not found: return
    check("Select garments" in (found["refused"] or ""), f"a bake without a garment: {found['refused']}")
    check(found["fit"] == found["bake"] == ["FINISHED"], f"{found['fit']}, {found['bake']}")
    inverse = [inverted(m) for m in found["ellipsoids"]]
    outside = sum(min(sum(v * v for v in transformed(m, p)) for m in inverse) > 1.01 for p in found["skin"][::7])
    check(outside < 0.03 * len(found["skin"][::7]), f"{outside} points of the skin are outside of all ellipsoids")
    first, last = found["frames"]
    check(len(first) == len(found["before"]), "vertices of the garment")
    check(most_apart(first, found["before"]) < 0.05, f"the first frame is {most_apart(first, found['before'])} m off")
    check(0.001 < most_apart(last, found["before"]) < 0.3, f"the cloth moved {most_apart(last, found['before'])} m")


def transformed(m, p): return [sum(m[r][k] * p[k] for k in range(3)) + m[r][3] for r in range(3)]


def inverted(m):
    """Of an affine map: Cramer's rule."""
    (a, b, c, _), (d, e, f, _), (g, h, i, _) = m[:3]
    det = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    rows = [[(e * i - f * h) / det, (c * h - b * i) / det, (b * f - c * e) / det],
            [(f * g - d * i) / det, (a * i - c * g) / det, (c * d - a * f) / det],
            [(d * h - e * g) / det, (b * g - a * h) / det, (a * e - b * d) / det]]
    return [row + [-sum(row[k] * m[k][3] for k in range(3))] for row in rows]


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
    addon(blender)
    convex(blender)
    looks(blender)
    print("Blender:", "failed" if failures else "passed")
    return 1 if failures else 0


sys.exit(main())
