"""Paragraphs of debian/copyright for what is bundled into the page.

usage: third_party.py THIRD_PARTY_NOTICES.txt     (web/build.mjs writes the notices: "NAME VERSION (LICENSE)", then its text)
"""

import pathlib
import re
import sys

HEADING = re.compile(r'^(\S+) (\S+) \((\S+)\)$', re.MULTILINE)
COPYRIGHT = re.compile(r'^Copyright (?:\(c\)|©) (.*)$', re.MULTILINE)


def works_of(path):
    """(name, version, license, text) of each."""
    notices = pathlib.Path(path).read_text(encoding='utf-8')
    headings = list(HEADING.finditer(notices))
    if not headings:
        raise ValueError(f'{path}: names no work of others')
    ends = [heading.start() for heading in headings[1:]] + [len(notices)]
    return [(*heading.groups(), notices[heading.end():end].strip()) for heading, end in zip(headings, ends)]


def main():
    works = works_of(sys.argv[1])
    owners = []
    for name, version, _, text in works:
        found = COPYRIGHT.findall(text)
        if not found:
            raise ValueError(f'{name} {version}: its notice has no line "Copyright"')
        owners += [f'{owner} ({name} {version})' for owner in found]
    print('\nFiles: web/dist/*\nCopyright: 2026 The hovercraft_sim authors\n ' + '\n '.join(owners))
    print('License: ' + ' and '.join(['BSD-3-Clause', *(f'{license_name}-{name}' for name, _, license_name, _ in works)]))
    for name, _, license_name, text in works:
        print(f'\nLicense: {license_name}-{name}')
        print('\n'.join(' ' + (line.strip() or '.') for line in text.splitlines()))


if __name__ == '__main__':
    main()
