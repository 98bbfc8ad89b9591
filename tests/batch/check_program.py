"""Checks `bodice batch` as users run it: results equal to the bit to those of single commands, and faults that each
leave a line of their own."""
import glob
import json
import os
import shutil
import signal
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support", "python"))
from program_check import PROGRAM, check, failures, run

SCRATCH = sys.argv[2]
SMALL = {"tier": "paper", "vertices": 1500, "frames": 2, "substeps": 2, "keep": 2}


def write(file, text):
    with open(file, "w", encoding="utf-8") as stream:
        stream.write(text)


def manifest(file, jobs):
    write(file, "".join((job if isinstance(job, str) else json.dumps(job)) + "\n" for job in jobs))


def log_of(out):
    """The latest log of a folder, by line of the manifest."""
    latest = max(glob.glob(out + "/log/*.jsonl"), key=os.path.getmtime)
    lines = [json.loads(line) for line in open(latest, encoding="utf-8")]
    check("run" in lines[0], "no line for the run")
    return {line["line"]: line for line in lines[1:]}


def same(a, b):
    return open(a, "rb").read() == open(b, "rb").read()


def check_results():
    run("make", "--vertices", "1500", "-o", "body.obj", "--garment", "skirt", "--garment-out", "skirt.obj", "-q")
    jobs = [dict(SMALL), dict(SMALL, garment="poncho"), {"body": "body.obj", "only": "fit", "tier": "paper"},
            {"body": "body.obj", "garment": "skirt.obj", "tier": "paper", "frames": 2, "wind": [0, 0, 2], "gust": 0.5},
            {"body": "body.obj", "garment": ["skirt.obj", "skirt.obj"], "tier": "paper", "frames": 2.0, "loop": False},
            dict(SMALL, motion="walk", tier="solid", substeps=1, labels="labels.txt", html="page.html")]
    manifest("jobs.jsonl", jobs)
    run("batch", "jobs.jsonl", "--out", "out", "-q")
    log = log_of("out")
    check(len(log) == 6 and all(line["outcome"] == "done" for line in log.values()), f"not six results: {log}")
    folder = {line: "out/" + about["folder"] for line, about in log.items()}
    for line in log:
        model = "body.glb" if line == 3 else "drape.glb"
        for file in ("proxy.bodice", model, "report.json", "job.json", "thumbnail.png"):
            check(os.path.getsize(os.path.join(folder[line], file)) > 0, f"line {line} has no {file}")
        check(log[line]["numbers"]["error_mm"] >= 0 and log[line]["memory_mb"] > 1, f"line {line} has no numbers")
    for file in ("labels.txt", "page.html"):
        check(os.path.exists(os.path.join(folder[6], file)), f"no {file}")
    run("drape", "--tier", "paper", "--vertices", "1500", "--frames", "2", "--substeps", "2", "--keep", "2", "-o",
        "a.glb", "--garment", "poncho", "-q")
    check(same("a.glb", folder[2] + "/drape.glb"), "a made garment drapes otherwise than by itself")
    run("fit", "body.obj", "--tier", "paper", "-o", "a.bodice", "-q")
    check(same("a.bodice", folder[3] + "/proxy.bodice"), "a fit is another than by itself")
    run("drape", "body.obj", "skirt.obj", "--tier", "paper", "--frames", "2", "--wind", "0,0,2", "--gust", "0.5", "-o",
        "a.glb", "-q")
    check(same("a.glb", folder[4] + "/drape.glb"), "files drape otherwise than by themselves")
    # The report's command repeats the job alone.
    command = json.load(open(folder[6] + "/report.json"))["command"]
    run(*command[1:], "-o", "a.glb", "-q")
    check(same("a.glb", folder[6] + "/drape.glb"), "a body that moves drapes otherwise by the command of its report")

    write("jobs.csv", "body,garment,tier,frames,wind,only,gust\nbody.obj,skirt.obj,paper,2,0;0;2,,0.5\n"
                      "body.obj,skirt.obj;skirt.obj,paper,2,,,\nbody.obj,,paper,,,fit,\n")
    run("batch", "jobs.csv", "--out", "out", "-q")
    outcomes = {line: about["outcome"] for line, about in log_of("out").items()}
    check(outcomes == {2: "there", 3: "done", 4: "there"}, f"CSV: {outcomes}")  # line 3 leaves `loop` out
    run("batch", "jobs.jsonl", "--out", "workers", "--jobs", "1", "--threads", "2", "-q")
    for line, about in log_of("workers").items():
        for file in ("proxy.bodice", "body.glb" if line == 3 else "drape.glb"):
            check(same(f"workers/{about['folder']}/{file}", f"{folder[line]}/{file}"), f"two workers: line {line}")


def check_props():
    """A box beside the body is met as in a single command, and counts by its content."""
    corners = "".join(f"v {0.6 + 0.4 * x} {0.4 * y} {-0.2 + 0.4 * z}\n" for z in (0, 1) for y in (0, 1) for x in (0, 1))
    write("box.obj", corners + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n")
    manifest("props.jsonl", [dict(SMALL, prop="box.obj"), dict(SMALL, prop=["box.obj", "box.obj"]), dict(SMALL)])
    run("batch", "props.jsonl", "--out", "props", "-q")
    folders = {line: "props/" + about["folder"] for line, about in log_of("props").items()}
    report = json.load(open(folders[1] + "/report.json"))
    check(len(report["drape"]["props"]) == 1, "one prop is not one")
    check(len(json.load(open(folders[2] + "/report.json"))["drape"]["props"]) == 2, "two props are not two")
    check(not same(folders[1] + "/drape.glb", folders[3] + "/drape.glb"), "a prop changes nothing")
    run(*report["command"][1:], "-o", "a.glb", "-q")
    check(same("a.glb", folders[1] + "/drape.glb"), "a prop is met otherwise than by itself")


def check_faults():
    write("corrupt.obj", "v 0 0 0\nv 1 0 0\nv nonsense\nf 1 2 900\n")
    manifest("faults.jsonl", [
        dict(SMALL), {"body": "corrupt.obj", "only": "fit"}, {"vertices": 4000000, "only": "fit"}, "{broken",
        {"body": "nowhere.obj"}, {"frames": 0}, {"tier": "perfect"}, {"colour": "red"}, {"output": "x.glb"},
        {"labels": "../x.txt"}, {"only": "fit", "frames": 3}, {"only": "drape"}, {"gust": 0.5}, {"max-ellipsoids": 9},
        {"garment": "body.obj"}, {"force": "perhaps", "body": "body.obj"}, dict(SMALL, seed=3)])
    begin = time.time()
    text = run("batch", "faults.jsonl", "--out", "faults", "--timeout", "5", "--memory", "1500", code=1)
    check(time.time() - begin < 120, "an endless body holds up the batch")
    log = log_of("faults")
    done = [line for line, about in log.items() if about["outcome"] == "done"]
    check(len(log) == 17 and done == [1, 17] or sorted(done) == [1, 17], f"done are {done}")
    words = {2: "corrupt.obj", 4: "faults.jsonl:4", 5: "nowhere.obj", 6: "frames", 7: "tier", 8: "colour", 9: "output",
             10: "labels", 11: "frames", 12: "only", 13: "wind", 14: "max-ellipsoids", 15: "body", 16: "force"}
    for line, word in words.items():
        check(word in log[line]["reason"], f"line {line}: {log[line]['reason']}")
    check(log[3]["failure"] in ("timeout", "memory"), f"an endless body: {log[3]}")
    check("15 failed" in text and "nowhere.obj" in text, text)
    text = run("batch", "--summary", "faults", code=1)
    check("2 results" in text, text)
    page = open("faults/summary.html", encoding="utf-8").read()
    check(page.count("data:image/png") == 2 and page.index("nowhere.obj") < page.index("data:image/png"), "the page")
    check(len(open("faults/summary.csv").readlines()) == 18, "summary.csv")


def check_usage():
    for arguments in (["jobs.jsonl"], ["--out", "o"], [], ["jobs.jsonl", "--out", "o", "--shard", "2/2"],
                      ["jobs.jsonl", "--out", "o", "--shard", "x"], ["jobs.jsonl", "--out", "o", "--timeout", "-1"],
                      ["jobs.jsonl", "--out", "o", "--summary", "o"]):
        run("batch", *arguments, code=2)
    run("batch", "nowhere.jsonl", "--out", "o", code=1)
    run("batch", "--summary", "nowhere", code=1)


def check_stop():
    manifest("long.jsonl", [dict(SMALL, frames=100000, seed=seed) for seed in range(4)])
    for number in (signal.SIGINT, signal.SIGTERM):
        batch = subprocess.Popen([PROGRAM, "batch", "long.jsonl", "--out", "long"], stderr=subprocess.PIPE, text=True)
        while not glob.glob("long/part/*"):
            time.sleep(0.05)
        batch.send_signal(number)
        text = batch.communicate(timeout=20)[1]
        check(batch.returncode == 1 and "4 of 4 jobs to do" in text, f"stopped: {batch.returncode}, {text}")
        check(not glob.glob("long/part/*") and not glob.glob("long/??/*"), "a stopped batch left something")


shutil.rmtree(SCRATCH, ignore_errors=True)
os.makedirs(SCRATCH)
os.chdir(SCRATCH)
for each in (check_results, check_props, check_faults, check_usage, check_stop):
    each()
print(f"{len(failures)} failed" if failures else "all checks of batches passed")
sys.exit(bool(failures))
