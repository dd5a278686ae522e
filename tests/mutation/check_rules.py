#!/usr/bin/env python3
"""That the rules of mutation.py write what they say, once each, and leave alone what no program computes; that the
switches keep the right code right, and that a mutant which does not compile is found."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from cpp_tokens import tokenize  # noqa: E402
from mutants import sample  # noqa: E402
from rules import find_sites  # noqa: E402
from schemata import SWITCH, blamed, for_both_languages, render  # noqa: E402

COMPILER = os.environ.get('CXX', 'c++')
KNOWN = frozenset({'MOMENT_CURRENT', 'MOMENT_PREVIOUS', 'load_lights', 'load_previous_lights', 'previous_camera',
                   'camera'})


def mutants(statement, **known):
    """(rule, mutated statement) of every site in the body of a function."""
    text = f'FN float f(vec3 v, float a, float b) {{\n    {statement}\n}}\n'
    skipped = text.index(statement)
    found = find_sites(text, **known)
    return {(s.rule, (text[:s.begin] + s.wrong + text[s.end:])[skipped:].split('\n}')[0]) for s in found}


class Rules(unittest.TestCase):
    def holds(self, statement, rule, *expected, **known):
        self.assertEqual({m for r, m in mutants(statement, **known) if r == rule}, set(expected))

    def test_component(self):
        self.holds('return v.x;', 'component', 'return v.y;')
        self.holds('return f(i).row[k].w;', 'component', 'return f(i).row[k].z;')
        self.holds('use(v.x());', 'component')

    def test_factor(self):
        self.holds('return a * b / c;', 'factor', 'return a / c;', 'return b / c;', 'return a * b;')

    def test_term(self):
        self.holds('return a - b + c;', 'term', 'return a + c;', 'return -(b) + c;', 'return a - b;')
        self.holds('return a - (b + a * c);', 'term', 'return a;', 'return -((b + a * c));', 'return a - (b);',
                   'return a - ((a * c));')

    def test_sign(self):
        self.holds('return a + b * c;', 'sign', 'return a - b * c;')
        self.holds('return side < 0 ? -a.b(c) : a;', 'sign', 'return side < 0 ? a.b(c) : a;')

    def test_comparison(self):
        self.holds('return (a & b) != 0u && a + 1 < b;', 'comparison', 'return (a & b) == 0u && a + 1 < b;',
                   'return (a & b) != 0u && a + 1 >= b;')

    def test_condition(self):
        self.holds('if (a) { return b; }', 'condition', 'if (true) { return b; }', 'if (false) { return b; }')
        self.holds('x = a && !b ? c : d;', 'condition', 'x = true ? c : d;', 'x = false ? c : d;',
                   'x = true && !b ? c : d;', 'x = a && true ? c : d;')
        self.holds('return a || b;', 'condition', 'return false || b;', 'return a || false;')
        self.holds('return feature(MOTION) && a;', 'condition', 'return feature(MOTION) && true;')

    def test_moment(self):
        self.holds('return load_lights(i).pmf;', 'moment', 'return load_previous_lights(i).pmf;', known=KNOWN)
        self.holds('return m == MOMENT_PREVIOUS;', 'moment', 'return m == MOMENT_CURRENT;', known=KNOWN)
        self.holds('return constants.camera.up;', 'moment', 'return constants.previous_camera.up;', known=KNOWN)

    def test_extreme(self):
        self.holds('return std::max(a, min(b, c));', 'min-max', 'return std::min(a, min(b, c));',
                   'return std::max(a, max(b, c));')

    def test_index(self):
        self.holds('return a[i + 1];', 'index', 'return a[0];')
        self.holds('return a[0];', 'index', 'return a[1];')
        self.holds('return load_lights(i);', 'index', 'return load_lights(0);')

    def test_constant(self):
        self.holds('return 2.0f;', 'constant', 'return 2.2f;')
        self.holds('return 1.0e-30f + 0.0f;', 'constant', 'return 1.1e-30f + 0.0f;')
        self.holds('return 3u + 100 + 0x10u;', 'constant', 'return 4u + 100 + 0x10u;', 'return 3u + 110 + 0x10u;',
                   'return 3u + 100 + 17u;')
        self.holds('return PI;', 'constant', 'return PI * 1.1f;', constants=frozenset({'PI'}))

    def test_what_is_no_code_stays(self):
        for statement in ('constexpr float c = 2.0f * 3.0f;', 'static_assert(sizeof(T) == 4);', 'float a[3];',
                          '// a + b * c < d\n', 'std::vector<std::array<float, 3>> list;', 'const T* p;',
                          'throw Error(fmt::format("{} of {}", a - 1, b[2]));', 'const auto& [x, y] = pair;',
                          'auto f = [&, a = b](const T& t) {};', 'case 3: break;', 'say("a + b");', 'assert(a < b);',
                          '#define X (a + b)'):
            self.assertEqual(mutants(statement), set(), statement)
        for declaration in ('struct A { float x = 2.0f; };', 'constexpr float f(float a) { return a * 2.0f; }',
                            'CONST float A = 2.0f;', 'enum { A = 1 };', 'namespace a { int b = 1 + 1; }'):
            self.assertEqual(find_sites(declaration), [], declaration)

    def test_only_the_code_of_a_mutant_macro(self):
        self.holds('return MUTANT(NAME, a + b, a * b);', 'sign', 'return MUTANT(NAME, a - b, a * b);')
        self.holds('return MUTANT(NAME, a + b, a * b);', 'factor')

    def test_lines(self):
        tokens = tokenize('a /* \n */ b\n#if c \\\n d\ne')
        self.assertEqual([(t.text, t.line) for t in tokens], [('a', 1), ('b', 2), ('e', 5)])

    def test_samples_repeat_and_do_not_overlap(self):
        text = 'FN float f() {\n' + 'return a + b * c - d < e ? v.x : -v.y * 2.0f;\n' * 40 + '}\n'
        sites = {'a.h': (text, find_sites(text)), 'b.h': ('', [])}
        one, two = sample(sites, 30, 'seed'), sample(sites, 30, 'seed')
        self.assertEqual(one, two)
        self.assertEqual(len(one), 30)
        self.assertNotEqual(one, sample(sites, 30, 'another'))


CODE = '''#include <cstdio>
namespace {
float f(float a, float b) {
    return a * 2.0f + (a < b ? b - a
                             : -b);
}
int g(int* p) {
    return *(p + 1);
}
}
int main() {
    int list[3] = {5, 7, 9};
    std::printf("%g %g %d\\n", double(f(1.0f, 4.0f)), double(f(3.0f, 2.0f)), g(list));
}
'''


class Switches(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def compile(self, chosen):
        (self.folder / 'mutation_switch.h').write_text(SWITCH.replace('@COUNT@', str(len(chosen) + 1)))
        rendered, places = render(CODE, chosen)
        source = self.folder / 'code.cpp'
        source.write_text('#include "mutation_switch.h"\n' + for_both_languages('no C++', rendered))
        command = [COMPILER, '-std=c++20', '-w', str(source), '-o', str(self.folder / 'code')]
        done = subprocess.run(command, capture_output=True, text=True)
        return done, {str(source): places}

    def run_code(self, **environment):
        variables = {k: str(v) for k, v in environment.items()}
        return subprocess.run([str(self.folder / 'code')], env=variables, capture_output=True, text=True).stdout

    def test_each_switch_is_its_mutant_alone(self):
        sites = [s for s in find_sites(CODE) if s.line < 7]
        chosen = list(enumerate(sites, 1))
        done, _ = self.compile(chosen)
        self.assertEqual(done.returncode, 0, done.stderr)
        right = self.run_code()
        self.assertEqual(right, '5 4 7\n')
        self.assertEqual(self.run_code(DIPTYCH_MUTATION=0), right)
        reached = self.folder / 'reached'
        reached.mkdir()
        self.assertEqual(self.run_code(DIPTYCH_MUTATION_REACHED=reached), right)
        seen = {int(n) for file in reached.iterdir() for n in file.read_text().split()}
        self.assertEqual(seen, {n for n, _ in chosen})
        for number, site in chosen:
            alone = self.folder / 'alone.cpp'
            alone.write_text(CODE[:site.begin] + site.wrong + CODE[site.end:])
            subprocess.run([COMPILER, '-std=c++20', '-w', str(alone), '-o', str(self.folder / 'alone')], check=True)
            expected = subprocess.run([str(self.folder / 'alone')], capture_output=True, text=True).stdout
            self.assertEqual(self.run_code(DIPTYCH_MUTATION=number), expected, site)

    def test_what_does_not_compile_is_found(self):
        sites = find_sites(CODE)
        bad = [n for n, s in enumerate(sites, 1) if (s.line, s.rule) == (8, 'term')]
        done, places = self.compile(list(enumerate(sites, 1)))
        self.assertNotEqual(done.returncode, 0)
        guilty = set()
        for _ in range(5):
            guilty |= blamed(done.stderr, places)
            done, places = self.compile([(n, s) for n, s in enumerate(sites, 1) if n not in guilty])
            if done.returncode == 0:
                break
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(guilty & set(bad))
        self.assertTrue(all(sites[n - 1].line in (8, 12, 13) for n in guilty), guilty)


if __name__ == '__main__':
    unittest.main()
