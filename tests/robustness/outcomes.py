#!/usr/bin/env python3
"""Takes every mesh of a folder through `inspect` and `build` and makes a table of what came out.

usage: outcomes.py PROGRAM FOLDER RECORDS.json [--columns inspect paper crystal wrap] [--table TABLE.md]
       [--atoms N] [--jobs N] [--wrap all|crossing|refused] [--build-options ...]
The records are kept after every mesh: a run that was interrupted goes on where it was, and columns, or parts of one, can be
made by different programs, such as one with sanitizers, with different options. The table tells which.
Wraps are slow; they can be left to meshes whose other shells cross themselves, or that are refused otherwise.
Ends with 1 if anything crashed, hung, leaked, was lost silently or made an invalid shell.
"""
import argparse
import json
import os
import re
import sys
from collections import Counter
from concurrent.futures import ThreadPoolExecutor

from program import build, run, sanitized

COLUMNS = {'inspect': '`inspect`', 'paper': '`--method paper`', 'crystal': 'by default', 'wrap': '`--repair wrap`'}

HOW = {'paper': 'with `--method paper`', 'crystal': 'by default', 'wrap': 'with `--repair wrap`'}


def count_triangles(path):
    """Triangles that an OFF file stands for, or None for another kind of file."""
    with open(path, 'rb') as file:
        words = re.sub(rb'#[^\n]*', b'', file.read()).split()
    if not words or words[0] != b'OFF':
        return None
    n_faces = int(words[2])
    lines = [line.split(b'#')[0].split() for line in open(path, 'rb')]
    lines = [line for line in lines if line]
    rows = lines[-n_faces:] if n_faces else []
    if not all(row[0].isdigit() and len(row) > int(row[0]) for row in rows):
        return None
    return sum(int(row[0]) - 2 for row in rows)


def lost_silently(path, inspected):
    expected = count_triangles(path)
    if expected is None or expected == inspected['faces']:
        return []
    said = ' '.join(inspected['notes'])
    if 'dropped' in said or 'merged' in said or 'after the last face' in said:
        return []
    return [f'the file stands for {expected} triangles, {inspected["faces"]} were read, and nothing is said']


def inspect(options, path):
    looked = run(options.program, ['inspect', path, '--json', '--quiet'], expected=(0, 1, 3))
    inspected = looked.json if looked.out and not looked.faults else {}
    if inspected.get('faces') is not None:
        looked.faults += lost_silently(path, inspected)
    problems = [f'{p["count"]} {p["problem"]}' for p in inspected.get('problems', [])]
    return {'faults': looked.faults, 'triangles': inspected.get('faces', 0),
            'text': '; '.join([inspected.get('verdict', 'unreadable'), *problems])}


def record_of_build(done, report, remark=''):
    """What a build came to; `crossings` only if it gave a shell."""
    if done.faults or report is None:
        return {'faults': done.faults, 'text': 'refused: ' + re.sub(r'\S*/', '', done.refusal)}
    quality, distance = report['quality'], report['distance']
    text = f'{report["network"]["atoms"]} atoms'
    text += f', open ({quality["boundary_loops"]})' if quality['boundary_loops'] else ', closed'
    if quality['components'] > 1:
        text += f', {quality["components"]} parts'
    if quality['self_intersections'] > 0:
        text += f', {quality["self_intersections"]} crossings'
    text += f', {100 * distance["from_original"]["max"] / distance["diagonal"]:.1f} %'
    return {'faults': [], 'crossings': quality['self_intersections'], 'certified': report.get('certified'),
            'text': remark + text + (', certified' if report.get('certified') else '')}


def wrap(options, path, size):
    """Wraps; if crumbs are too small for a shell, only the largest part."""
    wrapped, report = build(options.program, path, [*size, '--method', 'paper', '--repair', 'wrap'])
    if 'components are too small' not in wrapped.refusal:
        return record_of_build(wrapped, report)
    return record_of_build(*build(options.program, path, [*size, '--method', 'paper', '--repair', 'wrap',
                                                          '--components', 'largest']), 'largest part: ')


def is_wrap_wanted(record, which):
    others = [record[column] for column in ('paper', 'crystal') if column in record]
    shells = [other for other in others if 'crossings' in other]
    return which == 'all' or not shells or (which == 'crossing' and all(shell['crossings'] for shell in shells))


def look_at(path, column, record, options):
    """What one mesh gives in one column of the table."""
    size = ['--atoms', options.atoms, *options.build_options]
    if column == 'inspect':
        return inspect(options, path)
    if column == 'wrap':
        if not is_wrap_wanted(record, options.wrap):
            return {'faults': [], 'text': 'not tried'}
        return wrap(options, path, size)
    return record_of_build(*build(options.program, path, [*size, '--method', column], certify=column == 'crystal'))


def read_records(path):
    if not os.path.exists(path):
        return {}
    with open(path) as file:
        return json.load(file)


def write_records(path, records):
    with open(path + '.new', 'w') as file:
        json.dump(records, file, indent=1)
    os.replace(path + '.new', path)


def fill_column(column, records, options):
    """Fills the column for the meshes that do not have it yet."""
    names = [name for name in sorted(os.listdir(options.folder)) if column not in records.setdefault(name, {})]
    words = ['with address and undefined-behaviour sanitizers' if sanitized(options.program) else 'as released']
    if column != 'inspect':
        words += [f'`--atoms {options.atoms}`', *[f'`{option}`' for option in options.build_options]]

    def look(name):
        return look_at(os.path.join(options.folder, name), column, records[name], options)

    with ThreadPoolExecutor(options.jobs) as pool:
        for name, result in zip(names, pool.map(look, names)):
            records[name][column] = {**result, 'how': ', '.join(words)}
            print(column, name, result['text'], *result['faults'], sep=' | ', flush=True)
            write_records(options.records, records)


def summary(records):
    """Counts over all meshes, in words, and the number of faults."""
    meshes = records.values()
    faults = sum(len(result['faults']) for record in meshes for result in record.values())
    triangles = [record for record in meshes if record.get('inspect', {}).get('triangles')]

    def count(is_good, columns):
        return sum(any('crossings' in record.get(c, {}) and is_good(record[c]) for c in columns) for record in triangles)

    builds = ('paper', 'crystal', 'wrap')
    words = [f'{len(meshes)} files, {len(triangles)} with faces']
    for column in builds:
        tried = sum(column in record for record in triangles)
        words.append(f'{count(lambda _: True, [column])} of {tried} tried give a shell {HOW[column]}')
    any_shell = count(lambda _: True, builds)
    words.append(f'{any_shell} ({100 * any_shell / max(1, len(triangles)):.1f} %) with some method or `--repair`')
    words.append(f'{count(lambda shell: not shell["crossings"], builds)} one without crossings')
    words.append(f'{count(lambda shell: shell["certified"], ["crystal"])} one by default that `check` certifies')
    words.append(f'{faults} crashes, hangs, leaks, silent losses or invalid shells')
    return '; '.join(words), faults


def cell(record, column):
    if column not in record:
        return '-'
    return ' '.join([record[column]['text'], *['FAULT: ' + fault for fault in record[column]['faults']]])


def write_table(path, records):
    ways = Counter((c, record[c]['how']) for record in records.values() for c in COLUMNS if c in record)
    programs = '\n'.join(f'- {COLUMNS[column]}: {count} files {how}' for (column, how), count in sorted(ways.items()))
    with open(path, 'w') as table:
        table.write(f'''# What becomes of the meshes of libcgal-demo

Made by `tests/robustness/outcomes.py` from the meshes of Debian's package libcgal-demo. Every shell was checked by
reading it back: an oriented manifold, every atom with three bonds and Σ(6 − ring size) = 6χ where it is closed.
Crossings are pairs of triangles of the shell that intersect. The percentage is the largest distance from the input to
the shell, of the input's diagonal. "Certified" is a shell whose relaxed atoms pass `trivalent check`, which also wants
ordinary bonds and angles: many of these shapes have parts too thin for carbon at this size. A dash: not tried.

{summary(records)[0]}.

The program, by column:
{programs}

| file | triangles | {' | '.join(COLUMNS.values())} |
|{'---|' * (len(COLUMNS) + 2)}
''')
        for name, record in sorted(records.items()):
            triangles = record.get('inspect', {}).get('triangles') or '-'
            table.write(f'| {name} | {triangles} | ' + ' | '.join(cell(record, c) for c in COLUMNS) + ' |\n')


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('program')
    parser.add_argument('folder')
    parser.add_argument('records')
    parser.add_argument('--columns', nargs='*', choices=list(COLUMNS), default=list(COLUMNS))
    parser.add_argument('--table')
    parser.add_argument('--atoms', type=int, default=5000)
    parser.add_argument('--wrap', choices=['all', 'crossing', 'refused'], default='all')
    parser.add_argument('--build-options', nargs=argparse.REMAINDER, default=[])
    parser.add_argument('--jobs', type=int, default=1)
    options = parser.parse_args()
    records = read_records(options.records)
    for column in options.columns:
        fill_column(column, records, options)
    words, faults = summary(records)
    print(words)
    if options.table:
        write_table(options.table, records)
    return 1 if faults else 0


if __name__ == '__main__':
    sys.exit(main())
