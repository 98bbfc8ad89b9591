"""Files for GarmentCode, read by PyYAML and by Python's JSON: every measurement that its body files have, in the requested unit,
and each vertex of the body in one of its six regions. Skipped without PyYAML (Debian: python3-yaml)."""
import json
import os
import shutil
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support", "python"))
from program_check import check, failures, run

SCRATCH = sys.argv[2]
# The names that GarmentCode's own body files have.
NAMES = ["arm_length", "arm_pose_angle", "armscye_depth", "back_width", "bum_points", "bust", "bust_line", "bust_points",
         "crotch_hip_diff", "head_l", "height", "hip_back_width", "hip_inclination", "hips", "hips_line", "leg_circ", "neck_w",
         "shoulder_incl", "shoulder_w", "underbust", "vert_bust_line", "waist", "waist_back_width", "waist_line",
         "waist_over_bust_line", "wrist"]
REGIONS = ["body", "face_internal", "left_arm", "left_leg", "right_arm", "right_leg"]


def measurements(yaml):
    bodies = {}
    for unit, in_cm in [("mm", 0.1), ("cm", 1.0)]:
        run("fit", "body.obj", "--tier", "paper", "--measurements", "m.yaml", "--measurements-unit", unit, "-q")
        data = yaml.safe_load(open("m.yaml"))
        check(set(NAMES) <= set(data["body"]), f"not there: {set(NAMES) - set(data['body'])}")
        check(all(isinstance(v, float) for v in data["body"].values()), "a measurement is no number")
        angles = {"arm_pose_angle", "shoulder_incl", "hip_inclination"}
        bodies[unit] = {name: v if name in angles else in_cm * v for name, v in data["body"].items()}
    apart = max(abs(bodies["mm"][name] - bodies["cm"][name]) for name in NAMES)
    check(apart < 0.006, f"millimeters and centimeters differ by {apart} cm")
    points = [[float(v) for v in line.split()[1:]] for line in open("body.obj") if line.startswith("v ")]
    tall = 100 * (max(p[1] for p in points) - min(p[1] for p in points))
    check(abs(bodies["cm"]["height"] - tall) < 0.5, f"a height of {bodies['cm']['height']} cm for {tall} cm")


def regions():
    run("fit", "body.obj", "--tier", "paper", "--segmentation", "seg.json", "-q")
    data = json.load(open("seg.json"))
    points = [[float(v) for v in line.split()[1:]] for line in open("body.obj") if line.startswith("v ")]
    check(sorted(data) == REGIONS, f"regions {sorted(data)}")
    check(sorted(v for region in data.values() for v in region) == list(range(len(points))), "not each vertex in one region")
    mean = {name: [sum(points[v][k] for v in data[name]) / len(data[name]) for k in range(3)] for name in REGIONS if data[name]}
    for limb in ["arm", "leg"]:  # the body faces +z, so that its left is at +x
        check(mean["left_" + limb][0] > mean["body"][0] > mean["right_" + limb][0], f"sides of the {limb}s")
    check(mean["left_leg"][1] < mean["body"][1], "legs are not below the body")


def main():
    try: import yaml
    except ImportError:
        print("skipped: no PyYAML here (Debian: python3-yaml)")
        return 0
    shutil.rmtree(SCRATCH, ignore_errors=True)
    os.makedirs(SCRATCH)
    os.chdir(SCRATCH)
    run("make", "--vertices", "2000", "-o", "body.obj", "-q")
    measurements(yaml)
    regions()
    print("GarmentCode:", "failed" if failures else "passed")
    return 1 if failures else 0


sys.exit(main())
