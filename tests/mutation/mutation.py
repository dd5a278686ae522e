#!/usr/bin/env python3
"""tests/mutation/mutation.py [OPTIONS]: the mutation score of the tests.

Makes mutants of the sources by rule (rules.py), builds a sample of them into one build, each behind a switch that the
environment sets (schemata.py), and runs for each mutant the gates that reach it, fast ones first, until one fails
(gates.py). Prints the score and every survivor. Exit code: 0 where each target reaches its aim, 1 where one does not, 2
where the tool could not work.

A mutant that does not compile is left out. One that no gate reaches has survived. equivalent.txt lists mutants that
compute the same, with the reason; they are not counted. A gate that runs past ten times its time and 5 s counts as a
kill, and is reported apart. Seconds are those of processors.
"""
import argparse
import concurrent.futures
import json
import pathlib
import random
import sys
import threading
import time

from errors import say
from gates import judge, measured_gates
from mutants import TARGETS, sample_all
from mutated_build import build
from score import read_equivalent, report

ROOT = pathlib.Path(__file__).resolve().parents[2]


def read_arguments():
    parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
    parser.add_argument('--target', choices=list(TARGETS), action='append', help='judge these alone; all are built in')
    parser.add_argument('--sample', action='append', default=[], metavar='TARGET=N', help='mutants of a target')
    parser.add_argument('--seed', default='1', help='of the sample')
    parser.add_argument('--file', action='append', default=[], metavar='TEXT', help='only paths that contain TEXT')
    parser.add_argument('--only', metavar='N,...', help='judge these numbers alone')
    parser.add_argument('--survivors', action='store_true', help='judge only what was not killed before')
    parser.add_argument('--resume', action='store_true', help='judge only what an interrupted run left')
    parser.add_argument('--minutes', type=float, default=float('inf'), help='after which no further mutant begins')
    parser.add_argument('--programs', metavar='NAME,...', help='tests_NAME alone may kill')
    parser.add_argument('--budget', type=float, default=900, help='seconds a mutant, the last gate not counted')
    parser.add_argument('--longest', type=float, default=600, help='seconds of a gate; longer ones are left out')
    parser.add_argument('-j', '--jobs', type=int, default=2)
    parser.add_argument('-B', '--folder', type=pathlib.Path, default=ROOT / 'build/mutation')
    parser.add_argument('--list', action='store_true', help='print the sampled mutants and stop')
    return parser.parse_args()


def take_over(mutants, outcomes):
    """What runs before have found out."""
    lines = outcomes.read_text().splitlines() if outcomes.exists() else []
    before = {key: found for key, *found in map(json.loads, lines)}
    for m in mutants:
        if m.key in before and not m.outcome:
            m.outcome, m.gate, m.seconds = before[m.key]


def judge_all(mutants, gates, device, given, outcomes):
    """Judges them in a random order, so that those of a run that ends early are a fair sample."""
    lock, end = threading.Lock(), time.monotonic() + 60 * given.minutes
    mutants = sorted(mutants, key=lambda m: m.number)
    random.Random(given.seed).shuffle(mutants)

    def judge_one(m):
        if time.monotonic() > end:
            return
        m.outcome, m.gate, m.seconds, count = judge(m.number, gates, device, given.budget)
        with lock, outcomes.open('a') as file:
            file.write(json.dumps([m.key, m.outcome, m.gate, round(m.seconds, 2)]) + '\n')
            say(f'{m.number} {m.place} {m.site.rule}: {m.outcome} {m.gate} ({count} gates, {m.seconds:.1f} s)')

    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        list(pool.map(judge_one, mutants))


def main():
    given = read_arguments()
    folder = given.folder.resolve()
    counts = {name: int(count) for name, count in (text.split('=') for text in given.sample)}
    mutants, texts = sample_all(ROOT, counts, given.seed, given.file)
    if given.list:
        for m in mutants:
            right = ' '.join(texts[m.file][m.site.begin:m.site.end].split())
            print(f'{m.number} {m.place} {m.site.rule}: {right} => {m.site.wrong}')
        return 0

    targets = given.target or list(TARGETS)
    chosen = given.programs.split(',') if given.programs else None
    programs = {t: [p for p in TARGETS[t].programs if not chosen or p in chosen] for t in targets}
    folder.mkdir(parents=True, exist_ok=True)
    goals = sorted({f'tests/tests_{name}' for t in targets for name in programs[t]})
    build(ROOT, folder, texts, mutants, goals, given.jobs)

    outcomes, reasons = folder / 'outcomes.jsonl', read_equivalent(ROOT / 'tests/mutation/equivalent.txt')
    numbers = {int(n) for n in given.only.split(',')} if given.only else None
    if given.survivors or given.resume or numbers:
        take_over(mutants, outcomes)
    else:
        outcomes.unlink(missing_ok=True)
    gates_hold = True
    for target in targets:
        device = TARGETS[target].device
        gates = measured_gates(folder / 'build', programs[target], device, given.jobs, folder / f'gates-{target}.jsonl',
                               given.longest)
        broken = [g.name for g in gates if g.outcome not in ('pass', 'skip')]
        if broken:
            say(f'{target}: these fail without a mutant and prove nothing: {broken}')
            gates_hold = False
        queue = [m for m in mutants if m.target == target and m.outcome != 'not compiled']
        if numbers:
            queue = [m for m in queue if m.number in numbers]
        elif given.survivors:
            queue = [m for m in queue if m.outcome and not m.killed and m.key not in reasons]
        elif given.resume:
            queue = [m for m in queue if not m.outcome]
        judge_all(queue, gates, device, given, outcomes)
    return 0 if report(mutants, reasons, given.seed, folder / 'results.json') and gates_hold else 1


if __name__ == '__main__':
    sys.exit(main())
