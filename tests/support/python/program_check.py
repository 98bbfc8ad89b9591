"""What tests share that run the program and read its files back: a list of failures, and a run with its exit code."""
import os
import subprocess
import sys

PROGRAM = os.path.abspath(sys.argv[1])
failures = []


def check(good, what):
    if not good:
        failures.append(what)
        print("FAILED:", what)


def run(*arguments, code=0):
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=250)
    check(done.returncode == code, f"{' '.join(arguments)}: exit {done.returncode}, expected {code}\n{done.stderr}")
    return done.stdout + done.stderr
