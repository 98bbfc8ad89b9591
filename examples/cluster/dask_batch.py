"""Runs a batch on Dask: a task a shard, and a summary when all have ended.

    python3 examples/cluster/dask_batch.py MANIFEST OUT [--shards N] [--scheduler ADDRESS] [OPTION OF BATCH...]

Run it again to go on: results that are there are skipped. Without --scheduler it starts a cluster on this machine.
MANIFEST and OUT are on a disk that all workers see. The shard of a worker that dies goes to another one, which skips
what the first has done. A task takes one thread of a worker: start workers with as many threads as they have cores.
"""
import argparse
import os
import shutil
import subprocess
import sys


def run_shard(program, manifest, out, shard, options):
    """One shard in a process of the program. A task takes one thread of its worker, and so one core."""
    # This function travels to the worker alone, and brings its own imports.
    import shutil
    import subprocess

    command = [program, "batch", manifest, "--out", out, "--shard", shard]
    if "--jobs" not in options:
        command += ["--jobs", "1"]
    if shutil.which("setpriv"):  # a worker that is killed takes its program along
        command = ["setpriv", "--pdeathsig", "KILL", *command]
    done = subprocess.run(command + options, capture_output=True, text=True)
    return done.returncode, done.stderr[-2000:]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("manifest")
    parser.add_argument("out")
    parser.add_argument("--shards", type=int, default=100, help="parts of the manifest (100)")
    parser.add_argument("--scheduler", help="address of a running scheduler, as tcp://host:8786")
    parser.add_argument("--program", default=os.environ.get("BODICE", "bodice"), help="the program (BODICE, or bodice)")
    arguments, options = parser.parse_known_args()

    from distributed import Client, LocalCluster, as_completed
    cluster = None if arguments.scheduler else LocalCluster(threads_per_worker=1, dashboard_address=None)
    with Client(arguments.scheduler or cluster) as client:
        manifest, out = os.path.abspath(arguments.manifest), os.path.abspath(arguments.out)
        program = shutil.which(arguments.program) or parser.error(f"there is no program {arguments.program}")
        program = os.path.abspath(program)  # workers have other folders
        # A worker that dies three times over one shard is no accident; its other shards go on.
        tasks = [client.submit(run_shard, program, manifest, out, f"{i}/{arguments.shards}", options,
                               pure=False, retries=3) for i in range(arguments.shards)]
        ended = 0
        for task in as_completed(tasks):
            ended += 1
            if task.status == "error":
                print(f"a shard was lost: {task.exception()!r}", file=sys.stderr)
            elif task.result()[0] != 0:
                print(task.result()[1], end="", file=sys.stderr)
            print(f"{ended} of {arguments.shards} shards ended", file=sys.stderr)
    if cluster:
        cluster.close()
    return subprocess.run([program, "batch", "--summary", out]).returncode


if __name__ == "__main__":
    sys.exit(main())
