"""The rules by which mutants are made. find_sites lists every place where a rule applies, and what it writes there."""
import re
from dataclasses import dataclass

from cpp_tokens import tokenize

COMPONENT = {'x': 'y', 'y': 'x', 'z': 'y', 'w': 'z'}  # a two-vector has the others too
FLIPPED = {'<': '>=', '>': '<=', '<=': '>', '>=': '<', '==': '!=', '!=': '=='}
OTHER_EXTREME = {'min': 'max', 'max': 'min'}
# Between these an arithmetic expression ends.
SEPARATORS = {',', ';', '=', '+=', '-=', '*=', '/=', '%=', '&=', '|=', '^=', '<<=', '>>=', '?', ':', '&&', '||', '!',
              '<', '>', '<=', '>=', '==', '!=', '&', '|', '^', '~', '<<', '>>', '<=>'}
KEYWORDS = {'return', 'else', 'do', 'throw', 'case', 'co_return', 'new', 'delete'}


@dataclass(frozen=True)
class Site:
    """One mutant: text[begin:end] becomes `wrong`."""
    rule: str
    begin: int
    end: int
    line: int
    wrong: str


class Source:
    """One file's tokens and what is asked about them. `known` holds names of all files, for counterparts of other
    moments, and `constants` the names of their fp32 constants."""

    def __init__(self, text, known=frozenset(), constants=frozenset()):
        self.text, self.known, self.constants = text, known, constants
        self.tokens = tokenize(text)
        self.sites = []

    def words(self, first, last):
        """Tokens first..last as one line, without comments."""
        pieces = []
        for i in range(first, last + 1):
            token = self.tokens[i]
            pieces.append((' ' if token.spaced_before and i > first else '') + token.text)
        return ''.join(pieces)

    def add(self, rule, first, last, wrong):
        tokens = self.tokens
        if not (tokens[first].runs and tokens[last].runs):
            return
        site = Site(rule, tokens[first].begin, tokens[last].end, tokens[first].line, wrong)
        right = self.words(first, last)
        # A feature only lets a build leave code out (scene_features.h): to keep the code is no fault.
        if (wrong, right[:8]) == ('true', 'feature(') and tokens[first + 1].partner == last:
            return
        if (wrong, right[:9]) == ('false', '!feature(') and tokens[first + 2].partner == last:
            return
        if wrong != right and site not in self.sites:
            self.sites.append(site)

    def chain_begin(self, i):
        """Where the postfix expression that ends at token i begins: a.b(c)[d].e."""
        tokens = self.tokens
        while True:
            while tokens[i].text in (')', ']') and tokens[i].partner >= 0:
                i = tokens[i].partner
                before = tokens[i - 1]
                if not (before.kind == 'name' and before.text not in KEYWORDS or before.text in (')', ']')
                        or before.text == '>' and not before.spaced_before):
                    return i
                i -= 1
            if tokens[i].text == '>' and not tokens[i].spaced_before:  # of template arguments
                while tokens[i].text != '<':
                    i -= 1
                i -= 1
            if tokens[i - 1].text in ('.', '->', '::'):
                if tokens[i - 1].text == '::' and tokens[i - 2].kind != 'name':
                    return i - 1
                i -= 2
                continue
            return i

    def chain_end(self, i):
        """Where the postfix expression that begins at token i ends."""
        tokens = self.tokens
        if tokens[i].partner > i:
            i = tokens[i].partner
        while i + 1 < len(tokens):
            after = tokens[i + 1]
            if after.text in ('(', '[') and not after.spaced_before and after.partner > i:
                i = after.partner
            elif after.text in ('.', '->', '::'):
                i += 2
            elif after.text == '<' and not after.spaced_before:
                while tokens[i + 1].text not in ('>', '>>'):
                    i += 1
                i += 1
            else:
                return i
        return i


def opens_block(tokens, begin, i):
    """Whether token i opens a block of statements, not a list of values. `begin`: of its bracket level."""
    before = tokens[i - 1]
    values = i > begin and before.text != 'else' and (before.kind == 'name' or before.text in ('>', '(', ',', '='))
    return tokens[i].text == '{' and not values


def atoms(source, begin, end):
    """Runs of tokens at one bracket level: (first, last, separator before, separator after) of each."""
    tokens = source.tokens
    runs, first, before, i = [], None, None, begin

    def close(separator):
        nonlocal first, before
        if first is not None:
            runs.append((first, i - 1, before, separator))
        first, before = None, separator

    while i < end:
        token = tokens[i]
        block = opens_block(tokens, begin, i)
        template = token.text in ('<', '>', '>>') and not token.spaced_before
        reference = token.text == '&' and not token.spaced_before
        if block or (token.text in SEPARATORS and not template and not reference) or token.text in KEYWORDS:
            close(token.text)
            if block and token.partner > i:
                i = token.partner
        elif first is None:
            first = i
        if tokens[i].partner > i and not block:
            i = tokens[i].partner
        i += 1
    close(None)
    return runs


def arithmetic(source, first, last):
    """Sums and products in one run: signs, terms and factors."""
    tokens = source.tokens
    if any(tokens[k].kind == 'string' for k in range(first, last + 1)):
        return
    level = []
    i = first
    while i <= last:
        level.append(i)
        if tokens[i].partner > i:
            i = tokens[i].partner
        i += 1
    operators = [i for i in level
                 if tokens[i].text in '+-*/%' and tokens[i].is_binary() and i > first and tokens[i - 1].ends_operand()]
    sums = [i for i in operators if tokens[i].text in '+-']
    for n, i in enumerate(sums):
        after = sums[n + 1] - 1 if n + 1 < len(sums) else last
        flipped = '-' if tokens[i].text == '+' else '+'
        source.add('sign', first, after, f'{source.words(first, i - 1)} {flipped} {source.words(i + 1, after)}')
        source.add('term', first, after, source.words(first, i - 1))
        if n == 0:
            source.add('term', first, after, ('-' if tokens[i].text == '-' else '') + f'({source.words(i + 1, after)})')
    begins = [first] + [i + 1 for i in sums]
    ends = [i - 1 for i in sums] + [last]
    for begin, end in zip(begins, ends):
        products = [i for i in operators if begin < i < end and tokens[i].text in '*/%']
        for n, i in enumerate(products):
            after = products[n + 1] - 1 if n + 1 < len(products) else end
            if tokens[i].text in '*/':
                source.add('factor', begin, after, source.words(begin, i - 1))
            if n == 0 and tokens[i].text == '*':
                source.add('factor', begin, after, source.words(i + 1, after))


def comparisons_and_conditions(source, begin, end):
    tokens = source.tokens
    runs = atoms(source, begin, end)
    for left, right in zip(runs, runs[1:]):
        operator = left[1] + 1
        if left[3] in FLIPPED and right[2] == left[3] and operator + 1 == right[0] and tokens[operator].is_binary():
            source.add('comparison', left[0], right[1],
                       f'{source.words(left[0], left[1])} {FLIPPED[left[3]]} {source.words(right[0], right[1])}')
    # Operands of && and ||, and what stands before a question mark.
    weaker = {',', ';', '=', '+=', '-=', '*=', '/=', '|=', '&=', '?', ':', '{', None} | KEYWORDS
    start, stops, operand, i = begin, [], begin, begin
    while i < end:
        text = tokens[i].text
        block = opens_block(tokens, begin, i)
        if text in ('&&', '||'):
            stops.append((operand, i - 1, text))
            operand = i + 1
        elif text in weaker or block:
            logical(source, start, stops, operand, i - 1)
            if text == '?' and start < i:
                source.add('condition', start, i - 1, 'true')
                source.add('condition', start, i - 1, 'false')
            start, stops, operand = i + 1, [], i + 1
        if tokens[i].partner > i:
            i = tokens[i].partner
            if block:
                start, stops, operand = i + 1, [], i + 1
        i += 1
    logical(source, start, stops, operand, end - 1)


def logical(source, start, stops, operand, last):
    if not stops or operand > last:
        return
    for n, (first, end, operator) in enumerate(stops + [(operand, last, stops[-1][2])]):
        if n < len(stops) + 1 and first <= end and source.tokens[first].text not in ('if', 'const', 'auto', 'bool'):
            source.add('condition', first, end, 'true' if operator == '&&' else 'false')


def at_token(source, i):
    """Rules about one token and its neighbours."""
    tokens = source.tokens
    token, before = tokens[i], tokens[i - 1]
    after = tokens[i + 1] if i + 1 < len(tokens) else token
    if token.text in COMPONENT and before.text == '.' and tokens[i - 2].ends_operand() and after.text != '(':
        first = source.chain_begin(i)
        source.add('component', first, i, source.words(first, i - 1) + COMPONENT[token.text])
    elif token.text in OTHER_EXTREME and after.text == '(':
        first = source.chain_begin(i)
        prefix = source.words(first, i - 1) if first < i else ''
        call = OTHER_EXTREME[token.text] + source.words(i + 1, after.partner)
        source.add('min-max', first, after.partner, prefix + call)
    elif token.kind == 'number':
        moved = moved_constant(token.text)
        if moved:
            source.add('constant', i, i, moved)
    elif token.text in source.constants:
        source.add('constant', i, i, f'{token.text} * 1.1f')
    elif token.text == '-' and not token.spaced_after and not before.ends_operand():
        source.add('sign', i, source.chain_end(i + 1), source.words(i + 1, source.chain_end(i + 1)))
    elif token.text == 'if' and after.text == '(':
        inside = [tokens[k].text for k in range(i + 2, after.partner)]
        if ';' not in inside and '=' not in inside:
            source.add('condition', i + 2, after.partner - 1, 'true')
            source.add('condition', i + 2, after.partner - 1, 'false')
    if token.kind == 'name':
        for other in other_moments(token.text):
            if other in source.known:
                last = source.chain_end(i) if after.text == '(' else i
                first = source.chain_begin(i)
                prefix = source.words(first, i - 1) if first < i else ''
                source.add('moment', first, last, prefix + other + (source.words(i + 1, last) if last > i else ''))
    if token.text == '[' and token.partner > i + 1 and token.runs:
        other_index(source, i, token.partner)
    if token.text == '(' and before.kind == 'name' and re.fullmatch(r'load_\w+', before.text) and token.partner > i + 1:
        if ',' not in [tokens[k].text for k in range(i, token.partner)]:
            other_index(source, i, token.partner)


def other_index(source, opening, closing):
    inside = source.words(opening + 1, closing - 1)
    if source.tokens[opening + 1].kind != 'string':
        source.add('index', opening + 1, closing - 1, '1' if inside in ('0', '0u', '0U') else '0')


def other_moments(name):
    for current, previous in (('CURRENT', 'PREVIOUS'), ('current', 'previous')):
        if current in name:
            yield name.replace(current, previous)
        if previous in name:
            yield name.replace(previous, current)
            yield name.replace(previous + '_', '')
    if name.startswith('load_'):
        yield 'load_previous_' + name[len('load_'):]
    yield 'previous_' + name


def moved_constant(text):
    """The literal moved by a tenth, or a small integer by 1. None where that changes nothing."""
    integer = re.fullmatch(r"(0[xX][0-9a-fA-F']+|0[bB][01']+|[0-9']+)([uUlLzZ]*)", text)
    if integer:
        value = int(integer.group(1).replace("'", ''), 0)
        moved = value + max(1, value // 10) if value < 2**28 else value ^ 1
        return f'{moved}{integer.group(2)}'
    number = re.fullmatch(r"([0-9.']+(?:[eE][+-]?[0-9]+)?)([fFlL]?)", text)
    if not number:
        return None
    value = float(number.group(1).replace("'", ''))
    if value == 0 or value > 1e37:
        return None
    digits = f'{value * 1.1:.9g}'
    return (digits if '.' in digits or 'e' in digits else digits + '.0') + number.group(2)


def find_sites(text, known=frozenset(), constants=frozenset()):
    source = Source(text, known, constants)
    tokens = source.tokens
    for i, token in enumerate(tokens):
        if token.runs:
            at_token(source, i)
        opens = token.text in ('(', '[', '{') and token.partner > i + 1
        if opens and any(tokens[k].runs for k in range(i + 1, token.partner)):
            for first, last, _, _ in atoms(source, i + 1, token.partner):
                arithmetic(source, first, last)
            comparisons_and_conditions(source, i + 1, token.partner)
    return sorted(source.sites, key=lambda s: (s.begin, -s.end, s.rule, s.wrong))
