"""60 jobs as an array on a Slurm of two nodes on this machine. One node is killed with all that runs on it and brought
back; the batch goes on; every result is there once, and equal to the bit to that of a run without a scheduler."""
import os
import signal
import socket
import subprocess
import sys
import time

from cluster_check import EXAMPLES, JOBS, PROGRAM, begin, check, compare, end, results, wait_until

SCRATCH = sys.argv[2]
CONF = """
ClusterName=bodice
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
AuthInfo=socket={at}/munge.socket
SlurmctldPort={port}
StateSaveLocation={at}/state
SlurmdSpoolDir={at}/spool-%n
SlurmctldPidFile={at}/slurmctld.pid
SlurmdPidFile={at}/slurmd-%n.pid
SlurmctldLogFile={at}/slurmctld.log
SlurmdLogFile={at}/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
ReturnToService=2
SlurmdTimeout=10
KillWait=5
MinJobAge=3000
SlurmdParameters=config_overrides
NodeName=n1 NodeHostname={host} NodeAddr=127.0.0.1 Port={port1} CPUs=1 RealMemory=2000
NodeName=n2 NodeHostname={host} NodeAddr=127.0.0.1 Port={port2} CPUs=1 RealMemory=2000
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
"""


class Cluster:
    """munged, slurmctld and two slurmd; all files in one folder."""

    def __init__(self, folder):
        self.at = folder
        self.daemons = {}
        for name in ("", "/state", "/spool-n1", "/spool-n2"):
            os.makedirs(folder + name, exist_ok=True)
        free = [socket.socket() for _ in range(3)]
        for each in free:
            each.bind(("127.0.0.1", 0))
        ports = [each.getsockname()[1] for each in free]
        for each in free:
            each.close()
        with open(folder + "/slurm.conf", "w") as conf:
            conf.write(CONF.format(host=socket.gethostname(), at=folder, port=ports[0], port1=ports[1], port2=ports[2]))
        with open(folder + "/munge.key", "wb") as key:
            key.write(os.urandom(128))
        os.chmod(folder + "/munge.key", 0o400)
        self.env = {**os.environ, "SLURM_CONF": folder + "/slurm.conf", "BODICE": PROGRAM}
        self.start("munged", "-F", "--force", *(f"--{name}={folder}/{file}" for name, file in (
            ("socket", "munge.socket"), ("key-file", "munge.key"), ("pid-file", "munged.pid"),
            ("log-file", "munged.log"), ("seed-file", "munged.seed"))))
        wait_until(lambda: os.path.exists(folder + "/munge.socket"), "munged")
        self.start("slurmctld", "-D")
        self.start_node("n1"), self.start_node("n2")
        wait_until(lambda: self.states() == {"n1": "idle", "n2": "idle"}, "two idle nodes")

    def start(self, *command, name=None):
        log = open(f"{self.at}/{name or command[0]}.out", "a")
        self.daemons[name or command[0]] = subprocess.Popen(command, env=self.env, stdout=log, stderr=log)

    def start_node(self, node):
        self.start("slurmd", "-D", "-N", node, name=node)

    def run(self, *command):
        return subprocess.run(command, env=self.env, capture_output=True, text=True, timeout=60).stdout

    def states(self):
        return dict(line.split() for line in self.run("sinfo", "-N", "-h", "-o", "%N %T").splitlines())

    def processes_of(self, node):
        """Steps of the node's jobs and what they started, by the environment that Slurm gives them."""
        found = []
        for process in filter(str.isdigit, os.listdir("/proc")):
            try:
                words = open(f"/proc/{process}/environ", "rb").read().split(b"\0")
            except OSError:
                continue
            if f"SLURM_CONF={self.at}/slurm.conf".encode() in words and f"SLURMD_NODENAME={node}".encode() in words:
                found.append(int(process))
        return found

    def steps_of(self, node):
        """The step daemons above those processes."""
        parents = set()
        for process in self.processes_of(node):
            try:
                parent = int(open(f"/proc/{process}/stat").read().rsplit(")", 1)[1].split()[1])
                if "slurmstepd" in open(f"/proc/{parent}/comm").read():
                    parents.add(parent)
            except OSError:
                continue
        return list(parents)

    def kill_node(self, node):
        """As if its power failed: the daemon, the steps and the jobs, at once."""
        victims = self.steps_of(node) + self.processes_of(node)
        self.daemons[node].kill()
        self.daemons[node].wait()
        for victim in victims:
            try:
                os.kill(victim, signal.SIGKILL)
            except ProcessLookupError:
                pass
        return len(victims)

    def idle(self):
        return self.run("squeue", "-h").strip() == ""

    def stop(self):
        self.run("scancel", "--user=root")
        for daemon in reversed(self.daemons.values()):
            daemon.terminate()
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                daemon.kill()


def submit(cluster):
    done = subprocess.run(["bash", EXAMPLES + "/slurm.sh", "jobs.jsonl", "out", str(JOBS), "--mem-per-cpu=1000M"],
                          env=cluster.env, capture_output=True, text=True, timeout=60)
    check(done.returncode == 0, f"slurm.sh: {done.stderr}")
    print(done.stdout.strip(), flush=True)


begin(SCRATCH)
cluster = Cluster(SCRATCH + "/slurm")
try:
    submit(cluster)
    wait_until(lambda: len(results("out")) >= 12 and cluster.processes_of("n2"), "twelve results")
    killed = cluster.kill_node("n2")
    check(killed > 0, "nothing ran on the node that was killed")
    print(f"node n2 killed with {killed} processes, at {len(results('out'))} results", flush=True)
    wait_until(lambda: not cluster.states()["n2"].startswith(("idle", "alloc", "mixed")), "the node counts as down")
    print(f"Slurm: n2 is {cluster.states()['n2']}", flush=True)
    cluster.start_node("n2")
    wait_until(lambda: cluster.states()["n2"].startswith(("idle", "alloc", "mixed")), "the node is back")
    wait_until(lambda: cluster.processes_of("n2") or cluster.idle(), "work on the node that is back")
    wait_until(cluster.idle, "the end of the array")
    first = len(results("out"))
    print(f"{first} results when the array had ended", flush=True)
    submit(cluster)  # goes on, and computes nothing that is there
    before = {folder: os.path.getmtime(folder) for folder in results("out").values()}
    wait_until(cluster.idle, "the end of the second array")
    check(all(os.path.getmtime(folder) == time for folder, time in before.items()), "a result was computed again")
    compare("out")
finally:
    cluster.stop()
end()
