"""Finds what a Markdown document prints to be run or copied: commands in blocks of bash and between backquotes, and files."""

import collections
import pathlib
import re
import shlex
import shutil

# kind: 'command', 'file' (text is the content, name the path) or 'fault' (text says what is wrong). block: the line where the block
# begins that it stands in; the commands of one are typed into one terminal.
Printed = collections.namedtuple('Printed', 'document line section kind text name block')

SHELL_WORDS = ('$', '.', 'source', 'export', 'cd', 'sudo', 'unset')
FENCE = re.compile(r'^```\s*(\w*)\s*$')
FILE_NAME = re.compile(r'`([^`\s]+)`:$')
HERE_DOCUMENT = re.compile(r'<<-?\s*[\'"]?(\w+)')
SPAN = re.compile(r'(?<!`)`([^`]+)`(?!`)')


def is_command(text, tools):
    """Whether a text begins with a program and goes on."""
    words = text.split()
    if len(words) < 2:
        return False
    return words[0] in SHELL_WORDS or words[0] in tools or (
        '/' in words[0] and (words[0].startswith('build') or pathlib.Path(words[0]).is_file())) or (
        re.fullmatch(r'[\w-]+', words[0]) is not None and shutil.which(words[0], path='/usr/bin:/bin') is not None)


def commands_of(lines):
    """(offset, command) of each command of a block: what a quote, a backslash or << goes on with belongs to it."""
    command, begin = '', 0
    for offset, line in enumerate(lines):
        if not command and (not line.strip() or line.lstrip().startswith('#')):
            continue
        begin = begin if command else offset
        command += line
        try:
            shlex.split(command, comments=True)
        except ValueError:
            command += '\n'
            continue
        document = HERE_DOCUMENT.search(command)
        if command.endswith('\\') or document and line.strip() != document.group(1):
            command += '\n'
            continue
        yield begin, re.sub(r'\s+#.*$', '', command)
        command = ''
    if command:
        yield begin, command


class Reader:
    def __init__(self, document, languages_of_texts, tools, checked_elsewhere=()):
        self.document, self.texts, self.tools, self.checked_elsewhere = document, languages_of_texts, tools, checked_elsewhere
        self.section, self.found = '', []

    def add(self, line, kind, text, name='', block=0):
        self.found.append(Printed(self.document, line, self.section, kind, text, name, block))

    def read(self, text):
        lines = text.splitlines()
        paragraph, begin, at = [], 0, 0
        while at < len(lines):
            fence = FENCE.match(lines[at])
            if fence or not lines[at].strip():
                self.prose(begin, paragraph)
                last, paragraph = paragraph[-1:] or last_of(lines, at), []
            if fence:
                end = next((n for n in range(at + 1, len(lines)) if lines[n].startswith('```')), len(lines))
                self.block(at + 2, fence.group(1), lines[at + 1:end], last[0] if last else '')
                at = end
            elif lines[at].strip():
                begin = begin if paragraph else at + 1
                if lines[at].startswith('#'):
                    self.section = lines[at].lstrip('# ')
                paragraph.append(lines[at])
            at += 1
        self.prose(begin, paragraph)
        return self.found

    def prose(self, line, paragraph):
        for offset, text in enumerate(paragraph):
            if text.startswith('    ') and is_command(text, self.tools):
                self.add(line + offset, 'fault', f'an indented command, which nothing runs: {text.strip()}')
        for span in SPAN.findall('\n'.join(paragraph)):
            text = ' '.join(span.split())
            if is_command(text, self.tools):
                self.add(line, 'command', text)

    def block(self, line, language, lines, before):
        name = FILE_NAME.search(before)
        if language in ('bash', 'sh'):
            for offset, command in commands_of(lines):
                self.add(line + offset, 'command', command, block=line)
        elif language in self.checked_elsewhere:
            return
        elif language in self.texts:
            for offset, text in enumerate(lines):
                if is_command(text, self.tools):
                    self.add(line + offset, 'fault', f'a command in a block of text, which nothing runs: {text}')
        elif name:
            self.add(line, 'file', '\n'.join(lines) + '\n', name.group(1))
        else:
            self.add(line, 'fault', f'a block of {language} without the name of its file in the line before: `PATH`:')


def last_of(lines, at):
    """The last line before one that is not empty."""
    return [line for line in lines[:at] if line.strip()][-1:]


def read(document, languages_of_texts, tools, checked_elsewhere=()):
    return Reader(document, languages_of_texts, tools, checked_elsewhere).read(pathlib.Path(document).read_text())


SAMPLE = """
Say `simulate
a.yaml`, or simulate: `simulate`, `time,rear`.

    simulate indented.yaml

```bash
# a comment
simulate '{x: 1,
  y: 2}' # another
cat > f << 'END'
text
END
```

`a/b.xml`:

```xml
<a/>
```

```xml
<nameless/>
```

```text
simulate hidden.yaml
identical: 3 ticks
```
"""
IN_SAMPLE = [
    ('command', 'simulate a.yaml', ''), ('fault', 'an indented command, which nothing runs: simulate indented.yaml', ''),
    ('command', "simulate '{x: 1,\n  y: 2}'", ''), ('command', "cat > f << 'END'\ntext\nEND", ''), ('file', '<a/>\n', 'a/b.xml'),
    ('fault', 'a block of xml without the name of its file in the line before: `PATH`:', ''),
    ('fault', 'a command in a block of text, which nothing runs: simulate hidden.yaml', '')]


def check_reader():
    """Nothing that is printed may be overlooked: what is found in a sample is what is in it."""
    found = [(item.kind, item.text, item.name) for item in Reader('sample', ('text',), ['simulate']).read(SAMPLE)]
    if found != IN_SAMPLE:
        raise AssertionError(f'printed.py finds {found}')
