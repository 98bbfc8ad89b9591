"""60 jobs on Dask with two workers, of which one is killed: every result is there once, and equal to the bit to that of
a run without a scheduler."""
import os
import signal
import subprocess
import sys
import threading

from distributed import LocalCluster

from cluster_check import EXAMPLES, JOBS, PROGRAM, begin, check, compare, end, results, wait_until

SCRATCH = sys.argv[2]


def main():
    begin(SCRATCH)
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        command = [sys.executable, EXAMPLES + "/dask_batch.py", "jobs.jsonl", "out", "--shards", "20", "--scheduler",
                   cluster.scheduler_address, "--program", PROGRAM, "--retry", "1"]
        batch = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
        lines = []
        reader = threading.Thread(target=lambda: lines.extend(batch.stderr))
        reader.start()
        wait_until(lambda: len(results("out")) >= 12, "twelve results")
        victim = list(cluster.workers.values())[0].pid
        os.kill(victim, signal.SIGKILL)
        print(f"worker {victim} killed at {len(results('out'))} results", flush=True)
        check(batch.wait(300) == 0, "dask_batch.py failed")
        reader.join()
        check(f"20 of 20 shards ended\n" in lines, f"Dask: {''.join(lines[-5:])}")
    compare("out")
    check(JOBS == len(results("out")), "results")


if __name__ == "__main__":  # Dask starts its workers by reading this file again
    main()
    end()
