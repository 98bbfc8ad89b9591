"""Reads the data of pages back: they agree with `bodice query`, with the GLB's frames and with each other, and a page
names nothing outside itself."""
import array
import base64
import json
import os
import re
import shutil
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support", "python"))
from program_check import check, failures, run

SCRATCH = sys.argv[2]


def numbers(text, code):
    return array.array(code, base64.b64decode(text, validate=True))


def read(file):
    text = open(file, encoding="utf-8").read()
    check(not re.search(r"https?:|<link|src=|@import|fetch\(|XMLHttpRequest", text), f"{file} loads something")
    check(text.count("<script") == 2 and text.count("</script>") == 2, f"{file}: the data end their element")
    return json.loads(re.search(r'id="data">(.*?)</script>', text, re.S)[1])


def points_of(data, packed):
    *low, side = data["cube"]
    return [low[i % 3] + side * v / 65535 for i, v in enumerate(numbers(packed, "H"))]


def check_mesh(data, mesh, frames, name):
    triangles = numbers(mesh["triangles"], "I")
    for packed in frames:
        count = len(points_of(data, packed)) // 3
        check(len(triangles) > 0 and max(triangles) < count, f"{name}: a triangle of a vertex that is not there")


def errors_are_those_of_queries():
    run("make", "--vertices", "2000", "-o", "body.obj", "-q")
    run("fit", "body.obj", "--tier", "relief", "--max-ellipsoids", "20", "-o", "p.json", "--html", "fit.html", "-q")
    data = read("fit.html")
    at, error = points_of(data, data["skin"]["positions"]), numbers(data["skin"]["error"], "h")
    check(len(error) == data["skin"]["vertices"] == len(at) // 3, "not an error a vertex")
    vertices = [line.split()[1:4] for line in open("body.obj") if line.startswith("v ")]
    apart = max(abs(float(v) - at[3 * i + k]) for i, p in enumerate(vertices) for k, v in enumerate(p))
    check(len(vertices) == len(error) and apart < 2e-5, f"vertices are {apart} m off")
    with open("points.txt", "w") as out:
        for p in vertices: print(*p, file=out)
    found = [float(line.split()[0]) for line in run("query", "p.json", "points.txt").splitlines()]
    apart = max(abs(1e3 * d - e / 100) for d, e in zip(found, error))
    check(apart < 6e-3, f"errors are {apart} mm off those of bodice query")
    check_mesh(data, data["surface"], [data["surface"]["positions"]], "surface")
    check(len(numbers(data["ellipsoids"]["shapes"], "f")) == 12 * len(numbers(data["ellipsoids"]["part"], "B")),
          "not twelve numbers an ellipsoid")
    check(data["hash"] in data["report"] and json.loads(data["report"]), "the report of this proxy is not in the page")


def tasks_are_those_of_the_trace(tasks, stages, trace):
    spans = [e for e in json.load(open(trace))["traceEvents"] if e["ph"] == "X"]
    check(len(tasks) == len(spans) > 5, f"{len(tasks)} tasks of {len(spans)} spans")
    first = min(e["ts"] for e in spans)
    for (name, begin, ms, thread), e in zip(tasks, sorted(spans, key=lambda e: e["ts"])):
        check(name == e["name"] and abs(begin - (e["ts"] - first) / 1e3) < 0.01 and abs(ms - e["dur"] / 1e3) < 0.01,
              f"{name} at {begin} ms is {e}")
    for name, ms in stages:
        check(name == "set-up and judging" or any(t[0] == name and abs(t[2] - ms) < 1 for t in tasks), f"no task for {name}")


def drapes_move():
    run("drape", "--vertices", "3000", "--tier", "solid", "--motion", "walk", "--frames", "6", "--keep", "4", "--substeps", "4",
        "-o", "w.glb", "--no-picture", "--report", "w.json", "--html", "w.html", "--trace", "t.json", "-q")
    data, report = read("w.html"), json.load(open("w.json"))
    tasks_are_those_of_the_trace(data["tasks"], data["stages"], "t.json")
    frames = len(data["times"])
    check(frames == 4 and data["left_out"] == 0, f"{frames} frames of 4")
    for name, item in [("cloth", data["cloth"][0]), ("skin", data["skin"])]:
        check(len(item["frames"]) == frames, f"{name}: not a mesh a frame")
        check(item["frames"][0] != item["frames"][-1], f"{name} stands still")
        check_mesh(data, item, item["frames"], name)
    check(len(data["drape"]["penetration"]) == 6, "not a penetration a frame")
    worst = max(data["drape"]["penetration"])
    check(abs(worst - report["drape"]["penetration"]["max_mm"]) < 1e-6, "the deepest particle is another one")
    check(worst == 0 or data["drape"]["penetration"][data["drape"]["worst"] - 1] == worst, "the worst frame is another")


def large_skins_are_thinned():
    run("fit", "--vertices", "80000", "--tier", "paper", "--html", "large.html", "-q")
    data = read("large.html")
    error, at = numbers(data["skin"]["error"], "h"), numbers(data["skin"]["positions"], "H")
    check(data["skin"]["vertices"] > 60000 >= len(error) > 20000 and len(at) == 3 * len(error), "thinning")
    check_mesh(data, data["skin"], [data["skin"]["positions"]], "a thinned skin")


def same_tasks(then, now):
    """Those of a run as it ended, and of its trace's file."""
    check(len(then) == len(now) > 0, f"{len(now)} tasks of {len(then)}")
    for a, b in zip(then, now):
        check(a[0] == b[0] and a[3] == b[3] and max(abs(p - q) for p, q in zip(a[1:3], b[1:3])) < 1e-3, f"{b} is {a}")


def pages_of_files():
    """What was saved gives the page that --html gave, and states what it does not hold."""
    run("fit", "body.obj", "--tier", "relief", "--max-ellipsoids", "20", "-o", "q.bodice", "--glb", "q.glb",
        "--report", "q.json", "--html", "q.html", "--trace", "q.trace", "-q")
    run("report", "q.json", "q.glb", "q.trace", "q.bodice", "-o", "files.html", "-q")
    then, now = read("q.html"), read("files.html")
    for key in ["title", "tier", "hash", "gap_mm", "parts", "colors", "warnings", "stages", "report", "ellipsoids"]:
        check(then[key] == now[key], f"{key} is another one in the page of files")
    for a, b in zip(then["landmarks"], now["landmarks"]):
        check(a["name"] == b["name"] and max(abs(p - q) for p, q in zip(a["at"], b["at"])) < 1e-9, "landmarks")
    check(then["skin"]["part"] == now["skin"]["part"], "parts of the skin")
    at = [numbers(page["skin"]["error"], "h") for page in (then, now)]
    check(len(at[0]) == len(at[1]) and max(abs(p - q) for p, q in zip(*at)) <= 1, "errors differ by over 0.01 mm")
    check(now["lacks"] == [], f"{now['lacks']}")
    same_tasks(then["tasks"], now["tasks"])

    run("report", "q.bodice", "-o", "proxy.html", "-q")
    data = read("proxy.html")
    check("skin" not in data and "surface" in data and len(data["lacks"]) == 2, f"a proxy alone: {data['lacks']}")
    run("report", "q.bodice", "--body", "body.obj", "-o", "body.html", "-q")
    data = read("body.html")
    check(data["skin"]["error"] == now["skin"]["error"], "errors of --body")

    run("report", "w.glb", "t.json", "w.json", "-o", "walk.html", "-q")
    then, now = read("w.html"), read("walk.html")
    same_tasks(then["tasks"], now["tasks"])
    for key in ["drape", "stages"]: check(then[key] == now[key], f"{key} of a walk")
    check(max(abs(a - b) for a, b in zip(then["times"], now["times"])) < 1e-6, "times of a walk")
    for name in ["cloth", "skin"]:
        a, b = ((data[name][0] if name == "cloth" else data[name])["frames"] for data in (then, now))
        check(len(a) == len(b) == 4, f"{name}: {len(b)} frames of 4")
        apart = max(abs(p - q) for one, other in zip(a, b)
                    for p, q in zip(points_of(then, one), points_of(now, other)))
        check(apart < 1e-4, f"{name}: frames of files are {apart} m off")
    check(len(now["lacks"]) == 1 and "colored" in now["lacks"][0], f"{now['lacks']}")


def refusals():
    check("two runs" in run("report", "q.bodice", "w.glb", "-o", "none.html", code=2), "files of two runs")
    run("report", "q.json", "-o", "times.html", "-q")
    check(any("trace" in sentence for sentence in read("times.html")["lacks"]), "no word about the trace")
    for text in ['{"traceEvents":[]}', '{"traceEvents":[{"ph":"X","ts":1}]}', '{"traceEvents":']:
        with open("bad.trace", "w") as file: file.write(text)
        check("no trace of a run" in run("report", "q.json", "bad.trace", "-o", "none.html", code=1), f"the trace {text}")
    check("two reports" in run("report", "q.json", "w.json", "-o", "none.html", code=2), "two reports")
    os.makedirs("empty")
    check("no result" in run("report", "empty", "-o", "none.html", code=1), "an empty folder")
    check("does not exist" in run("report", "nowhere", "-o", "none.html", code=1), "a file that is not there")
    check("would overwrite" in run("report", "q.html", "-o", "q.html", code=2), "the output is an input")
    check("already" in run("report", "q.glb", "--body", "body.obj", "-o", "none.html", code=2), "two skins")
    printed = run("report", "body.obj", "-o", "none.html", code=1)
    check(printed.count("\n") == 1, f"a body in place of a run: {printed}")
    check(not os.path.exists("none.html"), "a page was left behind")


def main():
    shutil.rmtree(SCRATCH, ignore_errors=True)
    os.makedirs(SCRATCH)
    os.chdir(SCRATCH)
    errors_are_those_of_queries()
    drapes_move()
    large_skins_are_thinned()
    pages_of_files()
    refusals()
    check("folder" in run("fit", "--html", "no/such/page.html", code=1), "a folder that does not exist")
    check("extension" in run("fit", "--html", "page.txt", code=2), "an extension that is not a page's")
    print("pages:", "failed" if failures else "passed")
    return 1 if failures else 0


sys.exit(main())
