#!/usr/bin/env python3
"""What distances cost from Python and in WebAssembly beside the same call in C, on one thread: 100,000 points within
30 mm of the skin. The languages are measured in turns. The points go in ten parts, and the fastest of many calls of each
part are added: on a busy machine no call of 10 milliseconds passes without an interruption.

    /usr/bin/python3 bench/embedding/rows.py BUILD [WEB]     build/release, build/web/package
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

POINTS, PART, CALLS, TURNS = 100000, 10000, 60, 4
HERE = pathlib.Path(__file__).resolve().parent
BARS = {"Python": 1.2, "WebAssembly": 4.0}
first_call = {}  # microseconds of WebAssembly's first call, before the engine has compiled its code well

build = pathlib.Path(sys.argv[1])
web = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None
os.environ["BODICE_LIBRARY"] = str(build / "modules/capi/libbodice.so")
sys.path.insert(0, str(HERE.parents[1] / "modules/capi/python"))

import numpy as np  # noqa: E402

import bodice  # noqa: E402


def in_c(folder):
    out = subprocess.check_output([build / "bench/embedding", str(POINTS), str(CALLS), folder], text=True)
    return {name: float(us) for name, us in re.findall(r"^distances (\w+) ([0-9.]+)", out, re.M)}


def fastest(body, points):
    least = float("inf")
    for _ in range(CALLS):
        begin = time.perf_counter()
        body.signed_distance(points)
        least = min(least, 1e6 * (time.perf_counter() - begin))
    return least


def in_python(folder):
    points = np.fromfile(pathlib.Path(folder, "points.f32"), np.float32).reshape(-1, 3)
    least = {}
    for name in ("tight", "relief"):
        body = bodice.load(pathlib.Path(folder, f"{name}.bodice"))
        least[name] = sum(fastest(body, points[begin : begin + PART]) for begin in range(0, POINTS, PART))
    return least


def in_web(folder):
    out = subprocess.check_output(["node", HERE / "rows.mjs", str(web), folder, str(CALLS)], text=True)
    for name, us in re.findall(r"^first (\w+) ([0-9.]+)", out, re.M):
        first_call[name] = min(first_call.get(name, 1e300), float(us))
    return {name: float(us) for name, us in re.findall(r"^distances (\w+) ([0-9.]+)", out, re.M)}


def main():
    languages = {"C": in_c, "Python": in_python}
    if web and (web / "bodice_wasm.wasm").exists():
        languages["WebAssembly"] = in_web
    least = {}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(TURNS):
            for language, measure in languages.items():
                for name, us in measure(folder).items():
                    least[name, language] = min(least.get((name, language), 1e300), us)
    failed = False
    print(f"| {POINTS} distances | C | " + " | ".join(language for language in languages if language != "C") + " |")
    print("|---" * (1 + len(languages)) + "|")
    for name in ("tight", "relief"):
        c = least[name, "C"]
        row = f"| {name} | {c / POINTS * 1e3:.1f} ns |"
        for language in languages:
            if language != "C":
                ratio = least[name, language] / c
                failed = failed or ratio > BARS[language]
                row += f" {least[name, language] / POINTS * 1e3:.1f} ns ({ratio:.2f}; at most {BARS[language]}) |"
        print(row)
    for name, us in first_call.items():
        print(f"WebAssembly, {name}: the first call takes {us / POINTS * 1e3:.1f} ns a distance.")
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
