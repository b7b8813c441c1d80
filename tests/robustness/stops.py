#!/usr/bin/env python3
"""Ends builds by SIGTERM at random moments, and measures how long they take to answer.

usage: stops.py PROGRAM [--moments N] [--limit SECONDS] [--seed S] [MESH...]
Without meshes, built-in shapes are taken. Prints a line for every build and the longest time.
Ends with 1 if an answer took longer than the limit, or left anything but whole results or nothing.
"""
import argparse
import os
import random
import signal
import subprocess
import sys
import time

from program import Folder

BUILDS = [['sphere', '--atoms', '60000'], ['torus', '--atoms', '20000'],
          ['open-tube', '--atoms', '20000', '--method', 'paper'],
          ['double-torus', '--atoms', '8000', '--effort', 'thorough'], ['sphere', '--atoms', '400000']]


def duration(command, most):
    """Seconds that a build takes, at most so many."""
    begin = time.monotonic()
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        child.wait(most)
    except subprocess.TimeoutExpired:
        child.kill()
        child.wait()
    return time.monotonic() - begin


def is_whole(folder):
    """Whether a folder of results is complete, or was never made."""
    return not os.path.exists(folder) or os.path.exists(os.path.join(folder, 'report.json'))


def stop(command, folder, moment):
    """Seconds from the signal to the end, and what was left; none if the build was done before."""
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        child.wait(moment)
        return None
    except subprocess.TimeoutExpired:
        pass
    begin = time.monotonic()
    child.send_signal(signal.SIGTERM)
    child.wait()
    left = 'results' if os.path.exists(folder) else 'nothing'
    return time.monotonic() - begin, left


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('program')
    parser.add_argument('meshes', nargs='*')
    parser.add_argument('--moments', type=int, default=20)
    parser.add_argument('--limit', type=float, default=3.0)
    parser.add_argument('--seed', type=int, default=1)
    options = parser.parse_args()
    rng = random.Random(options.seed)
    builds = [[os.path.abspath(mesh), '--atoms', '20000'] for mesh in options.meshes] or BUILDS
    longest, failed = 0.0, False
    for build in builds:
        answers = []
        with Folder() as root:
            command = [os.path.abspath(options.program), 'build', *build, '-o', os.path.join(root, 'timed')]
            whole = duration(command, 60.0)
            for k in range(options.moments):
                folder = os.path.join(root, f'out-{k}')
                answer = stop(command[:-1] + [folder], folder, rng.uniform(0.0, whole))
                if answer is None:
                    continue
                answers.append(answer)
                if not is_whole(folder):
                    print(f'{" ".join(build)}: left a part of its results')
                    failed = True
        times = [seconds for seconds, _ in answers]
        kept = sum(left == 'results' for _, left in answers)
        print(f'{" ".join(build)}: {len(answers)} stops, answered in {max(times, default=0.0):.2f} s at most, '
              f'{kept} with results, the others with nothing', flush=True)
        longest = max(longest, *times, 0.0)
    print(f'longest: {longest:.2f} s')
    return failed or longest > options.limit


if __name__ == '__main__':
    sys.exit(main())
