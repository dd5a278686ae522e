"""One build with all sampled mutants in it, of a copy of the sources."""
import shutil
import subprocess

from errors import fail, say
from schemata import SWITCH, blamed, for_both_languages, render

ATTEMPTS = 20


def write_changed(path, content):
    content = content.encode() if isinstance(content, str) else content
    if not path.exists() or path.read_bytes() != content:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def copy_sources(root, tree, mutated):
    """All sources but the mutated ones, which are written with their mutants, so that nothing is compiled twice."""
    command = ['git', '-C', root, 'ls-files', '-co', '--exclude-standard']
    for name in subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines():
        if (root / name).is_file() and name not in mutated and name != 'shared_glsl_cpp/language/compat.h':
            write_changed(tree / name, (root / name).read_bytes())
            shutil.copymode(root / name, tree / name)
    assets = root.parent / 'shared'  # where tests look for files of others
    if assets.exists() and not (tree.parent / 'shared').exists():
        (tree.parent / 'shared').symlink_to(assets)


def write_mutated(root, tree, texts, mutants):
    """Writes the mutated sources; returns where `blamed` is to look for each mutant."""
    write_changed(tree / 'shared_glsl_cpp/mutation_switch.h', SWITCH.replace('@COUNT@', str(len(mutants) + 1)))
    include = '#if defined(__cplusplus)\n#include "mutation_switch.h"\n#endif\n'
    write_changed(tree / 'shared_glsl_cpp/language/compat.h', include + (root / 'shared_glsl_cpp/language/compat.h').read_text())
    places = {}
    for name, text in texts.items():
        inside = [(m.number, m.site) for m in mutants if m.file == name and m.outcome != 'not compiled']
        rendered, places[str(tree / name)] = render(text, inside)
        if name.startswith('shared_glsl_cpp/'):
            rendered = for_both_languages(text, rendered) if inside else text
        elif inside:
            rendered = f'#include "{tree}/shared_glsl_cpp/mutation_switch.h"\n#line 1\n' + rendered
        write_changed(tree / name, rendered)
    return places


def build(root, folder, texts, mutants, goals, jobs):
    """Builds until all mutants that do not compile are out. Which these are is kept for the next build."""
    tree, output, log, kept = (folder / name for name in ('tree', 'build', 'build.log', 'not-compiled.txt'))
    copy_sources(root, tree, texts)
    known = set(kept.read_text().splitlines()) if kept.exists() else set()
    for mutant in mutants:
        mutant.outcome = 'not compiled' if mutant.key in known else ''
    places = write_mutated(root, tree, texts, mutants)
    configure = ['cmake', '-S', tree, '-B', output, '-G', 'Ninja', '-DCMAKE_BUILD_TYPE=Release', '-DCMAKE_CXX_FLAGS=-w']
    with log.open('w') as file:
        if subprocess.run(configure, stdout=file, stderr=file).returncode != 0:
            fail(f'CMake failed: {log}')
    for _ in range(ATTEMPTS):
        # First the kernels alone: nearly every mutant of a shared header that does not compile shows there.
        for wanted in (['libdiptych_cpu.a'], goals):
            command = ['ninja', '-C', output, '-k', '0', '-j', str(jobs), *wanted]
            done = subprocess.run(command, capture_output=True, text=True)
            log.write_text(done.stdout + done.stderr)
            if done.returncode != 0:
                break
        else:
            say('built')
            return
        guilty = blamed(done.stdout, places, str(output))
        if not guilty:
            break
        for mutant in mutants:
            if mutant.number in guilty:
                mutant.outcome = 'not compiled'
        say(f'{len(guilty)} mutants do not compile: {sorted(guilty)}')
        kept.write_text(''.join(m.key + '\n' for m in mutants if m.outcome == 'not compiled'))
        places = write_mutated(root, tree, texts, mutants)
    fail(f'the build failed, not by a mutant: {log}')
