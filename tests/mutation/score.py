"""The score, as a table and as JSON."""
import datetime
import json

from mutants import TARGETS

SURVIVED = ('survived', 'not reached', 'out of budget')


def read_equivalent(path):
    """key -> reason. A line that begins with # is the reason of those below it."""
    reasons, reason = {}, ''
    for line in path.read_text().splitlines():
        if line.startswith('# '):
            reason = line[2:]
        elif line.strip():
            reasons[line.strip()] = reason
    return reasons


def count(mutants, reasons):
    """The figures of one target."""
    equivalent = [m for m in mutants if m.key in reasons and m.outcome in SURVIVED]
    not_compiled = [m for m in mutants if m.outcome == 'not compiled']
    judged = len(mutants) - len(equivalent) - len(not_compiled)
    killed = sum(m.killed for m in mutants)
    return {'sampled': len(mutants), 'not compiled': len(not_compiled), 'equivalent': len(equivalent), 'judged': judged,
            'killed': killed, 'of these by time': sum(m.outcome == 'timeout' for m in mutants),
            'survived': judged - killed, 'score': killed / max(1, judged),
            'seconds': round(sum(m.seconds for m in mutants))}


def report(mutants, reasons, seed, path):
    """Prints the table and the survivors, writes them as JSON, and returns whether every target reaches its aim."""
    rows = {}
    for target in TARGETS:
        own = [m for m in mutants if m.target == target and m.outcome]
        if any(m.outcome != 'not compiled' for m in own):
            rows[target] = count(own, reasons)
    print(f'\nSeed {seed}, {datetime.date.today()}\n')
    names = list(next(iter(rows.values()))) if rows else []
    print('| target | ' + ' | '.join(names) + ' | aim |\n' + '|---' * (len(names) + 2) + '|')
    for target, row in rows.items():
        figures = ' | '.join(f'{100 * v:.1f} %' if name == 'score' else str(v) for name, v in row.items())
        print(f'| {target} | {figures} | {100 * TARGETS[target].aim:.0f} % |')
    for m in mutants:
        if m.outcome in SURVIVED and m.key not in reasons:
            print(f'\n{m.number} {m.place}: {m.outcome} after {m.seconds:.0f} s\n    {m.key}')
    entries = [{'number': m.number, 'target': m.target, 'line': m.site.line, 'key': m.key, 'outcome': m.outcome,
                'gate': m.gate, 'seconds': round(m.seconds, 1), 'equivalent': reasons.get(m.key, '')} for m in mutants]
    result = {'seed': seed, 'date': str(datetime.date.today()), 'targets': rows, 'mutants': entries}
    path.write_text(json.dumps(result, indent=1))
    return all(row['score'] >= TARGETS[target].aim for target, row in rows.items())
