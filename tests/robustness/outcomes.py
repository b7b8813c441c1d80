#!/usr/bin/env python3
"""Takes every mesh of a folder through `inspect` and `build` and writes a table of what came out.

usage: outcomes.py PROGRAM FOLDER TABLE.md [--atoms N] [--jobs N] [--wrap all|crossing|refused]
       [--wrap-program PROGRAM]
Wraps are slow; they can be left to meshes whose shell crosses itself, or that are refused, by default. The second program, if given,
does the wraps, for example one without sanitizers.
Ends with 1 if anything crashed, hung, leaked, was lost silently or made an invalid shell.
"""
import argparse
import os
import re
import sys
from concurrent.futures import ThreadPoolExecutor

from program import build, run


def count_triangles(path):
    """Triangles that an OFF file stands for, or None for another kind of file."""
    with open(path, 'rb') as file:
        words = re.sub(rb'#[^\n]*', b'', file.read()).split()
    if not words or not words[0].endswith(b'OFF') or words[0] != b'OFF':
        return None
    n_points, n_faces = int(words[1]), int(words[2])
    lines = [line.split(b'#')[0].split() for line in open(path, 'rb')]
    lines = [line for line in lines if line]
    rows = lines[-n_faces:] if n_faces else []
    if any(len(row) < int(row[0]) + 1 for row in rows if row[0].isdigit()):
        return None
    return sum(int(row[0]) - 2 for row in rows) if all(row[0].isdigit() for row in rows) else None


def lost_silently(path, inspected):
    expected = count_triangles(path)
    if expected is None or expected == inspected['faces']:
        return []
    said = ' '.join(inspected['notes'])
    if 'dropped' in said or 'merged' in said or 'after the last face' in said:
        return []
    return [f'the file stands for {expected} triangles, {inspected["faces"]} were read, and nothing is said']


def shell_text(done, report):
    if done is None:
        return 'not tried'
    if done.faults:
        return 'FAULT: ' + '; '.join(done.faults)
    if report is None:
        return 'refused: ' + re.sub(r'\S*/', '', done.refusal)
    quality = report['quality']
    kind = 'closed' if quality['boundary_loops'] == 0 else f'open ({quality["boundary_loops"]})'
    text = f'{report["network"]["atoms"]} atoms, {kind}'
    if quality['components'] > 1:
        text += f', {quality["components"]} parts'
    if quality['self_intersections'] > 0:
        text += f', {quality["self_intersections"]} crossings'
    return text + f', {100 * report["distance"]["from_original"]["max"] / report["distance"]["diagonal"]:.1f} %'


def problems_text(inspected):
    return '; '.join(f'{p["count"]} {p["problem"]}' for p in inspected.get('problems', []))


def wrap(program, path, size):
    """Wraps; if crumbs are too small for a shell, only the largest part."""
    wrapped, report = build(program, path, [*size, '--repair', 'wrap'])
    if 'components are too small' not in wrapped.refusal:
        return wrapped, report, ''
    return *build(program, path, [*size, '--repair', 'wrap', '--components', 'largest']), 'largest part: '


def look_at(name, options, counts):
    """Inspects and builds on one mesh; its row of the table."""
    path, size = os.path.join(options.folder, name), ['--atoms', options.atoms]
    looked = run(options.program, ['inspect', path, '--json', '--quiet'], expected=(0, 1, 3))
    inspected = looked.json if looked.out else {}
    if inspected.get('faces') is not None:
        looked.faults += lost_silently(path, inspected)
    plain, plain_report = build(options.program, path, size)
    wrapped, wrapped_report, which = None, None, ''
    crosses = plain_report is not None and plain_report['quality']['self_intersections'] > 0
    if options.wrap == 'all' or plain_report is None or (crosses and options.wrap == 'crossing'):
        wrapped, wrapped_report, which = wrap(options.wrap_program or options.program, path, size)
    verdict = 'FAULT: ' + '; '.join(looked.faults) if looked.faults else inspected.get('verdict', '?')
    counts['faults'] += sum(len(done.faults) for done in (looked, plain, wrapped) if done)
    if inspected.get('faces'):
        good = [report for report in (plain_report, wrapped_report) if report]
        counts['triangles'] += 1
        counts['default'] += plain_report is not None
        counts['any'] += bool(good)
        counts['clean'] += any(report['quality']['self_intersections'] == 0 for report in good)
    cells = [name, inspected.get('faces', '-'), verdict, problems_text(inspected), shell_text(plain, plain_report),
             which + shell_text(wrapped, wrapped_report)]
    row = '| ' + ' | '.join(map(str, cells)) + ' |'
    print(row, flush=True)
    return row


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('program')
    parser.add_argument('folder')
    parser.add_argument('table')
    parser.add_argument('--atoms', type=int, default=5000)
    parser.add_argument('--wrap', choices=['all', 'crossing', 'refused'], default='all')
    parser.add_argument('--wrap-program')
    parser.add_argument('--jobs', type=int, default=1)
    options = parser.parse_args()
    names = sorted(os.listdir(options.folder))
    counts = dict.fromkeys(('faults', 'triangles', 'default', 'any', 'clean'), 0)
    with ThreadPoolExecutor(options.jobs) as pool:
        rows = list(pool.map(lambda name: look_at(name, options, counts), names))
    write_table(options, rows, counts)
    return 1 if counts['faults'] else 0


def write_table(options, rows, counts):
    with open(options.table, 'w') as table:
        table.write(f'''# What becomes of the meshes of libcgal-demo

Made by `tests/robustness/outcomes.py` with `build --atoms {options.atoms} --method paper`. Every shell was checked by
reading it back: an oriented manifold, every atom with three bonds and Σ(6 − ring size) = 6χ where it is closed.
Crossings are pairs of triangles of the shell that intersect. The percentage is the largest distance from the input to
the shell, of the input's diagonal.

{len(rows)} files, {counts['triangles']} with faces: {counts['default']} give a shell by default, {counts['any']} by default or
`--repair wrap` ({100 * counts['any'] / max(1, counts['triangles']):.1f} %), {counts['clean']} one without crossings; {counts['faults']} crashes, hangs, leaks, silent
losses or invalid shells.

| file | triangles | inspect | problems | by default | `--repair wrap` |
|---|---|---|---|---|---|
''')
        table.write('\n'.join(rows) + '\n')
    print(f'{len(rows)} files, {counts}')


if __name__ == '__main__':
    sys.exit(main())
