"""Gates: the tests that CTest knows, each a process of its own. What they reach, their time, and which one fails."""
import concurrent.futures
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
from dataclasses import asdict, dataclass, field

from errors import say

SKIPPED = 77


@dataclass
class Gate:
    name: str
    command: list
    folder: str
    serial: bool              # holds a clock or threads to something
    seconds: float = 0
    outcome: str = 'unknown'  # without a mutant: pass, skip, fail
    reached: list = field(default_factory=list)


def read_gates(build, programs):
    """The tests of these programs (tests_NAME) that `./test` runs."""
    command = ['ctest', '--test-dir', build, '--show-only=json-v1']
    shown = subprocess.run(command, capture_output=True, check=True, text=True).stdout
    gates = []
    for test in json.loads(shown)['tests']:
        properties = {p['name']: p['value'] for p in test.get('properties', [])}
        program = test['name'].split(':')[0]
        if program not in programs or 'nightly' in properties.get('LABELS', []) or 'command' not in test:
            continue
        folder = properties.get('WORKING_DIRECTORY', str(build))
        gates.append(Gate(test['name'], test['command'], folder, bool(properties.get('RUN_SERIAL'))))
    return gates


def run(gate, limit, **variables):
    """(outcome, seconds): pass, fail, skip or timeout. Out of time, it is ended with all processes that it started."""
    environment = {**os.environ, **{k: str(v) for k, v in variables.items() if v is not None}}
    start = time.monotonic()
    process = subprocess.Popen(gate.command, cwd=gate.folder, env=environment, stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    try:
        code = process.wait(limit)
        outcome = 'pass' if code == 0 else 'skip' if code == SKIPPED else 'fail'
    except subprocess.TimeoutExpired:
        outcome = 'timeout'
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
    return outcome, time.monotonic() - start


def measure(gate, device):
    """Runs the gate without a mutant and notes what it reaches. One that skips a part still judges the rest."""
    folder = tempfile.mkdtemp(prefix='mutation')
    try:
        gate.outcome, gate.seconds = run(gate, 1200, DIPTYCH_MUTATION_REACHED=folder, **without_device(device))
        gate.reached = sorted({int(n) for file in pathlib.Path(folder).iterdir() for n in file.read_text().split()})
    finally:
        shutil.rmtree(folder)
    return gate


def without_device(device):
    """A fault of the shared source is in both languages, so a comparison with an unmutated shader must not find it."""
    return {} if device else {'VK_DRIVER_FILES': '/dev/null', 'VK_ICD_FILENAMES': '/dev/null'}


def judge(number, gates, device, budget):
    """Runs the gates that reach this mutant, fast ones first, until one fails: (outcome, gate, seconds, gates run).
    `budget`: seconds after which no further gate begins."""
    start = time.monotonic()
    reaching = [g for g in gates if number in g.reached and g.outcome in ('pass', 'skip')]
    reaching.sort(key=lambda g: g.seconds)
    for count, gate in enumerate(reaching, 1):
        limit = 20 + 10 * gate.seconds  # far beyond the time of the right code, on a machine that others use too
        outcome, _ = run(gate, limit, DIPTYCH_MUTATION=number, **without_device(device))
        if outcome == 'fail' and gate.serial:
            if run(gate, limit, DIPTYCH_MUTATION=0, **without_device(device))[0] == 'fail':
                continue  # the clock failed, not the mutant
        if outcome in ('fail', 'timeout'):
            return ('killed' if outcome == 'fail' else 'timeout'), gate.name, time.monotonic() - start, count
        if time.monotonic() - start > budget and count < len(reaching):
            return 'out of budget', '', time.monotonic() - start, count
    return ('survived' if reaching else 'not reached'), '', time.monotonic() - start, len(reaching)


def measured_gates(build, programs, device, jobs, cache):
    """The gates of these programs, measured once a program: `cache` keeps what was found, with the program's date."""
    gates = read_gates(build, programs)

    def date(name):
        return (build / f'tests/tests_{name.split(":")[0]}').stat().st_mtime

    known = json.loads(cache.read_text()) if cache.exists() else []
    known = {entry['name']: entry for entry in known}
    for gate in gates:
        entry = known.get(gate.name)
        if entry and entry['date'] == date(gate.name):
            gate.seconds, gate.outcome, gate.reached = (entry[k] for k in ('seconds', 'outcome', 'reached'))
    new = [g for g in gates if g.outcome == 'unknown']
    say(f'{len(gates)} gates, {len(new)} of them to be measured without a mutant')
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        list(pool.map(lambda g: measure(g, device), new))
    kept = {g.name: {**asdict(g), 'date': date(g.name)} for g in gates}
    cache.write_text(json.dumps([*(known | kept).values()]))
    return gates
