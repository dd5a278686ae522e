"""A tokenizer for this project's C++ and GLSL, and which of its tokens are code that runs: bodies of functions, without
what the compiler evaluates (constexpr, case labels, template arguments, array bounds) and without messages (throw,
fmt::format).

It relies on the project's clang-format style: a binary operator has white space on both sides, an opening angle bracket
has none before it, and `*` and `&` of a type stand next to that type.
"""
import re
from dataclasses import dataclass

PATTERN = re.compile(r'''
    (?P<space>\s+)
  | (?P<comment>//[^\n]*|/\*.*?\*/)
  | (?P<string>(?:u8|[uUL])?R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)"|(?:u8|[uUL])?"(?:\\.|[^"\\\n])*")
  | (?P<char>'(?:\\.|[^'\\\n])+')
  | (?P<number>\.?[0-9](?:[eEpP][+-]|'(?=[0-9a-fA-F])|[\w.])*)
  | (?P<name>[A-Za-z_]\w*)
  | (?P<punct><<=|>>=|<=>|->\*|\.\.\.|::|->|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|.)
''', re.X | re.S)
DIRECTIVE = re.compile(r'[ \t]*#(?:[^\n\\]|\\.)*', re.S)
CLOSING = {'(': ')', '[': ']', '{': '}'}
# Parentheses after these names hold nothing that a program computes, or only messages.
UNEVALUATED = {'static_assert', 'assert', 'sizeof', 'decltype', 'alignas', 'alignof', 'noexcept', 'offsetof',
               'ASSERT_SIZE', 'ASSERT_OFFSET'}
KEYWORDS = {'return', 'else', 'do', 'throw', 'new', 'delete', 'case', 'co_return', 'goto', 'const', 'if', 'while',
            'for', 'switch', 'static', 'auto', 'typename', 'try', 'catch', 'default', 'PRECISE', 'LOCAL'}


@dataclass
class Token:
    kind: str
    text: str
    begin: int
    line: int
    spaced_before: bool = False
    spaced_after: bool = False
    partner: int = -1    # of a bracket: the index of its other one
    runs: bool = False   # code that may be mutated

    @property
    def end(self):
        return self.begin + len(self.text)

    def ends_operand(self):
        return self.kind in ('number', 'string', 'char') or self.text in (')', ']', '}') or (
            self.kind == 'name' and self.text not in KEYWORDS)

    def is_binary(self):
        return self.spaced_before and self.spaced_after


def tokenize(text):
    """The tokens of a source, without white space, comments and preprocessor lines."""
    tokens, position, line, spaced, fresh = [], 0, 1, True, True
    while position < len(text):
        directive = DIRECTIVE.match(text, position) if fresh else None
        match = directive or PATTERN.match(text, position)
        kind = 'directive' if directive else match.lastgroup if match.lastgroup != 'mark' else 'string'
        piece = match.group()
        if kind in ('space', 'comment', 'directive'):
            spaced = True
            if tokens:
                tokens[-1].spaced_after = True
            fresh = fresh and kind == 'comment' or '\n' in piece and kind == 'space' or kind == 'directive'
        else:
            tokens.append(Token(kind, piece, position, line, spaced_before=spaced))
            spaced = fresh = False
        line += piece.count('\n')
        position = match.end()
    match_brackets(tokens)
    mark_running(tokens)
    return tokens


def match_brackets(tokens):
    open_brackets = []
    for i, token in enumerate(tokens):
        if token.kind != 'punct':
            continue
        if token.text in CLOSING:
            open_brackets.append(i)
        elif open_brackets and CLOSING[tokens[open_brackets[-1]].text] == token.text:
            token.partner = open_brackets.pop()
            tokens[token.partner].partner = i


def mark_running(tokens):
    i = 0
    while i < len(tokens):
        if tokens[i].text == '{' and tokens[i].partner > i and begins_function(tokens, i):
            for k in range(i + 1, tokens[i].partner):
                tokens[k].runs = True
            leave_out_constants(tokens, i + 1, tokens[i].partner)
            i = tokens[i].partner
        i += 1


def begins_function(tokens, brace):
    """Whether the brace opens the body of a function that runs, seen from outside of any function."""
    i = brace - 1
    while i >= 0 and tokens[i].text in ('const', 'noexcept', 'override', 'final'):
        i -= 1
    if i < 0 or tokens[i].text != ')':
        return False
    while i >= 0 and tokens[i].text not in (';', '{', '}'):
        if tokens[i].text in ('constexpr', 'consteval', 'struct', 'class', 'enum', 'namespace', 'CONST'):
            return False
        i = tokens[i].partner - 1 if tokens[i].partner >= 0 and tokens[i].partner < i else i - 1
    return True


def angle_end(tokens, i):
    """The index of the bracket that closes the template arguments which tokens[i] opens, or -1."""
    depth = 0
    for k in range(i, min(i + 80, len(tokens))):
        text = tokens[k].text
        if text == '<':
            depth += 1
        elif text in ('>', '>>'):
            depth -= len(text)
            if depth <= 0:
                return k
        elif text in (';', '{'):
            return -1
    return -1


def statement_end(tokens, i, end):
    while i < end and tokens[i].text not in (';',):
        i = tokens[i].partner if tokens[i].partner > i else i
        i += 1
    return i


def leave_out(tokens, begin, end):
    for k in range(begin, end):
        tokens[k].runs = False


def leave_out_constants(tokens, begin, end):
    for i in range(begin, end):
        token = tokens[i]
        before = tokens[i - 1]
        if token.text == 'constexpr' and before.text == 'if':
            leave_out(tokens, i, tokens[i + 1].partner + 1)
        elif token.text in ('constexpr', 'CONST', 'throw', 'using', 'template'):
            leave_out(tokens, i, statement_end(tokens, i, end))
        elif token.text == 'case':
            k = i
            while k < end and tokens[k].text != ':':
                k += 1
            leave_out(tokens, i, k)
        elif token.text == '(' and (before.text in UNEVALUATED
                                    or before.text == 'format' and tokens[i - 2].text == '::'):
            leave_out(tokens, i, token.partner)
        elif token.text == '<' and not token.spaced_before and before.kind == 'name':
            leave_out(tokens, i, angle_end(tokens, i) + 1)
        elif token.text == '[' and token.partner > i and not is_subscript(tokens, i):
            leave_out(tokens, i, token.partner + 1)
        elif token.text == '(' and before.text == 'MUTANT':
            leave_out(tokens, i, i + 2)
            commas = [k for k in top_level(tokens, i + 1, token.partner) if tokens[k].text == ',']
            leave_out(tokens, commas[1], token.partner)


def is_subscript(tokens, i):
    """Whether tokens[i] opens a subscript: no lambda's captures, attribute, structured binding or array bound."""
    before = tokens[i - 1]
    if before.text in ('auto', '&', '[') or not before.ends_operand() or before.text == '}':
        return False
    typed = tokens[i - 2]
    declares = before.kind == 'name' and (typed.kind == 'name' and typed.text not in ('return', 'else')
                                          or typed.text == '>' and not typed.spaced_before)
    return not declares


def top_level(tokens, begin, end):
    """Indices in [begin, end) that lie in no bracket within it; of a bracket both."""
    i = begin
    while i < end:
        yield i
        if tokens[i].partner > i:
            i = tokens[i].partner
            if i < end:
                yield i
        i += 1
