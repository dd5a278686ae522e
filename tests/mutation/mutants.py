"""Mutants: of which sources, how many, and which tests may kill them."""
import random
import re
from dataclasses import dataclass

from rules import find_sites
from schemata import overlaps_partly


@dataclass(frozen=True)
class Target:
    """Sources, the programs (tests_NAME) that may kill their mutants, whether these see a Vulkan device, the share of
    mutants to be killed, and how many are sampled."""
    patterns: tuple
    programs: tuple
    device: bool
    aim: float
    sample: int


TARGETS = {
    'shared': Target(('shared_glsl_cpp/**/*.h',), ('shared', 'pack', 'common', 'cpu', 'restir', 'oracle', 'geometry',
                                                'panels', 'extremes', 'random', 'view', 'app'),
                     False, 0.95, 240),
    'host': Target(('vk_backend/**/*.cpp', 'vk_backend/**/*.h', 'common/pack/*.cpp', 'common/pack/*.h', 'common/stats/*.cpp',
                    'common/stats/*.h'), ('pack', 'common', 'gpu', 'cpu', 'panels', 'geometry', 'restir', 'extremes',
                                          'random', 'view', 'app'), True, 0.90, 72),
}
# compat.h is the language itself; the bench and the window's images are seen by no test of ./test that could tell.
LEFT_OUT = {'shared_glsl_cpp/language/compat.h', 'vk_backend/renderer/traversal_bench.cpp', 'vk_backend/display/swapchain.cpp'}


@dataclass
class Mutant:
    number: int
    target: str
    file: str
    site: object
    code: str           # the line that it begins on
    outcome: str = ''   # killed, timeout, survived, not reached, out of budget or not compiled
    gate: str = ''
    seconds: float = 0

    @property
    def key(self):
        """Holds while lines move: file, rule, the text of the line, and what is written there."""
        return f'{self.file} | {self.site.rule} | {self.code} | {self.site.wrong}'

    @property
    def killed(self):
        return self.outcome in ('killed', 'timeout')

    @property
    def place(self):
        return f'{self.file}:{self.site.line}'


def sites_of(root, target):
    """name -> (text, sites) of a target's sources."""
    texts = {}
    for path in sorted(p for pattern in TARGETS[target].patterns for p in root.glob(pattern)):
        name = str(path.relative_to(root))
        if name not in LEFT_OUT:
            texts[name] = path.read_text()
    everything = '\n'.join(texts.values())
    known = frozenset(re.findall(r'[A-Za-z_]\w*', everything))
    constants = (root / 'shared_glsl_cpp/language/compat.h').read_text() + everything
    constants = frozenset(re.findall(r'\bCONST float ([A-Z_]+) =', constants))
    # The hooks that load from buffers are made by a macro.
    buffers = re.findall(r'\bX\((?:\w+, )*(previous_\w+)', everything)
    known |= {f'load_{name}' for name in buffers} | {f'load_{name[len("previous_"):]}' for name in buffers}
    return {name: (text, find_sites(text, known, constants)) for name, text in texts.items()}


def sample(sites, count, seed, files=()):
    """`count` of all sites, over the sources in proportion to theirs, no two of which overlap in part: [(name, site)].
    `files`: of these, only those of sources whose name holds one of the texts."""
    total = sum(len(found) for _, found in sites.values())
    share = {name: count * len(found) / total for name, (_, found) in sites.items()}
    quota = {name: int(s) for name, s in share.items()}
    for name in sorted(share, key=lambda n: quota[n] - share[n])[:count - sum(quota.values())]:
        quota[name] += 1
    chosen = []
    for name, (_, found) in sites.items():
        order = list(found)
        random.Random(f'{seed} {name}').shuffle(order)
        kept = []
        for site in order:
            if len(kept) < quota[name] and not any(overlaps_partly(site, other) for other in kept):
                kept.append(site)
        if not files or any(f in name for f in files):
            chosen += [(name, site) for site in sorted(kept, key=lambda s: (s.begin, s.end, s.wrong))]
    return chosen


def sample_all(root, counts, seed, files):
    """The mutants of all targets, numbered from 1, and the texts of their sources."""
    mutants, texts = [], {}
    for target in TARGETS:
        sites = sites_of(root, target)
        texts |= {name: text for name, (text, _) in sites.items()}
        for name, site in sample(sites, counts.get(target, TARGETS[target].sample), seed, files):
            code = texts[name].splitlines()[site.line - 1].split('//')[0]
            mutants.append(Mutant(len(mutants) + 1, target, name, site, ' '.join(code.split())))
    return mutants, texts
