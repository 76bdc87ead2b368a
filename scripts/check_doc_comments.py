"""Lists what the installed headers declare without a comment, and fails if there is anything.

    python3 scripts/check_doc_comments.py [--counts] [HEADER...]     # all installed headers by default

A comment is one of /// or // directly above a declaration, or one behind it on its line. One above functions or constants that follow line by
line is of all of them. Needless for: overloads of what has a comment, what overrides, is defaulted or deleted, destructors, enumerators,
forward declarations, and what is not public.
"""
import pathlib
import re
import sys

INCLUDE = pathlib.Path('include/hovercraft_sim')
LIST = pathlib.Path('cmake/public_headers.cmake')
NEEDLESS = re.compile(r'^(friend|static_assert|extern template|using namespace)\b|\b(override|final)\b|=\s*(default|delete)$|^(class|struct|enum|'
                      r'template\s*<[^>]*>\s*(class|struct))\s+[\w ]+$|~\w+\(|^using \w+::[\w:]+$')
NOISE = re.compile(r'\bHOVERCRAFT_PUBLIC\b|\[\[[^\]]*\]\]|\balignas\([^)]*\)')


def installed():
    """The headers of the list and what they include."""
    waiting = re.findall(r'\b[a-z]+/[a-z0-9_]+\.h\b', LIST.read_text().split('set(hovercraft_public_headers')[1].split(')')[0])
    found = []
    while waiting:
        header = waiting.pop(0)
        if header not in found:
            found.append(header)
            waiting += re.findall(r'^#include "hovercraft_sim/([a-z]+/[a-z0-9_]+\.h)"', (INCLUDE / header).read_text(), re.MULTILINE)
    return [INCLUDE / header for header in sorted(found)]


def blanked(text):
    """The code alone: comments, texts and directives are spaces."""
    pattern = r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*'
    return re.sub(pattern, lambda m: re.sub(r'[^\n]', ' ', m[0]), text, flags=re.MULTILINE | re.DOTALL)


def closing(code, at):
    """Where the brace, parenthesis or bracket at `at` ends."""
    depth = 0
    for i in range(at, len(code)):
        depth += (code[i] in '{([') - (code[i] in '})]')
        if depth == 0:
            return i
    return len(code) - 1


def scopes_and_statements(code, begin, end, is_public, out):
    """Adds (begin, end, text) of each public declaration between two places."""
    at = start = begin
    while at < end:
        c = code[at]
        text = ' '.join(code[start:at].split())
        if c == ':' and text in ('public', 'private', 'protected'):
            is_public = text == 'public'
            start = at + 1
        elif c in '([':
            at = closing(code, at)
        elif c == ';':
            if text and is_public:
                out.append((start, at, text))
            start = at + 1
        elif c == '{':
            close = closing(code, at)
            plain = NOISE.sub('', re.sub(r'template\s*<.*?>\s*(?=class|struct|inline|constexpr|\w)', '', text)).strip()
            kind = re.match(r'(?:inline )?(namespace|class|struct|union|enum)\b', plain)
            if kind and kind[1] != 'namespace' and is_public:
                out.append((start, at, text))
            if kind and kind[1] == 'namespace':
                scopes_and_statements(code, at + 1, close, True, out)
            elif kind and kind[1] in ('class', 'struct', 'union') and is_public:
                scopes_and_statements(code, at + 1, close, kind[1] != 'class', out)
            if not kind and not text.endswith(')') and not re.search(r'\)\s*(const|noexcept|override|final|&|->.*|:.*)*$', text):
                at = close + 1  # a value in braces, up to its semicolon
                continue
            if not kind and is_public:
                out.append((start, close, text))
            at = close
            start = close + 1
            rest = re.match(r'\s*;', code[start:])
            if rest:
                at += rest.end()
                start = at + 1
        at += 1


def name_of(text):
    text = NOISE.sub('', text)
    text = re.sub(r'^template\s*<(?:[^<>]|<[^<>]*>)*>\s*', '', text)
    kind = re.match(r'\s*(?:class|struct|union|enum class|enum)\s+(\w+)', text)
    if kind:
        return kind[1]
    before = text.split('(')[0] if '(' in text else text.split('=')[0].split('{')[0].split('[')[0]
    words = re.findall(r'operator\W+|[\w~]+', before if 'operator' not in text else text.split('=')[0])
    using = re.match(r'\s*using\s+(\w+)', text)
    return using[1] if using else (words[-1].strip() if words else text)


def is_commented(lines, row, last):
    above = lines[row - 1].strip() if row > 0 else ''
    return above.startswith('//') or any('//' in line for line in lines[row:last + 1])


def check(path):
    """(declarations, [(line, name) without a comment])"""
    text = path.read_text()
    code = blanked(text)
    lines = text.split('\n')
    found = []
    scopes_and_statements(code, 0, len(code), True, found)
    count, bare, commented = 0, [], set()
    group = -1  # the line behind declarations that share a comment
    for begin, end, statement in found:
        if NEEDLESS.search(NOISE.sub('', statement).strip()):
            continue
        name = name_of(statement)
        count += 1
        row = code.count('\n', 0, begin + len(code[begin:end]) - len(code[begin:end].lstrip()))
        shares = row == group and re.search(r'\(|^(static |inline )*constexpr', statement)
        if is_commented(lines, row, code.count('\n', 0, end)) or shares:
            commented.add(name)
            if shares or (row > 0 and lines[row - 1].strip().startswith('///')):
                group = code.count('\n', 0, end) + 1
        elif name not in commented:
            bare.append((row + 1, name))
    return count, bare


def main():
    headers = [pathlib.Path(p) for p in sys.argv[1:] if not p.startswith('--')] or installed()
    total = missing = 0
    for path in headers:
        count, bare = check(path)
        total += count
        missing += len(bare)
        if '--counts' in sys.argv:
            if bare:
                print(f'{path}: {len(bare)} of {count}')
            continue
        for line, name in bare:
            print(f'{path}:{line}: {name} has no comment')
    print(f'{total - missing} of {total} public declarations in {len(headers)} headers have a comment')
    return 1 if missing else 0


if __name__ == '__main__':
    sys.exit(main())
