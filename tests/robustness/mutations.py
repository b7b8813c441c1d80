#!/usr/bin/env python3
"""Damages meshes in every way that files get damaged, and feeds them to `inspect` and `build`.

usage: mutations.py PROGRAM FOLDER [--files N] [--first K] [--seed S] [--atoms N] [--largest BYTES] [--keep FOLDER]
       [--build-options ...]   default: --method paper
Ends with 1 if anything crashed, hung, leaked, made an invalid shell or was refused without a place.
"""
import argparse
import os
import random
import re
import shutil
import sys

from program import Folder, build, run

# A refusal of a file must say where: a line, byte or element, what was declared, or what the whole is.
PLACE = re.compile(r'line \d+|byte \d+|(face|triangle|vertex|point|edge|corner)s? \d+|declares \d+|holds|empty|too short|'
                   r'extension|no faces|diagonal|area|component|too small|wrap|atoms|not an OFF')


def truncate(data, rng):
    return data[:rng.randrange(len(data))]


def flip_bytes(data, rng):
    damaged = bytearray(data)
    for _ in range(rng.choice([1, 3, 30])):
        damaged[rng.randrange(len(damaged))] = rng.randrange(256)
    return bytes(damaged)


def change_lines(data, rng, change):
    """Applies change(lines) to the lines of a text after its first two."""
    lines = data.split(b'\n')
    body = lines[2:]
    change(body)
    return b'\n'.join(lines[:2] + body)


def scale(data, rng):
    factor = rng.choice([1e-12, 1e12, 1e-150, 1e150])

    def scaled(lines):
        for i, line in enumerate(lines):
            words = line.split()
            if len(words) == 3 and not words[0] == b'3':
                try:
                    lines[i] = b' '.join(repr(factor * float(word)).encode() for word in words)
                except ValueError:
                    pass
    return change_lines(data, rng, scaled)


def put_nan(data, rng):
    def put(lines):
        i = rng.randrange(len(lines))
        words = lines[i].split()
        if words:
            words[rng.randrange(len(words))] = rng.choice([b'nan', b'inf', b'-1', b'1e999', b'99999999999', b'0x10', b''])
            lines[i] = b' '.join(words)
    return change_lines(data, rng, put)


def duplicate(data, rng):
    """Repeats faces in the place of others, so that the counts still hold."""
    def repeat(lines):
        faces = [i for i, line in enumerate(lines) if line[:2] == b'3 ']
        for _ in range(min(len(faces), rng.choice([1, 20]))):
            lines[rng.choice(faces)] = lines[rng.choice(faces)]
    return change_lines(data, rng, repeat)


def reverse(data, rng):
    def turn(lines):
        for i, line in enumerate(lines):
            words = line.split()
            if words[:1] == [b'3'] and rng.random() < 0.2:
                lines[i] = b' '.join([words[0], *reversed(words[1:4])])
    return change_lines(data, rng, turn)


def delete_faces(data, rng):
    """Takes faces away and corrects the count."""
    lines = data.split(b'\n')
    share = rng.choice([0.01, 0.3, 0.95])
    body = [line for line in lines[2:] if not (line[:2] == b'3 ' and rng.random() < share)]
    counts = lines[1].split()
    if len(counts) >= 2 and counts[1].isdigit():
        counts[1] = str(int(counts[1]) - (len(lines) - 2 - len(body))).encode()
        lines[1] = b' '.join(counts)
    return b'\n'.join(lines[:2] + body)


def swap_points(data, rng):
    """Lets faces refer to other points, which makes them cross and share edges."""
    def swap(lines):
        faces = [i for i, line in enumerate(lines) if line[:2] == b'3 ']
        for _ in range(min(len(faces), rng.choice([1, 10]))):
            a, b = rng.choice(faces), rng.choice(faces)
            one, other = lines[a].split(), lines[b].split()
            if len(one) > 3 and len(other) > 3:
                one[1] = other[1]
                lines[a] = b' '.join(one)
    return change_lines(data, rng, swap)


def collapse_points(data, rng):
    """Moves points onto others: flat faces and coincident points."""
    def collapse(lines):
        points = [i for i, line in enumerate(lines) if len(line.split()) == 3]
        for _ in range(min(len(points), rng.choice([1, 50]))):
            lines[rng.choice(points)] = lines[rng.choice(points)]
    return change_lines(data, rng, collapse)


MUTATIONS = [truncate, flip_bytes, scale, put_nan, duplicate, reverse, delete_faces, swap_points, collapse_points]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('program')
    parser.add_argument('folder')
    parser.add_argument('--files', type=int, default=2000)
    parser.add_argument('--first', type=int, default=0)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--atoms', type=int, default=500)
    parser.add_argument('--largest', type=int, default=60000)
    parser.add_argument('--keep', help='where files that show a fault are kept')
    parser.add_argument('--build-options', nargs=argparse.REMAINDER, default=['--method', 'paper'])
    options = parser.parse_args()
    names = [n for n in sorted(os.listdir(options.folder))
             if os.path.getsize(os.path.join(options.folder, n)) <= options.largest]
    tally, faults = {}, 0
    for k in range(options.first, options.files):
        rng = random.Random(1000003 * options.seed + k)
        name, mutation = rng.choice(names), MUTATIONS[k % len(MUTATIONS)]
        with open(os.path.join(options.folder, name), 'rb') as file:
            damaged = mutation(file.read(), rng)
        with Folder() as folder:
            path = os.path.join(folder, name)
            with open(path, 'wb') as file:
                file.write(damaged)
            looked = run(options.program, ['inspect', path, '--json', '--quiet'], expected=(0, 1, 3))
            built, report = build(options.program, path, ['--atoms', options.atoms, *options.build_options])
            found = looked.faults + built.faults
            if built.refusal and not PLACE.search(built.refusal):
                found.append('refuses without a place: ' + built.refusal)
            if looked.exit_code == 3 and report:
                found.append('inspect calls hopeless what build builds')
            if looked.exit_code == 0 and not report and 'too small' not in built.refusal:
                found.append('inspect calls sound what build refuses: ' + built.refusal)
            outcome = 'FAULT' if found else 'shell' if report else 'refused'
            key = (mutation.__name__, outcome)
            tally[key] = tally.get(key, 0) + 1
            if found:
                faults += 1
                print(k, name, mutation.__name__, found, flush=True)
                if options.keep:
                    os.makedirs(options.keep, exist_ok=True)
                    shutil.copy(path, os.path.join(options.keep, f'{k}-{name}'))
        if (k + 1) % 100 == 0:
            print(f'{k + 1} files, {faults} with faults', flush=True)
    for mutation in MUTATIONS:
        row = {o: tally.get((mutation.__name__, o), 0) for o in ('shell', 'refused', 'FAULT')}
        print(f'{mutation.__name__:16}', row)
    return 1 if faults else 0


if __name__ == '__main__':
    sys.exit(main())
