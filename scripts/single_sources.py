"""Writes the compile database of a build in which each source stands by itself, also those that are compiled together (HOVERCRAFT_UNITY):
for clang-tidy, which looks at each source with the options that it is compiled with.

usage: single_sources.py BUILD_FOLDER FOLDER   (FOLDER/compile_commands.json is written)
"""

import json
import pathlib
import re
import sys

PRECOMPILED = re.compile(r' -Winvalid-pch\b| -(?:Xclang )?include(?:-pch)? (?:-Xclang )?\S*/cmake_pch\.hxx\S*')
INCLUDED = re.compile(r'^#include "(/.+\.cpp)"$', re.MULTILINE)


def entries_of(entry):
    """The entry itself, or one for each source that its file includes; without precompiled headers."""
    entry = dict(entry, command=PRECOMPILED.sub('', entry['command']))
    if 'cmake_pch.' in entry['file']:
        return []
    file = pathlib.Path(entry['directory'], entry['file'])
    if file.parent.name != 'Unity':
        return [entry]
    return [{'directory': entry['directory'], 'file': source, 'command': entry['command'].replace(entry['file'], source)}
            for source in INCLUDED.findall(file.read_text())]


def main():
    build, folder = map(pathlib.Path, sys.argv[1:])
    database = json.loads((build / 'compile_commands.json').read_text())
    folder.mkdir(parents=True, exist_ok=True)
    single = [each for entry in database for each in entries_of(entry)]
    (folder / 'compile_commands.json').write_text(json.dumps(single, indent=1))


if __name__ == '__main__':
    main()
