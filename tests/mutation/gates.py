"""Gates: the tests that CTest knows, each a process of its own. What they reach, their time, and which one fails."""
import concurrent.futures
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import threading
import time
from dataclasses import asdict, dataclass, field

from errors import say

SKIPPED = 77


@dataclass
class Gate:
    name: str
    command: list
    folder: str
    seconds: float = 0        # of processors
    outcome: str = 'unknown'  # without a mutant: pass, skip, fail, timeout
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
        gates.append(Gate(test['name'], test['command'], folder))
    return gates


def run(gate, limit, device, **variables):
    """(outcome, seconds): pass, fail, skip or timeout. `limit` and seconds are processors' time, since others may use
    the machine too; a process that waits for ever is ended after ten times as long."""
    # A fault of the shared source is in both languages, so a comparison with an unmutated shader must not find it.
    if not device:
        variables |= {'VK_DRIVER_FILES': '/dev/null', 'VK_ICD_FILENAMES': '/dev/null'}
    limited = ['bash', '-c', 'ulimit -c 0 -t "$0"; exec "$@"', str(int(limit) + 1), *gate.command]
    silent = subprocess.DEVNULL
    process = subprocess.Popen(limited, cwd=gate.folder, env={**os.environ, **{k: str(v) for k, v in variables.items()}},
                               stdin=silent, stdout=silent, stderr=silent, start_new_session=True)
    end, pause = time.monotonic() + 60 + 10 * limit, 0.005
    while True:
        ended, status, usage = os.wait4(process.pid, os.WNOHANG if time.monotonic() < end else 0)
        if ended:
            break
        time.sleep(pause)
        pause = min(2 * pause, 0.1)
        if time.monotonic() >= end:
            os.killpg(process.pid, signal.SIGKILL)
    process.returncode = code = os.waitstatus_to_exitcode(status)
    timeout = code in (-signal.SIGXCPU, -signal.SIGKILL)
    outcome = 'timeout' if timeout else 'pass' if code == 0 else 'skip' if code == SKIPPED else 'fail'
    return outcome, usage.ru_utime + usage.ru_stime


def measure(gate, device, longest):
    """Runs the gate without a mutant and notes what it reaches. One that skips a part still judges the rest."""
    folder = tempfile.mkdtemp(prefix='mutation')
    try:
        gate.outcome, gate.seconds = run(gate, longest, device, DIPTYCH_MUTATION_REACHED=folder)
        gate.reached = sorted({int(n) for file in pathlib.Path(folder).iterdir() for n in file.read_text().split()})
    finally:
        shutil.rmtree(folder)


def judge(number, gates, device, budget):
    """Runs the gates that reach this mutant, fast ones first, until one fails: (outcome, gate, seconds, gates run).
    `budget`: seconds after which no further gate begins."""
    reaching = [g for g in gates if number in g.reached and g.outcome in ('pass', 'skip')]
    reaching.sort(key=lambda g: g.seconds)
    spent = 0
    for count, gate in enumerate(reaching, 1):
        limit = 5 + 10 * gate.seconds  # far beyond the time of the right code
        outcome, seconds = run(gate, limit, device, DIPTYCH_MUTATION=number)
        spent += seconds
        if outcome in ('fail', 'timeout') and run(gate, limit, device, DIPTYCH_MUTATION=0)[0] not in ('pass', 'skip'):
            continue  # a clock, a file or the machine failed, not the mutant
        if outcome in ('fail', 'timeout'):
            return ('killed' if outcome == 'fail' else 'timeout'), gate.name, spent, count
        if spent > budget and count < len(reaching):
            return 'out of budget', '', spent, count
    return ('survived' if reaching else 'not reached'), '', spent, len(reaching)


def measured_gates(build, programs, device, jobs, cache, longest):
    """The gates of these programs that take at most `longest` seconds, measured once a program: `cache` keeps what was
    found, with the program's date."""
    gates = read_gates(build, programs)
    dates = {name: (build / f'tests/tests_{name}').stat().st_mtime for name in {g.name.split(':')[0] for g in gates}}
    known = {}
    if cache.exists():
        known = {entry['name']: entry for entry in map(json.loads, cache.read_text().splitlines())}
    for gate in gates:
        entry = known.get(gate.name)
        if entry and entry['date'] == dates[gate.name.split(':')[0]]:
            gate.seconds, gate.outcome, gate.reached = (entry[k] for k in ('seconds', 'outcome', 'reached'))
    new = [g for g in gates if g.outcome == 'unknown']
    say(f'{len(gates)} gates, {len(new)} of them to be measured without a mutant')
    lock = threading.Lock()

    def measure_one(gate):
        measure(gate, device, longest)
        if gate.outcome == 'timeout':
            return
        entry = {**asdict(gate), 'date': dates[gate.name.split(':')[0]]}
        with lock, cache.open('a') as file:
            file.write(json.dumps(entry) + '\n')

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        list(pool.map(measure_one, new))
    late = [g.name for g in gates if g.outcome == 'timeout' or g.seconds > longest]
    if late:
        say(f'left out, as they take more than {longest:.0f} s: {late}')
    return [g for g in gates if g.name not in late]
