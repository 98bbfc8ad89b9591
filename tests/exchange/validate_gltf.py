"""Khronos' validator finds no error and no warning in any glTF that the program writes. It is on npm; skipped without."""
import json
import os
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support", "python"))
from program_check import check, failures, run
from textured import write_textured

SCRATCH = sys.argv[2]
SCRIPT = """
const fs = require('fs'), validator = require('gltf-validator');
(async () => {
  for (const file of process.argv.slice(1)) {
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {uri: file, maxIssues: 20});
    console.log(JSON.stringify({file, issues: report.issues}));
  }
})();
"""


def modules_of(node):
    """The folder that has the validator: BODICE_NODE_MODULES, or node_modules in the repository or above it."""
    root = os.environ.get("BODICE_ROOT", ".")
    for folder in [os.environ.get("BODICE_NODE_MODULES", ""), os.path.join(root, "node_modules"),
                   os.path.join(root, "build", "node_modules"), os.path.join(root, "..", "node_modules")]:
        if folder and os.path.isdir(os.path.join(folder, "gltf-validator")): return folder
    return None


def write_all():
    run("make", "--vertices", "2000", "-o", "body.obj", "--garment-out", "skirt.obj", "-q")
    with open("cm.obj", "w") as out:  # in centimeters, z up
        for line in open("body.obj"):
            fields = line.split()
            if fields[:1] == ["v"]:
                x, y, z = (100 * float(v) for v in fields[1:4])
                line = f"v {x} {-z} {y}\n"
            out.write(line)
    few = ["--tier", "solid", "--substeps", "2", "--no-picture", "-q"]
    run("fit", "body.obj", "--tier", "solid", "--glb", "fit.glb", "-o", "p.json", "-q")
    run("fit", "cm.obj", "--tier", "solid", "--glb", "cm.glb", "-q")
    run("rig", "body.obj", "-o", "rigged.glb", "-q")
    run("fit", "rigged.glb", "--tier", "solid", "--glb", "bound.glb", "-o", "bound.json", "-q")
    run("drape", "body.obj", "skirt.obj", "--frames", "20", "--fit-map", "ease", "-o", "still.glb", *few)
    run("drape", "body.obj", "skirt.obj", "--motion", "walk", "--frames", "20", "-o", "walk.glb", *few)
    run("drape", "body.obj", "skirt.obj", "--frames", "400", "--keep", "400", "-o", "long.glb", *few)
    write_textured("skirt.obj", "checked.obj")
    run("drape", "body.obj", "checked.obj", "--frames", "20", "-o", "textured.glb", *few)
    run("drape", "body.obj", "checked.obj", "--frames", "300", "--keep", "300", "-o", "textured_long.glb", *few)
    run("export", "bound.json", "--to", "vrm", "-o", "bound.gltf", "-q")
    run("export", "bound.json", "--to", "convex", "-o", "bound_convex.gltf", "-q")
    run("export", "p.json", "--to", "convex", "-o", "convex.gltf", "-q")
    return [file for file in sorted(os.listdir(".")) if file.endswith((".glb", ".gltf"))]


def main():
    node = os.environ.get("BODICE_NODE", "")
    folder = modules_of(node) if os.path.exists(node) else None
    if not folder:
        print("skipped: no gltf-validator here (npm install gltf-validator, beside the repository or in it)")
        return 0
    shutil.rmtree(SCRATCH, ignore_errors=True)
    os.makedirs(SCRATCH)
    os.chdir(SCRATCH)
    files = write_all()
    done = subprocess.run([node, "-e", SCRIPT, *files], capture_output=True, text=True, timeout=200,
                          env=dict(os.environ, NODE_PATH=os.path.abspath(folder) if os.path.isabs(folder) else folder))
    check(done.returncode == 0, done.stderr)
    reports = [json.loads(line) for line in done.stdout.splitlines()]
    check(len(reports) == len(files) >= 12, f"{len(reports)} reports of {len(files)} files")
    for report in reports:
        issues = report["issues"]
        print(f"{report['file']}: {issues['numErrors']} errors, {issues['numWarnings']} warnings, "
              f"{issues['numInfos']} notes")
        check(issues["numErrors"] == issues["numWarnings"] == 0, f"{report['file']}: {issues['messages']}")
    print("glTF:", "failed" if failures else "passed")
    return 1 if failures else 0


sys.exit(main())
