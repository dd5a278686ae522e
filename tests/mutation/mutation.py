#!/usr/bin/env python3
"""tests/mutation/mutation.py [OPTIONS]: the mutation score of the tests.

Makes mutants of the sources by rule (rules.py), builds a sample of them into one build, each behind a switch that the environment sets
(schemata.py), and runs for each mutant the gates that reach it, fast ones first, until one fails (gates.py). Prints the score and every
survivor. Exit code: 0 where each target reaches its aim, 1 where one does not, 2 where the tool could not work.

A mutant that does not compile is left out. One that no gate reaches has survived. equivalent.txt lists mutants that compute the same, with
the reason; they are not counted. A gate that runs past ten times its time and 20 s counts as a kill, and is reported apart.
"""
import argparse
import concurrent.futures
import datetime
import json
import pathlib
import random
import re
import shutil
import subprocess
import sys
import threading
import time
from dataclasses import asdict, dataclass

from gates import Gate, judge, measure, read_gates
from rules import find_sites
from schemata import SWITCH, blamed, for_both_languages, overlaps_partly, render

ROOT = pathlib.Path(__file__).resolve().parents[2]


@dataclass(frozen=True)
class Target:
    """Sources, the programs (tests_NAME) that may kill their mutants, whether these see a Vulkan device, and the share to be killed."""
    patterns: tuple
    programs: tuple
    device: bool
    aim: float
    sample: int


TARGETS = {
    'shared': Target(('shared_glsl_cpp/*.h',), ('shared', 'pack', 'common', 'cpu', 'restir', 'oracle', 'geometry', 'panels', 'extremes', 'view',
                                                'app'), False, 0.95, 240),
    'host': Target(('vk_backend/*.cpp', 'vk_backend/*.h', 'common/pack/*.cpp', 'common/pack/*.h', 'common/stats/*.cpp', 'common/stats/*.h'),
                   ('pack', 'common', 'gpu', 'cpu', 'panels', 'geometry', 'restir', 'extremes', 'view', 'app'), True, 0.90, 72),
}
# compat.h is the language itself; the bench and the window are judged by other means (docs/verification.md).
LEFT_OUT = {'shared_glsl_cpp/compat.h', 'vk_backend/traversal_bench.cpp', 'vk_backend/swapchain.cpp'}


@dataclass
class Mutant:
    number: int
    target: str
    file: str
    site: object
    code: str           # the line that it begins on
    outcome: str = ''
    gate: str = ''
    seconds: float = 0

    @property
    def key(self):
        """Holds while lines move: file, rule, the text of the line, and what is written there."""
        return f'{self.file} | {self.site.rule} | {self.code} | {self.site.wrong}'


def say(*words):
    print(f'[{time.strftime("%H:%M:%S")}]', *words, file=sys.stderr, flush=True)


def fail(message):
    print(f'mutation: {message}', file=sys.stderr)
    sys.exit(2)


def sites_of(root, target):
    files = sorted(p for pattern in TARGETS[target].patterns for p in root.glob(pattern) if str(p.relative_to(root)) not in LEFT_OUT)
    texts = {str(p.relative_to(root)): p.read_text() for p in files}
    everything = '\n'.join(texts.values())
    known = frozenset(re.findall(r'[A-Za-z_]\w*', everything))
    constants = frozenset(re.findall(r'\bCONST float ([A-Z_]+) =', (root / 'shared_glsl_cpp/compat.h').read_text() + everything))
    # Hooks of the kernels' buffers are made by a macro.
    buffers = re.findall(r'\bX\((?:\w+, )*(previous_\w+)', everything)
    known |= {f'load_{name}' for name in buffers} | {f'load_{name[len("previous_"):]}' for name in buffers}
    return {name: (text, find_sites(text, known, constants)) for name, text in texts.items()}


def sample(sites, count, seed, files):
    """`count` mutants, over the files in proportion to their sites, without two that overlap in part."""
    total = sum(len(found) for _, found in sites.values())
    share = {name: count * len(found) / total for name, (_, found) in sites.items()}
    quota = {name: int(s) for name, s in share.items()}
    for name in sorted(share, key=lambda n: quota[n] - share[n])[:count - sum(quota.values())]:
        quota[name] += 1
    chosen = []
    for name, (text, found) in sites.items():
        order = list(found)
        random.Random(f'{seed} {name}').shuffle(order)
        kept = []
        for site in order:
            if len(kept) < quota[name] and not any(overlaps_partly(site, other) for other in kept):
                kept.append(site)
        if not files or any(f in name for f in files):
            chosen += [(name, site) for site in sorted(kept, key=lambda s: (s.begin, s.end, s.wrong))]
    return chosen


def copy_tree(tree, texts):
    """All sources but those that are mutated; these are written with their mutants, so that nothing is compiled twice."""
    listed = subprocess.run(['git', '-C', ROOT, 'ls-files', '-co', '--exclude-standard'], capture_output=True, text=True, check=True).stdout
    for name in listed.splitlines():
        if (ROOT / name).is_file() and name not in texts and name != 'shared_glsl_cpp/compat.h':
            write_changed(tree / name, (ROOT / name).read_bytes())
            shutil.copymode(ROOT / name, tree / name)
    assets = ROOT.parent / 'shared'
    if assets.exists() and not (tree.parent / 'shared').exists():
        (tree.parent / 'shared').symlink_to(assets)


def write_changed(path, content):
    content = content.encode() if isinstance(content, str) else content
    if not path.exists() or path.read_bytes() != content:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def write_mutated(tree, texts, mutants):
    """Writes the mutated sources; returns their places for `blamed`."""
    write_changed(tree / 'shared_glsl_cpp/mutation_switch.h', SWITCH.replace('@COUNT@', str(len(mutants) + 1)))
    compat = (ROOT / 'shared_glsl_cpp/compat.h').read_text()
    include = '#if defined(__cplusplus)\n#include "mutation_switch.h"\n#endif\n'
    write_changed(tree / 'shared_glsl_cpp/compat.h', include + compat)
    places = {}
    for name, text in texts.items():
        inside = [(m.number, m.site) for m in mutants if m.file == name and m.outcome != 'not compiled']
        rendered, at = render(text, inside)
        if name.startswith('shared_glsl_cpp/'):
            rendered = for_both_languages(text, rendered) if inside else text
        elif inside:
            rendered = f'#include "{tree}/shared_glsl_cpp/mutation_switch.h"\n#line 1\n' + rendered
        write_changed(tree / name, rendered)
        places[str(tree / name)] = at
    return places


def build(tree, folder, texts, mutants, targets, jobs, log):
    """Builds until all mutants that do not compile are out. Which these are is kept, so that a next build begins without them."""
    folder.mkdir(parents=True, exist_ok=True)
    kept = folder.parent / 'not-compiled.txt'
    known = set(kept.read_text().splitlines()) if kept.exists() else set()
    for mutant in mutants:
        if mutant.key in known:
            mutant.outcome = 'not compiled'
    places = write_mutated(tree, texts, mutants)
    with log.open('w') as file:
        if subprocess.run(['cmake', '-S', tree, '-B', folder, '-G', 'Ninja', '-DCMAKE_BUILD_TYPE=Release', '-DCMAKE_CXX_FLAGS=-w'], stdout=file,
                          stderr=file).returncode != 0:
            fail(f'CMake failed: {log}')
    for attempt in range(20):
        # First the kernels alone: nearly every mutant of a shared header that does not compile shows there.
        for goals in ([['libdiptych_cpu.a']] if attempt < 19 else []) + [targets]:
            done = subprocess.run(['ninja', '-C', folder, '-k', '0', '-j', str(jobs), *goals], capture_output=True, text=True)
            log.write_text(done.stdout + done.stderr)
            if done.returncode != 0:
                break
        else:
            return
        guilty = blamed(done.stdout, places, str(folder))
        for mutant in mutants:
            if mutant.number in guilty:
                mutant.outcome = 'not compiled'
        say(f'{len(guilty)} mutants do not compile: {sorted(guilty)}')
        kept.write_text(''.join(m.key + '\n' for m in mutants if m.outcome == 'not compiled'))
        if not guilty:
            fail(f'the build failed, not by a mutant: {log}')
        places = write_mutated(tree, texts, mutants)
    fail('the build does not come to an end')


def read_equivalent():
    """key -> reason."""
    reasons, reason = {}, ''
    for line in (ROOT / 'tests/mutation/equivalent.txt').read_text().splitlines():
        if line.startswith('# '):
            reason = line[2:]
        elif line.strip():
            reasons[line.strip()] = reason
    return reasons


def gates_of(folder, target, programs, jobs, cache):
    """The gates, measured once a build: times and what they reach."""
    settings = TARGETS[target]
    names = [p for p in settings.programs if not programs or p in programs]
    gates = read_gates(folder, names)
    stamp = {name: (folder / f'tests/tests_{name}').stat().st_mtime for name in names if (folder / f'tests/tests_{name}').exists()}
    known = json.loads(cache.read_text()) if cache.exists() else {}
    old = {g['name']: g for g in known.get('gates', []) if known['stamp'].get(g['name'].split(':')[0]) == stamp.get(g['name'].split(':')[0])}
    for gate in gates:
        if gate.name in old:
            gate.seconds, gate.outcome, gate.reached = (old[gate.name][k] for k in ('seconds', 'outcome', 'reached'))
    new = [g for g in gates if g.outcome == 'unknown']
    say(f'{target}: {len(gates)} gates, {len(new)} to be measured without a mutant')
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        list(pool.map(lambda g: measure(g, settings.device), new))
    cache.write_text(json.dumps({'stamp': stamp, 'gates': [asdict(g) for g in gates]}))
    broken = [g.name for g in gates if g.outcome not in ('pass', 'skip')]
    if broken:
        say(f'{target}: these fail without a mutant and prove nothing: {broken}')
    return gates, broken


def report(mutants, reasons, seed, results):
    """Prints the table and the survivors, and writes them as JSON. Returns whether every target reaches its aim."""
    reached_aim = True
    print(f'\nSeed {seed}, {datetime.date.today()}\n')
    print('| target | sampled | not compiled | equivalent | judged | killed | of these by time | survived | score | aim |')
    print('|---|---|---|---|---|---|---|---|---|---|')
    rows = {}
    for target, settings in TARGETS.items():
        own = [m for m in mutants if m.target == target and m.outcome]
        if not own:
            continue
        equal = [m for m in own if m.key in reasons and m.outcome in ('survived', 'not reached', 'out of budget')]
        compiled = [m for m in own if m.outcome != 'not compiled' and m not in equal]
        killed = [m for m in compiled if m.outcome in ('killed', 'timeout')]
        late = sum(m.outcome == 'timeout' for m in killed)
        score = len(killed) / max(1, len(compiled))
        reached_aim = reached_aim and score >= settings.aim
        rows[target] = dict(sampled=len(own), not_compiled=len(own) - len(compiled) - len(equal), equivalent=len(equal), judged=len(compiled),
                            killed=len(killed), timeouts=late, score=score)
        print(f'| {target} | {len(own)} | {rows[target]["not_compiled"]} | {len(equal)} | {len(compiled)} | {len(killed)} | {late} | '
              f'{len(compiled) - len(killed)} | {100 * score:.1f} % | {100 * settings.aim:.0f} % |')
    for mutant in mutants:
        if mutant.outcome in ('survived', 'not reached', 'out of budget') and mutant.key not in reasons:
            print(f'\n{mutant.number} {mutant.file}:{mutant.site.line}: {mutant.outcome} after {mutant.seconds:.0f} s\n    {mutant.key}')
    seconds = sum(m.seconds for m in mutants)
    print(f'\n{seconds:.0f} s of gates for {sum(bool(m.outcome) for m in mutants)} mutants')
    entries = [{'number': m.number, 'line': m.site.line, 'key': m.key, 'target': m.target, 'outcome': m.outcome, 'gate': m.gate,
                'seconds': round(m.seconds, 1), 'equivalent': reasons.get(m.key, '')} for m in mutants]
    results.write_text(json.dumps({'seed': seed, 'date': str(datetime.date.today()), 'targets': rows, 'mutants': entries}, indent=1))
    return reached_aim


def main():
    parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
    parser.add_argument('--target', choices=list(TARGETS), action='append', help='judge these alone; all are built in')
    parser.add_argument('--sample', action='append', default=[], metavar='TARGET=N', help='how many mutants of a target')
    parser.add_argument('--seed', default='1', help='of the sample')
    parser.add_argument('--file', action='append', default=[], metavar='TEXT', help='of the sample, only files whose path contains TEXT')
    parser.add_argument('--only', metavar='N,...', help='judge these numbers alone')
    parser.add_argument('--survivors', action='store_true', help='judge only what survived before (results.json)')
    parser.add_argument('--programs', metavar='NAME,...', help='tests_NAME alone may kill')
    parser.add_argument('--budget', type=float, default=900, help='seconds a mutant, after which no further gate begins')
    parser.add_argument('-j', '--jobs', type=int, default=2)
    parser.add_argument('-B', '--folder', type=pathlib.Path, default=ROOT / 'build/mutation')
    parser.add_argument('--list', action='store_true', help='print the sampled mutants and stop')
    given = parser.parse_args()

    counts = {name: target.sample for name, target in TARGETS.items()} | {k: int(v) for k, v in (s.split('=') for s in given.sample)}
    programs = given.programs.split(',') if given.programs else []
    mutants, texts = [], {}
    for target in TARGETS:
        sites = sites_of(ROOT, target)
        texts |= {name: text for name, (text, _) in sites.items()}
        for name, site in sample(sites, counts[target], given.seed, given.file):
            code = texts[name].splitlines()[site.line - 1].split('//')[0].strip()
            mutants.append(Mutant(len(mutants) + 1, target, name, site, ' '.join(code.split())))
        say(f'{target}: {sum(len(found) for _, found in sites.values())} sites in {len(sites)} files')
    if given.list:
        for m in mutants:
            print(f'{m.number} {m.file}:{m.site.line} {m.site.rule}: {" ".join(texts[m.file][m.site.begin:m.site.end].split())} => {m.site.wrong}')
        return 0

    folder, tree = given.folder.resolve(), given.folder.resolve() / 'tree'
    results = folder / 'results.json'
    judged = given.target or list(TARGETS)
    needed = [n for t in judged for n in TARGETS[t].programs if not programs or n in programs]
    copy_tree(tree, texts)
    build(tree, folder / 'build', texts, mutants, sorted({f'tests/tests_{n}' for n in needed}), given.jobs, folder / 'build.log')
    say('built')

    before = {e['key']: e for e in json.loads(results.read_text())['mutants']} if results.exists() else {}
    numbers = {int(n) for n in given.only.split(',')} if given.only else None
    for m in mutants:
        old = before.get(m.key)
        if (given.survivors or numbers) and old and not m.outcome:
            m.outcome, m.gate, m.seconds = old['outcome'], old['gate'], old['seconds']
    broken, lock, reasons = [], threading.Lock(), read_equivalent()
    for target in judged:
        gates, failing = gates_of(folder / 'build', target, programs, given.jobs, folder / f'gates-{target}.json')
        broken += failing
        queue = [m for m in mutants if m.target == target and m.outcome != 'not compiled']
        if numbers:
            queue = [m for m in queue if m.number in numbers]
        elif given.survivors:
            queue = [m for m in queue if m.outcome not in ('killed', 'timeout') and m.key not in reasons]

        def one(m):
            m.outcome, m.gate, m.seconds, count = judge(m.number, gates, TARGETS[target].device, given.budget)
            with lock:
                say(f'{m.number} {m.file}:{m.site.line} {m.site.rule}: {m.outcome} {m.gate} ({count} gates, {m.seconds:.0f} s)')

        with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
            list(pool.map(one, queue))
    return 0 if report(mutants, reasons, given.seed, results) and not broken else 1


if __name__ == '__main__':
    sys.exit(main())
