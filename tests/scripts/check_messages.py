#!/usr/bin/env python3
"""What the library says in its messages: check_messages.py

Callers of the library may have no command line. So no string literal and no comment outside of app/ may name an option
("--fov", "-o"). A message names the setting, between backticks ("`fov`"), and app/console/option_names.cpp has the
option of each.
Within app/, only app/console/output.cpp writes to stdout and stderr: it knows what to do where they cannot be written.
Fails where a literal names an option, where a setting has no option in the table, and where the table has a setting
that no literal names or an option that the program lacks; also where another source prints by itself.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIBRARY = ["shared_glsl_cpp", "common", "cpu_ref", "vk_backend"]
TABLE = ROOT / "app/console/option_names.cpp"
OUTPUT = ROOT / "app/console/output.cpp"
PRINTING = re.compile(r"\bfmt::print\(|\bstd::(?:cout|cerr|clog|puts|printf)\b|\bf?printf\(|STDOUT_FILENO, \w+\.data")
# Comments and character literals come first, so that a quote within them opens no string.
TOKENS = re.compile(r"""//[^\n]*|/\*.*?\*/|'(?:\\.|[^'\\\n])+'|R"(\w*)\((.*?)\)\1"|"((?:\\.|[^"\\\n])*)\"""", re.DOTALL)
OPTION = re.compile(r"(?<![\w-])--(?:[a-z]|$)|(?:^|(?<=[\s(]))-[a-zA-Z](?=[\s,.;:)]|$)")
IN_COMMENT = re.compile(r"(?<![\w-])--[a-z]")
SETTING = re.compile(r"`([a-z_]+)`")


def texts(path):
    """(line, text, whether it is a comment) of every string literal and every comment."""
    text = path.read_text()
    for token in TOKENS.finditer(text):
        literal = token[2] if token[2] is not None else token[3]
        comment = token[0].startswith(("//", "/*"))
        if comment or literal is not None:
            yield text.count("\n", 0, token.start()) + 1, token[0] if comment else literal, comment


def sources(folders):
    for folder in folders:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in {".h", ".cpp"}:
                yield path


def main():
    table = dict(re.findall(r'\{"(\w+)", "(-[\w-]+)"\}', TABLE.read_text()))
    wrong, named = [], set()
    for path in sources(LIBRARY):
        for line, literal, comment in texts(path):
            place = f"{path.relative_to(ROOT)}:{line}"
            if (IN_COMMENT if comment else OPTION).search(literal):
                wrong.append(f'{place}: names an option: {literal}')
            if comment:
                continue
            for setting in SETTING.findall(literal):
                named.add(setting)
                if setting not in table:
                    wrong.append(f"{place}: {TABLE.name} has no option for `{setting}`")
    # Names built at run time: `{}` takes the first literal of the call.
    names = (ROOT / "common/settings/names.cpp").read_text()
    named |= set(re.findall(r'value_in\(\w+, "(\w+)", name\)', names))
    options = {text for path in sources(["app"]) if path != TABLE for _, text, comment in texts(path) if not comment}
    words = {word for text in options for word in re.findall(r"(?<![\w-])--?[a-z][a-z-]*", text)}
    ranges = (ROOT / "common/settings/ranges.h").read_text()
    words |= {"--" + name for name in re.findall(r'SettingRange \w+\{\s*"([\w-]+)"', ranges)}
    for path in sources(["app"]):
        for number, line in enumerate(path.read_text().splitlines(), 1):
            if path != OUTPUT and PRINTING.search(line):
                wrong.append(f"{path.relative_to(ROOT)}:{number}: prints by itself; {OUTPUT.name} does that")
    for setting, option in table.items():
        if setting not in named:
            wrong.append(f"{TABLE.name}: no message names `{setting}`")
        if option not in words:
            wrong.append(f"{TABLE.name}: the program has no {option}")
    print("\n".join(wrong) or f"{len(named)} settings in messages, {len(table)} with their options")
    sys.exit(1 if wrong else 0)


main()
