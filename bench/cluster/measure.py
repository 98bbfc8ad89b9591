"""How many jobs an hour does a batch of made bodies by two garments do, what does it spend outside of fits and drapes,
and does its memory stay flat?

    python3 bench/cluster/measure.py build/release/bodice FOLDER [--bodies 1000] [--jobs 2] [--job JSON] [--turns N]

Writes FOLDER/job_seconds.txt (seconds of a core, a job a line, its share of the fit included: what the simulation
draws from), memory.csv and memory.svg (all processes of the batch; what they share counts once), and prints the rest.
--turns N runs the first 20 bodies N times each with one job and with --jobs side by side, in turns: the throughput of
both, on a machine that others use as well.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import time

GARMENTS = ("skirt", "tunic")


def write_manifest(file, bodies, first, options):
    with open(file, "w", encoding="utf-8") as manifest:
        for seed in range(first, first + bodies):
            for garment in GARMENTS:
                manifest.write(json.dumps({"seed": seed, "garment": garment, **options}) + "\n")


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
    while batch.poll() is None:
        processes = descendants(batch.pid)
        samples.append((time.time() - begin, proportional_mb(processes), proportional_mb([batch.pid])))
        time.sleep(0.2 if len(samples) < 100 else 2.0)
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


def report(took, log, samples, jobs, folder):
    share = len(GARMENTS)
    cpu = [line["cpu_seconds"] + line["shared_cpu_seconds"] / share for line in log]
    inside = sum(line["numbers"]["drape_s"] + line["numbers"]["dress_s"] + line["shared_seconds"] / share for line in log)
    outside = sum(line["seconds"] for line in log) + sum(line["shared_seconds"] for line in log) / share - inside
    print(f"{len(log)} jobs, {jobs} side by side: {took:.0f} s, {3600 * len(log) / took:.0f} an hour")
    print(f"a job: {statistics.mean(cpu):.3f} s of a core with its share of the fit, {statistics.median(cpu):.3f} in the "
          f"median, {max(cpu):.3f} at most: {3600 / statistics.mean(cpu):.0f} jobs an hour a core")
    print(f"written and drawn: {100 * outside / (outside + inside):.2f} % of the jobs' time")
    print(f"between jobs: {100 * (1 - (inside + outside) / (jobs * took)):.2f} % of the time of {jobs} jobs side by side")
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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("--bodies", type=int, default=1000)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--job", default="{}", help="more names of each job, as '{\"frames\": 30}'")
    parser.add_argument("--turns", type=int, default=0)
    arguments = parser.parse_args()
    os.makedirs(arguments.folder, exist_ok=True)
    options, manifest = json.loads(arguments.job), arguments.folder + "/jobs.jsonl"
    if arguments.turns:
        rates = {1: [], arguments.jobs: []}
        for turn in range(arguments.turns):
            write_manifest(manifest, 20, 1 + 20 * turn, options)
            for jobs in rates:
                took, log, _ = run(arguments.program, manifest, f"{arguments.folder}/turn{turn}-{jobs}", jobs)
                rates[jobs].append(3600 * len(log) / took)
        ratios = [b / a for a, b in zip(*rates.values())]
        for jobs, each in rates.items():
            print(f"{jobs} side by side: {statistics.median(each):.0f} jobs an hour (median of {len(each)} turns)")
        print("ratio, turn by turn: " + ", ".join(f"{ratio:.2f}" for ratio in sorted(ratios)))
        return
    write_manifest(manifest, arguments.bodies, 1, options)
    took, log, samples = run(arguments.program, manifest, arguments.folder + "/out", arguments.jobs)
    report(took, log, samples, arguments.jobs, arguments.folder)


if __name__ == "__main__":
    main()
