"""Checks the Markdown documents: links to files and headings, pictures, and the width of lines. Run in the root; no network.

usage: check_documents.py [--wrap]   (exit status 1 if something is wrong; --wrap first wraps the paragraphs that are too wide)

A link to a file must lead to one, and `#heading` to a heading of it. Each picture in doc/ is shown by a document. Lines have at most
120 columns, but for tables, code, pictures, and a word that is longer. README.md has at most 150 lines.
"""

import collections
import pathlib
import re
import subprocess
import sys

MAX_COLUMNS = 120
MAX_LINES_OF_README = 150  # what a reader in a hurry looks at
LINK = re.compile(r'!?\[(?:[^\[\]]|\[[^\]]*\])*\]\(([^()\s]+(?:\([^()]*\))?)\)')
HEADING = re.compile(r'^#{1,6} (.*)$')
FENCE = re.compile(r'^\s*```')

ITEM = re.compile(r'^\s*([-*]|\d+\.)\s+')
# What would be a list, a heading or a table at the begin of a line.
NO_BEGIN = re.compile(r'^([-+*>#=]+|\d+\.)$|^\||^```')

Line = collections.namedtuple('Line', 'number text is_code')


def lines_of(text):
    is_code = False
    for number, line in enumerate(text.splitlines(), 1):
        if FENCE.match(line):
            is_code = not is_code
            yield Line(number, line, True)
        else:
            yield Line(number, line, is_code)


def anchor(heading):
    """The anchor of a heading, as GitHub makes it."""
    text = re.sub(r'\[([^\]]*)\]\([^)]*\)', r'\1', heading)
    return re.sub(r'[^\w\- ]', '', text.strip().lower()).replace(' ', '-')


def anchors(text):
    found, counts = set(), collections.Counter()
    for line in lines_of(text):
        heading = HEADING.match(line.text)
        if heading and not line.is_code:
            name = anchor(heading.group(1))
            found.add(f'{name}-{counts[name]}' if counts[name] else name)
            counts[name] += 1
    return found


def without_code(text):
    """The text, its code blanked out: what stands between backquotes is no link."""
    blanked = '\n'.join('' if line.is_code else line.text for line in lines_of(text))
    return re.sub(r'`[^`]+`', lambda code: re.sub(r'[^\n]', '.', code.group(0)), blanked)


def links(text):
    """(line, target) of each link."""
    readable = without_code(text)
    return [(readable.count('\n', 0, link.start()) + 1, link.group(1)) for link in LINK.finditer(readable)]


def wrong_link(path, target):
    """What is wrong with a link, or None."""
    if re.match(r'[a-z]+:', target):
        return None
    file, _, heading = target.partition('#')
    there = (path.parent / file) if file else path
    if not there.exists():
        return f'there is no {target}'
    if heading and heading not in anchors(there.read_text()):
        return f'{there} has no heading #{heading}'
    return None


def too_wide(line):
    text = line.text
    if line.is_code or len(text) <= MAX_COLUMNS or text.startswith(('|', '![', '    ')):
        return False
    return ' ' in text.strip().lstrip('-*0123456789. ')


def problems_of(path):
    text = path.read_text()
    found = [(number, wrong) for number, target in links(text) for wrong in [wrong_link(path, target)] if wrong]
    found += [(line.number, f'{len(line.text)} columns, more than {MAX_COLUMNS}') for line in lines_of(text) if too_wide(line)]
    return [f'{path}:{number}: {wrong}' for number, wrong in sorted(found)]


def wrapped(paragraph):
    """The lines of a paragraph or of an item of a list, wrapped if one of them is too wide."""
    if not any(too_wide(Line(0, text, False)) for text in paragraph):
        return paragraph
    item = ITEM.match(paragraph[0])
    indent = re.match(r'\s*', paragraph[0]).group(0)
    rest = ' ' * len(item.group(0)) if item else indent
    lines, words = [], ' '.join(text.strip() for text in paragraph).split(' ')
    line = indent + words[0]
    for word in words[1:]:
        if len(line) + 1 + len(word) > MAX_COLUMNS and not NO_BEGIN.match(word):
            lines.append(line)
            line = rest + word
        else:
            line += ' ' + word
    return lines + [line]


def wrap(path):
    text = path.read_text()
    found, paragraph = [], []
    for line in lines_of(text + '\n'):
        stands_alone = line.is_code or not line.text.strip() or line.text.startswith(('|', '#', '![', '    '))
        if stands_alone or ITEM.match(line.text):
            found += wrapped(paragraph) if paragraph else []
            paragraph = []
        if stands_alone:
            found.append(line.text)
        else:
            paragraph.append(line.text)
    found += wrapped(paragraph) if paragraph else []
    new = '\n'.join(found).rstrip('\n') + '\n'
    if new.split() != text.split():
        raise AssertionError(f'{path}: wrapping would change more than spaces')
    if new != text:
        path.write_text(new)


def unused_pictures(documents):
    shown = {(path.parent / target).resolve() for path in documents for _, target in links(path.read_text())}
    pictures = [picture for end in ('png', 'svg') for picture in pathlib.Path('doc').rglob(f'*.{end}')]
    return [f'{picture}: no document shows it' for picture in sorted(pictures) if picture.resolve() not in shown]


def all_documents():
    if pathlib.Path('.git').exists():
        names = subprocess.run(['git', 'ls-files', '-z', '--cached', '--others', '--exclude-standard', '*.md'], check=True,
                               stdout=subprocess.PIPE).stdout.decode().split('\0')
    else:
        names = [str(path) for path in pathlib.Path('.').rglob('*.md') if not re.match(r'build|out/|web/node_modules', str(path))]
    return [pathlib.Path(name) for name in sorted(set(names)) if name and pathlib.Path(name).exists()]


SAMPLE = '''# A [b](c) `d`, e
```
[no](link)
```
`[no](link)` [one](x.md#a) [two
lines](#b) ![p](q.png)
# A b d, e
'''


def check_reader():
    """What finds nothing in the sample would find nothing anywhere."""
    found = (anchors(SAMPLE), links(SAMPLE)[-3:], too_wide(Line(1, 'word ' * 30, False)), too_wide(Line(1, '| word ' * 30, False)))
    expected = ({'a-b-d-e', 'a-b-d-e-1'}, [(5, 'x.md#a'), (5, '#b'), (6, 'q.png')], True, False)
    if found != expected:
        raise AssertionError(f'check_documents.py finds {found}')


def main():
    check_reader()
    documents = all_documents()
    if sys.argv[1:] not in ([], ['--wrap']):
        sys.exit(__doc__)
    for path in documents if sys.argv[1:] else []:
        wrap(path)
    problems = [problem for path in documents for problem in problems_of(path)] + unused_pictures(documents)
    readme = len(pathlib.Path('README.md').read_text().splitlines())
    if readme > MAX_LINES_OF_README:
        problems.append(f'README.md: {readme} lines, more than {MAX_LINES_OF_README}')
    if problems:
        sys.exit('\n'.join(problems))
    print(f'{len(documents)} documents: links, headings, pictures and widths are right.')


if __name__ == '__main__':
    main()
