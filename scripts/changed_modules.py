"""Prints the modules whose gtest program has to run again: what it is made of has changed since it passed.

A program is made of the tests of its module, of that module, and of those below it: whatever their sources include, and what these sources
include in turn. What all share (test/support, test/data, config, CMake files) and, where ROS is among it, programs and messages count too.
The program of `architecture` reads every source, and always runs.

usage: changed_modules.py BUILD_FOLDER [passed [MODULE...]]   (run in the project's root)
Without `passed`, before the build: notes what the programs are about to be made of. With it, after they passed: keeps that of these modules
(of all), unless a file was changed meanwhile.
"""

import hashlib
import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s+"hovercraft_sim/(\w+)/', re.MULTILINE)
SHARED = ('test/support', 'test/data', 'test/main.cpp', 'config', 'cmake', 'CMakeLists.txt')
OF_ROS = ('src/nodes', 'src/tools', 'msg', 'srv', 'cfg', 'launch', 'examples', 'package.xml', 'scripts')
ALWAYS = 'architecture'
ROS_MODULES = ('messages', 'bags', 'view', 'live', 'clients')  # their tests may use test/support/*.cpp


def files_of(*places):
    """Every file there, in a fixed order; places that are not there have none."""
    paths = [path for place in places
             for path in ([pathlib.Path(place)] if pathlib.Path(place).is_file() else pathlib.Path(place).rglob('*'))]
    return sorted(path for path in set(paths) if path.is_file() and '__pycache__' not in path.parts)


def modules_included_by(*places):
    return {module for path in files_of(*places) if path.suffix in ('.h', '.cpp') for module in INCLUDE.findall(path.read_text())}


def modules_under(module):
    """What the program of a module is made of."""
    found, waiting = set(), {module} | modules_included_by(f'test/{module}', 'test/support' if module in ROS_MODULES else f'test/{module}')
    while waiting:
        module = waiting.pop()
        found.add(module)
        waiting |= modules_included_by(f'include/hovercraft_sim/{module}', f'src/{module}') - found
    return found


def digest_of(module):
    parts = modules_under(module)
    places = [*SHARED, f'test/{module}', *(f'include/hovercraft_sim/{part}' for part in parts), *(f'src/{part}' for part in parts)]
    if 'messages' in parts:
        places += OF_ROS
    digest = hashlib.sha256()
    for path in files_of(*places):
        digest.update(str(path).encode() + b'\0' + hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()


def main():
    noted, passed = (pathlib.Path(sys.argv[1]) / 'gtests' / name for name in ('noted', 'passed'))
    for folder in (noted, passed):
        folder.mkdir(parents=True, exist_ok=True)
    modules = sorted({path.parent.name for path in pathlib.Path('test').glob('*/test_*.cpp')})
    if sys.argv[2:3] == ['passed']:
        for module in sys.argv[3:] or modules:
            digest = digest_of(module)
            if (noted / module).read_text() == digest:
                (passed / module).write_text(digest)
        return
    for module in modules:
        digest = digest_of(module)
        (noted / module).write_text(digest)
        if module == ALWAYS or not (passed / module).exists() or (passed / module).read_text() != digest:
            print(module)


if __name__ == '__main__':
    main()
