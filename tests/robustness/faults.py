#!/usr/bin/env python3
"""Kills the program at random moments while it writes and relaxes, and fills its disk: files stay whole.

usage: faults.py PROGRAM [--kills N] [--relaxation-kills N] [--seed S]
As root it also tries a full disk of its own.
"""
import argparse
import os
import random
import signal
import subprocess
import sys
import time

from program import Folder, run


def contents(path):
    with open(path, 'rb') as file:
        return file.read()


def kill_while_writing(program, options):
    """Writes one of two meshes over the other and is killed: the file is one of them, whole."""
    rng = random.Random(options.seed)
    signals = [signal.SIGKILL, signal.SIGTERM, signal.SIGINT]
    torn = left = changed = 0
    with Folder() as folder:
        path = os.path.join(folder, 'a.off')
        commands = [[program, 'shape', shape, path, '--edge', '0.05'] for shape in ('sphere', 'torus')]
        versions, longest = [], 0.0
        for command in commands:
            begin = time.monotonic()
            subprocess.run(command, check=True, capture_output=True)
            longest = max(longest, time.monotonic() - begin)
            versions.append(contents(path))
        for k in range(options.kills):
            before = contents(path)
            child = subprocess.Popen(commands[k % 2], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(rng.uniform(0.0, 1.2 * longest))
            child.send_signal(rng.choice(signals))
            child.wait()
            after = contents(path)
            torn += after not in versions
            changed += after != before
            left += len(os.listdir(folder)) - 1
            for name in os.listdir(folder):
                if name != 'a.off':
                    os.remove(os.path.join(folder, name))
    print(f'{options.kills} kills: {torn} torn files, {changed} times the new file, else the old one; '
          f'{left} unfinished files left behind')
    return torn == 0


def kill_while_relaxing(program, options):
    """Relaxes again and again with kill -9 in between: every file is whole, the end is the same."""
    rng = random.Random(options.seed)
    with Folder() as folder:
        mesh, whole, killed = (os.path.join(folder, name) for name in ('a.off', 'whole', 'killed'))
        subprocess.run([program, 'shape', 'sphere', mesh, '--edge', '0.1'], check=True, capture_output=True)

        def command(name):
            return [program, 'relax', mesh, '-o', name + '.extxyz', '--trajectory', name + '.trajectory.extxyz',
                    '--every', '5', '--checkpoint-every', '10', '--digits', '17', '--quiet']
        begin = time.monotonic()
        subprocess.run(command(whole), check=True, capture_output=True)
        longest = time.monotonic() - begin
        kills = finished = torn = 0
        while kills < options.relaxation_kills:
            child = subprocess.Popen(command(killed), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(rng.uniform(0.0, longest))
            child.send_signal(signal.SIGKILL)
            kills += 1
            is_done = child.wait() == 0
            finished += is_done
            for ending in ('.extxyz', '.trajectory.extxyz'):
                if os.path.exists(killed + ending):
                    torn += contents(killed + ending) != contents(whole + ending)
                    if is_done:
                        os.remove(killed + ending)
        subprocess.run(command(killed), check=True, capture_output=True)
        same = all(contents(killed + ending) == contents(whole + ending) for ending in ('.extxyz', '.trajectory.extxyz'))
        print(f'{kills} kills while relaxing: {finished} runs came through, {torn} files were not those of an '
              f'uninterrupted run; the last run {"ends in the same bytes" if same else "ENDS DIFFERENTLY"}')
        return torn == 0 and same


def fill_disk(program):
    """Builds into a full tmpfs: exit code 1, a reason, the old file whole and nothing else there."""
    with Folder() as folder:
        mounted = subprocess.run(['mount', '-t', 'tmpfs', '-o', 'size=300k', 'tmpfs', folder], capture_output=True)
        if mounted.returncode:
            print('full disk: not tried, only root may mount one')
            return True
        try:
            old = os.path.join(folder, 'surface.off')
            with open(old, 'w') as file:
                file.write('old\n')
            done = run(program, ['build', 'sphere', '-o', folder, '--atoms', 20000, '--method', 'paper', '--quiet'])
            names = os.listdir(folder)
            good = (done.exit_code == 1 and 'No space left' in done.refusal and not done.faults
                    and names == ['surface.off'] and open(old).read() == 'old\n')
            print(f'full disk: exit code {done.exit_code}, "{done.refusal}", left: {names}: {"good" if good else "BAD"}')
            return good
        finally:
            subprocess.run(['umount', folder], check=True)


def read_only_folder(program):
    """Nobody may write into /proc/self, not even root."""
    done = run(program, ['shape', 'sphere', '/proc/self/a.off'])
    good = done.exit_code == 1 and bool(done.refusal) and not done.faults
    print(f'read-only folder: exit code {done.exit_code}, "{done.refusal}": {"good" if good else "BAD"}')
    return good


def vanished_folder(program):
    """The folder goes away between the check and the writing."""
    with Folder() as folder:
        out = os.path.join(folder, 'out')
        os.mkdir(out)
        child = subprocess.Popen([program, 'remesh', '-', os.path.join(out, 'a.off'), '--edge', '0.3'], stdin=subprocess.PIPE,
                                 stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        time.sleep(0.5)
        os.rmdir(out)
        tetrahedron = 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n'
        _, err = child.communicate(tetrahedron, timeout=60)
        good = child.returncode in (1, 2) and 'trivalent: ' in err
        print(f'vanished folder: exit code {child.returncode}, {err.strip().splitlines()[-1:]}: {"good" if good else "BAD"}')
        return good


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('program')
    parser.add_argument('--kills', type=int, default=1000)
    parser.add_argument('--relaxation-kills', type=int, default=100)
    parser.add_argument('--seed', type=int, default=1)
    options = parser.parse_args()
    results = [fill_disk(options.program), read_only_folder(options.program), vanished_folder(options.program),
               kill_while_relaxing(options.program, options), kill_while_writing(options.program, options)]
    return 0 if all(results) else 1


if __name__ == '__main__':
    sys.exit(main())
