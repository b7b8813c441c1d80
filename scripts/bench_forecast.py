#!/usr/bin/env python3
"""Compares the processor time that `build --dry-run` forecasts with what the build takes.

usage: bench_forecast.py PROGRAM [--factor F] [--limit SECONDS] [MESH...]
Built-in shapes are always measured. Meshes are built at 4,000 atoms. Prints a line for every build
and the largest ratio; ends with 1 if a forecast is off by more than the factor.
"""
import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile

SHAPES = [['sphere', '--atoms', '500'], ['sphere', '--atoms', '4000'], ['sphere', '--atoms', '20000'],
          ['torus', '--atoms', '2000'], ['torus', '--atoms', '12000'], ['double-torus', '--atoms', '6000'],
          ['capsule', '--atoms', '3000'], ['open-tube', '--atoms', '4000'], ['wavy-sheet', '--atoms', '3000'],
          ['ellipsoid', '--atoms', '5000', '--effort', 'quick'], ['sphere', '--atoms', '20000', '--method', 'paper']]


def processor_seconds(command, limit):
    """Processor time of a program, or none if it fails or takes longer than the limit."""
    def stop_late():
        resource.setrlimit(resource.RLIMIT_CPU, (limit, limit))

    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, preexec_fn=stop_late)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return seconds if done.returncode == 0 else None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('program')
    parser.add_argument('meshes', nargs='*')
    parser.add_argument('--factor', type=float, default=2.0)
    parser.add_argument('--limit', type=int, default=600)
    options = parser.parse_args()
    builds = SHAPES + [[mesh, '--atoms', '4000'] for mesh in options.meshes]
    worst = 1.0
    for build in builds:
        command = [options.program, 'build', *build, '--threads', '1']
        planned = subprocess.run([*command, '--dry-run', '--json'], capture_output=True, text=True)
        if planned.returncode != 0:
            print(f'{" ".join(build)}: refused: {planned.stderr.strip()}')
            continue
        plan = json.loads(planned.stdout)
        with tempfile.TemporaryDirectory() as folder:
            seconds = processor_seconds([*command, '-o', os.path.join(folder, 'out')], options.limit)
            report = os.path.join(folder, 'out', 'report.json')
            steps = json.load(open(report))['seconds'] if seconds else {}
        if not seconds:
            print(f'{" ".join(build)}: failed, or took more than {options.limit} s')
            continue
        ratio = plan['seconds'] / seconds
        worst = max(worst, ratio, 1.0 / ratio)
        print(f'{" ".join(build)}: {plan["atoms"]:.0f} atoms, forecast {plan["seconds"]:.1f} s, '
              f'took {seconds:.1f} s, ratio {ratio:.2f}', steps, flush=True)
    print(f'off by a factor of {worst:.2f} at most')
    return worst > options.factor


if __name__ == '__main__':
    sys.exit(main())
