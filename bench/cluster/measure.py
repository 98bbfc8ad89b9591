"""How many jobs an hour does a batch of made bodies by garments do, what does it spend outside of fits and drapes, and
does its memory stay flat?

    python3 bench/cluster/measure.py build/release/bodice FOLDER [--bodies 1000] [--jobs 2] [--job JSON] [--each JSON]
        [--turns N [--against PROGRAM]]

Each body gets a job for each combination of the values of --each, two garments if it is left out. Writes
FOLDER/job_seconds.txt (seconds of a core, a job a line, its share of the fit included: what the simulation draws from),
memory.csv and memory.svg (all processes of the batch; what they share counts once), and prints the rest.
--turns N runs N times other bodies, each with one job and with --jobs side by side, in turns, and by the other
program too: throughput and share outside, on a machine that others use as well.
"""
import argparse
import itertools
import json
import math
import os
import statistics
import subprocess
import sys
import time

TWO_GARMENTS = '{"garment": ["skirt", "tunic"]}'


def write_manifest(file, bodies, first, options, each):
    with open(file, "w", encoding="utf-8") as manifest:
        for seed in range(first, first + bodies):
            for values in itertools.product(*each.values()):
                manifest.write(json.dumps({"seed": seed, **dict(zip(each, values)), **options}) + "\n")


def descendants(process):
    """The process and all below it."""
    found, open_ = [], [process]
    while open_:
        one = open_.pop()
        found.append(one)
        try:
            open_ += [int(word) for word in open(f"/proc/{one}/task/{one}/children").read().split()]
        except OSError:
            pass
    return found


def proportional_mb(processes):
    """Memory that only these processes have, and their shares of what several have."""
    total_kib = 0
    for process in processes:
        try:
            for line in open(f"/proc/{process}/smaps_rollup"):
                if line.startswith("Pss:"):
                    total_kib += int(line.split()[1])
        except OSError:
            pass
    return total_kib * 1024e-6


def run(program, manifest, out, jobs):
    """Runs a batch, and returns its seconds, its log and samples of memory."""
    begin, samples = time.time(), []
    batch = subprocess.Popen([program, "batch", manifest, "--out", out, "--jobs", str(jobs), "-q"])
    while batch.returncode is None:
        processes = descendants(batch.pid)
        samples.append((time.time() - begin, proportional_mb(processes), proportional_mb([batch.pid])))
        try:
            batch.wait(0.2 if len(samples) < 100 else 2.0)  # returns at the end, which `took` counts exactly
        except subprocess.TimeoutExpired:
            pass
    took = time.time() - begin
    if batch.returncode != 0:
        sys.exit("measure: a job failed")
    logs = sorted((os.path.getmtime(f"{out}/log/{name}"), name) for name in os.listdir(out + "/log"))
    lines = [json.loads(line) for line in open(f"{out}/log/{logs[-1][1]}", encoding="utf-8")]
    return took, [line for line in lines if "line" in line], samples


def plot(samples, file):
    """Memory over time as SVG."""
    width, height, left, bottom = 900, 360, 60, 40
    longest, most = samples[-1][0], 1.1 * max(total for _, total, _ in samples)
    x = lambda t: left + (width - left - 20) * t / longest
    y = lambda mb: height - bottom - (height - bottom - 30) * mb / most
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" '
             f'font-size="13"><rect width="{width}" height="{height}" fill="#fff"/>']
    for k in range(5):
        mb = most * k / 4
        parts.append(f'<path d="M{left} {y(mb):.1f}H{width - 20}" stroke="#ddd"/><text x="{left - 8}" y="{y(mb) + 4:.1f}" '
                     f'text-anchor="end">{mb:.0f}</text><text x="{x(longest * k / 4):.1f}" y="{height - 16}" '
                     f'text-anchor="middle">{longest * k / 240:.1f}</text>')
    for column, color in ((1, "#2b6cb0"), (2, "#c05621")):
        path = " ".join(f"{x(sample[0]):.1f},{y(sample[column]):.1f}" for sample in samples)
        parts.append(f'<polyline points="{path}" fill="none" stroke="{color}"/>')
    parts.append(f'<text x="{left}" y="18">memory, 10^6 bytes, over minutes: <tspan fill="#2b6cb0">all processes</tspan>, '
                 '<tspan fill="#c05621">the program itself</tspan></text></svg>')
    with open(file, "w", encoding="utf-8") as svg:
        svg.write("\n".join(parts))


def seconds_inside(log, share):
    """Of fits and drapes; `share`: jobs that share a fit."""
    return sum(line["numbers"]["drape_s"] + line["numbers"]["dress_s"] + line["shared_seconds"] / share for line in log)


def outside_percent(took, log, jobs, share):
    """All but fits and drapes, waiting for the disk and for the last job included, of the time of the jobs' cores."""
    return 100 * (1 - seconds_inside(log, share) / (jobs * took))


def report(took, log, samples, jobs, share, folder):
    cpu = [line["cpu_seconds"] + line["shared_cpu_seconds"] / share for line in log]
    inside = seconds_inside(log, share)
    outside = sum(line["seconds"] for line in log) + sum(line["shared_seconds"] for line in log) / share - inside
    print(f"{len(log)} jobs, {jobs} side by side: {took:.0f} s, {3600 * len(log) / took:.0f} an hour")
    print(f"a job: {statistics.mean(cpu):.3f} s of a core with its share of the fit, {statistics.median(cpu):.3f} in the "
          f"median, {max(cpu):.3f} at most: {3600 / statistics.mean(cpu):.0f} jobs an hour a core")
    print(f"written and drawn: {100 * outside / (outside + inside):.2f} % of the jobs' time")
    print(f"between jobs: {100 * (1 - (inside + outside) / (jobs * took)):.2f} % of the time of {jobs} jobs side by side")
    print(f"outside of fits and drapes, all in all: {outside_percent(took, log, jobs, share):.2f} %")
    quarter = len(samples) // 4
    early, late = ([total for _, total, _ in part] for part in (samples[quarter:2 * quarter], samples[-quarter:]))
    print(f"memory: {statistics.mean(early):.1f} MB in the second quarter, {statistics.mean(late):.1f} in the last, "
          f"{max(total for _, total, _ in samples):.1f} at most; the program {samples[len(samples) // 2][2]:.1f}; a job "
          f"{statistics.mean(line['memory_mb'] for line in log):.1f} resident")
    with open(folder + "/job_seconds.txt", "w", encoding="utf-8") as file:
        file.writelines(f"{seconds:.3f}\n" for seconds in cpu)
    with open(folder + "/memory.csv", "w", encoding="utf-8") as file:
        file.write("s,all_mb,program_mb\n")
        file.writelines(f"{t:.1f},{total:.2f},{own:.2f}\n" for t, total, own in samples)
    plot(samples, folder + "/memory.svg")


def take_turns(arguments, manifest, options, each, share):
    programs = [program for program in (arguments.against, arguments.program) if program]
    variants = [(program, jobs) for program in programs for jobs in sorted({1, arguments.jobs})]
    rates, outside = {variant: [] for variant in variants}, {variant: [] for variant in variants}
    for turn in range(arguments.turns):
        write_manifest(manifest, arguments.bodies, 1 + arguments.bodies * turn, options, each)
        for number, (program, jobs) in enumerate(variants):
            took, log, _ = run(program, manifest, f"{arguments.folder}/turn{turn}-{number}", jobs)
            rates[program, jobs].append(3600 * len(log) / took)
            outside[program, jobs].append(outside_percent(took, log, jobs, share))
    for program, jobs in variants:
        print(f"{program}, {jobs} side by side: {statistics.median(rates[program, jobs]):.0f} jobs an hour (median of "
              f"{arguments.turns} turns); outside of fits and drapes "
              + ", ".join(f"{percent:.2f}" for percent in sorted(outside[program, jobs])) + " %")
    for program in programs:
        ratios = sorted(b / a for a, b in zip(rates[program, 1], rates[program, arguments.jobs]))
        print(f"{program}, {arguments.jobs} side by side against 1, turn by turn: "
              + ", ".join(f"{ratio:.2f}" for ratio in ratios))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("--bodies", type=int, help="default: 1000, or 20 a turn")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--job", default="{}", help="more names of each job, as '{\"frames\": 30}'")
    parser.add_argument("--each", default=TWO_GARMENTS, help="names and lists of values, as '{\"fabric\": [\"silk\"]}'")
    parser.add_argument("--turns", type=int, default=0)
    parser.add_argument("--against", help="another program, for turns")
    arguments = parser.parse_args()
    arguments.bodies = arguments.bodies or (20 if arguments.turns else 1000)
    os.makedirs(arguments.folder, exist_ok=True)
    options, manifest = json.loads(arguments.job), arguments.folder + "/jobs.jsonl"
    each = json.loads(arguments.each)
    share = math.prod(len(values) for values in each.values())
    if arguments.turns:
        take_turns(arguments, manifest, options, each, share)
        return
    write_manifest(manifest, arguments.bodies, 1, options, each)
    took, log, samples = run(arguments.program, manifest, arguments.folder + "/out", arguments.jobs)
    report(took, log, samples, arguments.jobs, share, arguments.folder)


if __name__ == "__main__":
    main()
