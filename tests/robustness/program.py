"""Runs the program and holds what it did against what it promises."""
import json
import os
import resource
import shutil
import signal
import subprocess
import tempfile
from dataclasses import dataclass, field

SANITIZERS = ('AddressSanitizer', 'LeakSanitizer', 'ThreadSanitizer', 'runtime error:')


@dataclass
class Run:
    """One run: `faults` names what must never happen, `refusal` why the program declined."""
    exit_code: int
    out: str
    err: str
    faults: list = field(default_factory=list)

    @property
    def json(self):
        return json.loads(self.out)

    @property
    def refusal(self):
        lines = [line for line in self.err.splitlines() if line.startswith('trivalent: ')]
        return lines[-1][len('trivalent: '):] if lines else ''


def run(program, arguments, timeout=120, expected=(0, 1)):
    """Runs the program for so many seconds of processor time (the machine may be busy) at most; notes
    crashes, hangs, findings of sanitizers and failures without a reason."""
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (timeout, timeout + 5))

    try:
        done = subprocess.run([program, *map(str, arguments)], capture_output=True, timeout=20 * timeout, preexec_fn=limit)
        code, out, err = done.returncode, done.stdout, done.stderr
    except subprocess.TimeoutExpired as late:
        code, out, err = -signal.SIGXCPU, late.stdout or b'', late.stderr or b''
    result = Run(code, out.decode(errors='replace'), err.decode(errors='replace'))
    if code == -signal.SIGXCPU:
        result.faults.append(f'hangs for more than {timeout} s')
    elif code < 0:
        result.faults.append(f'ends by signal {-code}')
    elif code not in expected:
        result.faults.append(f'ends with {code}')
    for word in SANITIZERS:
        if word in result.err:
            result.faults.append(word)
    return result


def read_off(path):
    """Points and faces of a file that the program wrote, by other means than its own."""
    with open(path) as file:
        words = file.read().split()
    n_points, n_faces = int(words[1]), int(words[2])
    numbers = words[4:4 + 3 * n_points]
    points = [tuple(map(float, numbers[3 * i:3 * i + 3])) for i in range(n_points)]
    corners = list(map(int, words[4 + 3 * n_points:]))
    faces = [tuple(corners[4 * i + 1:4 * i + 4]) for i in range(n_faces)]
    return points, faces


def faults_of_shell(folder):
    """What is wrong with a shell: it must be an oriented manifold whose dual is trivalent if closed."""
    report = json.load(open(os.path.join(folder, 'report.json')))
    points, faces = read_off(os.path.join(folder, 'surface.off'))
    faults = []
    edges = {}
    for face in faces:
        for k in range(3):
            edge = (face[k], face[(k + 1) % 3])
            if edge in edges:
                faults.append(f'two faces run along the edge {edge}')
            edges[edge] = face
    boundary = sum((b, a) not in edges for a, b in edges)
    euler = len(points) - (len(edges) + boundary) // 2 + len(faces)
    network = report['network']
    if network['atoms'] != len(faces):
        faults.append(f'{network["atoms"]} atoms for {len(faces)} faces')
    if boundary == 0 and network['coordinations'] != {'3': len(faces)}:
        faults.append('the surface is closed, but not every atom has three bonds')
    if boundary == 0 and network['ring_excess'] != 6 * euler:
        faults.append(f'sum of 6 - ring size is {network["ring_excess"]}, not {6 * euler}')
    if (report['quality']['boundary_loops'] > 0) != (boundary > 0):
        faults.append('the report says something else about the boundary')
    return report, faults[:3]


class Folder:
    """A folder that is gone after `with`."""

    def __enter__(self):
        self.path = tempfile.mkdtemp(prefix='trivalent-robustness-')
        return self.path

    def __exit__(self, *_):
        shutil.rmtree(self.path, ignore_errors=True)


def sanitized(program):
    with open(program, 'rb') as file:
        return b'__asan_init' in file.read()


def is_certified(program, folder, is_open):
    """Whether `check` certifies the atoms as they were written."""
    checked = run(program, ['check', os.path.join(folder, 'shell.extxyz'), '--quiet', *(['--open'] if is_open else [])])
    return checked.exit_code == 0, checked.faults


def build(program, shape, options, timeout=120, certify=False):
    """Builds a shell and checks it: the run, and its report if there is one, with `certified` if asked for."""
    with Folder() as folder:
        out = os.path.join(folder, 'shell')
        done = run(program, ['build', shape, '-o', out, '--quiet', '--json', *options], timeout, expected=(0, 1, 2))
        report = None
        if done.exit_code == 0:
            report, faults = faults_of_shell(out)
            done.faults += faults
            if certify:
                report['certified'], faults = is_certified(program, out, report['quality']['boundary_loops'] > 0)
                done.faults += faults
        elif not done.faults:
            if not done.refusal:
                done.faults.append('refuses without a reason')
            if os.path.exists(out) and os.listdir(out):
                done.faults.append('refuses, but leaves files')
        return done, report
