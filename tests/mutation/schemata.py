"""All sampled mutants in one source, each behind a switch that the environment sets when a program starts."""
import os
import re
from dataclasses import dataclass, field

SWITCH = '''// Which mutant this process is: DIPTYCH_MUTATION holds its number; none by default. With DIPTYCH_MUTATION_REACHED, a folder, the
// right code runs, and the numbers of the mutants that it came by are written there when the process ends.
#pragma once
#include <cstdio>
#include <cstdlib>
#include <string>
#include <unistd.h>

namespace diptych::core::mutation {
inline bool reached[@COUNT@];
inline void write_reached() {
    const std::string path = std::string(std::getenv("DIPTYCH_MUTATION_REACHED")) + "/" + std::to_string(::getpid());
    if (std::FILE* const file = std::fopen(path.c_str(), "a")) {
        for (int k = 0; k < @COUNT@; ++k) {
            if (reached[k]) {
                std::fprintf(file, "%d\\n", k);
            }
        }
        std::fclose(file);
    }
}
inline int choose() {
    if (const char* const number = std::getenv("DIPTYCH_MUTATION")) {
        return std::atoi(number);
    }
    if (std::getenv("DIPTYCH_MUTATION_REACHED")) {
        std::atexit(write_reached);
        return -1;
    }
    return 0;
}
inline const int chosen = choose();
inline bool note(int k) {
    if (!reached[k]) {
        reached[k] = true;
    }
    return false;
}
inline bool on(int k) { return __builtin_expect(chosen == k, 0) || (__builtin_expect(chosen < 0, 0) && note(k)); }
}  // namespace diptych::core::mutation
'''


@dataclass
class Node:
    begin: int
    end: int
    mutants: list = field(default_factory=list)  # (number, wrong, rule) of this very range
    inside: list = field(default_factory=list)


def overlaps_partly(a, b):
    return a.begin < b.begin < a.end < b.end or b.begin < a.begin < b.end < a.end


def render(text, mutants):
    """The source with switches, and for every mutant its place there: number -> ((line, column), (line, column)).
    `mutants`: (number, site)."""
    roots = []
    for number, site in sorted(mutants, key=lambda m: (m[1].begin, -m[1].end)):
        level = roots
        while level and level[-1].end >= site.end and (level[-1].begin, level[-1].end) != (site.begin, site.end):
            level = level[-1].inside
        if not (level and (level[-1].begin, level[-1].end) == (site.begin, site.end)):
            level.append(Node(site.begin, site.end))
        level[-1].mutants.append((number, site.wrong, site.rule))
    output, places = [], {}
    length = 0

    def put(piece):
        nonlocal length
        output.append(piece)
        length += len(piece)

    def write(nodes, begin, end):
        for node in nodes:
            put(text[begin:node.begin])
            starts = []
            for number, wrong, rule in node.mutants:
                starts.append((number, length))
                put(f'(::diptych::core::mutation::on({number}) ? ({wrong}) : ')
            # A condition may be anything that converts to bool.
            put('static_cast<bool>(' if node.mutants[0][2] == 'condition' else '(')
            write(node.inside, node.begin, node.end)
            put(')' + ')' * len(node.mutants))
            for number, start in starts:
                places[number] = (start, length)
            begin = node.end
        put(text[begin:end])

    write(roots, 0, len(text))
    rendered = ''.join(output)

    def place(offset):
        return rendered.count('\n', 0, offset) + 1, offset - rendered.rfind('\n', 0, offset)

    return rendered, {number: (place(b), place(e)) for number, (b, e) in places.items()}


def for_both_languages(original, rendered):
    """Shaders read the right code from the same file. Compilers count the lines of the rewritten code alone."""
    return f'#if defined(__cplusplus)\n#line 1\n{rendered}\n#else\n{original}\n#endif\n'


def blamed(log, files, folder='/'):
    """The mutants that a compiler's errors name: the innermost around each error; where there is none, all of its line.
    `files`: path as compiled -> {number: place}; `folder`: where the compiler ran."""
    found = set()

    def places_in(path):
        return files.get(os.path.normpath(os.path.join(folder, path)), {})

    for path, line, column in re.findall(r'^([^\s:]+):(\d+):(\d+): (?:fatal )?error:', log, re.M):
        where = (int(line), int(column))
        places = places_in(path)
        around = [(e[0] - b[0], e[1] - b[1], n) for n, (b, e) in places.items() if b <= where < e]
        if around:
            found.add(min(around)[2])
        else:
            found.update(n for n, (b, e) in places.items() if b[0] <= where[0] <= e[0])
    if not found:  # an error elsewhere that came of instantiating a template
        for path, line in re.findall(r'^([^\s:]+):(\d+):\d+:\s+required from', log, re.M):
            found.update(n for n, (b, e) in places_in(path).items() if b[0] <= int(line) <= e[0])
    return found
