"""What the tests of schedulers share: small jobs, a run without a scheduler, and the comparison with it."""
import glob
import json
import os
import shutil
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support", "python"))
from program_check import PROGRAM, check, failures, run

JOBS = 60
EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "cluster")


def begin(scratch):
    """An empty folder with jobs.jsonl, and its results by one batch in `alone`."""
    shutil.rmtree(scratch, ignore_errors=True)
    os.makedirs(scratch)
    os.chdir(scratch)
    with open("jobs.jsonl", "w", encoding="utf-8") as manifest:
        for n in range(JOBS):
            job = {"seed": n // 2, "vertices": 2000, "tier": "paper", "garment": "poncho", "fabric": ["cotton", "silk"][n % 2],
                   "frames": 12}
            manifest.write(json.dumps(job) + "\n")
    begin_s = time.time()
    run("batch", "jobs.jsonl", "--out", "alone", "-q")
    print(f"{JOBS} jobs without a scheduler: {time.time() - begin_s:.1f} s", flush=True)


def results(out):
    return {os.path.basename(folder): folder for folder in glob.glob(out + "/??/*")}


def wait_until(done, what, limit_s=300):
    until = time.time() + limit_s
    while not done():
        if time.time() > until:
            check(False, f"{what}: not after {limit_s} s")
            return False
        time.sleep(0.2)
    return True


def without_times(file):
    """A report but for what depends on the clock and on where it ran."""
    def cleaned(value):
        if isinstance(value, dict):
            return {key: cleaned(item) for key, item in value.items() if key != "frame_ms" and key != "stages"}
        return [cleaned(item) for item in value] if isinstance(value, list) else value
    return cleaned(json.load(open(file, encoding="utf-8")))


def compare(out):
    """Every result there once, and equal to the bit to that of the run without a scheduler."""
    alone, here = results("alone"), results(out)
    check(len(alone) == JOBS, f"{len(alone)} results without a scheduler")
    check(set(alone) == set(here), f"{out}: {len(here)} results, {len(set(alone) & set(here))} of them right")
    for key in set(alone) & set(here):
        for file in ("proxy.bodice", "drape.glb", "thumbnail.png", "job.json"):
            a, b = (open(f"{folder}/{file}", "rb").read() for folder in (alone[key], here[key]))
            if file == "job.json":  # numbers have a time among them
                a, b = (json.loads(text) for text in (a, b))
                for numbers in (a["numbers"], b["numbers"]):
                    for name in ("frame_ms", "dress_s", "drape_s"):
                        numbers.pop(name)
            check(a == b, f"{key}/{file} differs")
        check(without_times(alone[key] + "/report.json") == without_times(here[key] + "/report.json"), f"{key}: report")
    rows = json.load(open(out + "/summary.json", encoding="utf-8"))
    check(rows["jobs"] == JOBS and rows["failed"] == 0, f"the summary: {rows['jobs']} jobs, {rows['failed']} failed")
    print(f"{len(here)} results, compared file by file", flush=True)


def end():
    print(f"{len(failures)} failed" if failures else "all checks passed")
    sys.exit(bool(failures))
