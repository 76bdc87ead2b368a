"""Checks that every test of the sources ran and passed.

The sources decide what should have run: each TEST of test/**/*.cpp and each test method of test/rostest/*.py must be in a result file,
completed and passed; each test/rostest/*.test must have been launched, each <test> in it must have left a result; and so must the check of
the launch files. The gtest programs are asked too: each instance of a test that they list must have run, whichever part of a program that
is run in parts it fell to.

usage: check_results.py BUILD_FOLDER [--kind gtest|rostest|all] [--only NAME...]   (exit status 1 if one is missing or failed; run in
the project's root). NAME is a module with a gtest program or a launched test; without --only all are wanted.
"""

import argparse
import ast
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree as xml

DECLARATION = re.compile(r'^\s*(?:TYPED_TEST_P|TYPED_TEST|TEST_P|TEST_F|TEST)\(\s*(\w+)\s*,\s*(\w+)\s*\)', re.MULTILINE)
SANITIZED = re.compile(r'^#ifdef HOVERCRAFT_SANITIZE\n.*?^#e(?:lse|ndif)', re.MULTILINE | re.DOTALL)  # in one build alone, whose program is asked
ROSTESTS = pathlib.Path('test/rostest')
EXAMPLE = pathlib.Path('test/example_package')  # a package of its own: scripts/check_example


def plain_name(suite, name):
    """The name in the source of a test that ran: 'Some/Suite/0', 'test/3' is test of Suite; so is 'module.Suite'."""
    suite_parts = [part for part in suite.split('/') if not part.isdigit()]
    return f"{suite_parts[-1].split('.')[-1]}.{name.split('/')[0]}"


def tests_of(source):
    """The 'Suite.Name' of every test that a C++ or Python source declares."""
    text = source.read_text()
    if source.suffix == '.cpp':
        return [f'{suite}.{name}' for suite, name in DECLARATION.findall(SANITIZED.sub('', text))]
    classes = [node for node in ast.parse(text).body if isinstance(node, ast.ClassDef)]
    return [f'{node.name}.{method.name}' for node in classes for method in node.body
            if isinstance(method, ast.FunctionDef) and method.name.startswith('test_')]


class Results:
    """What the result files of a folder say."""

    def __init__(self, folder):
        self.passed = set()     # plain names
        self.instances = set()  # names in full
        self.failures = []
        self.files = sorted(folder.rglob('*.xml'))
        for file in self.files:
            try:
                cases = list(xml.parse(file).getroot().iter('testcase'))
            except xml.ParseError as error:
                self.failures.append(f'{file.name} is not complete: {error}')
                continue
            for case in cases:
                self.take(file, case)

    def take(self, file, case):
        suite = case.get('classname', '')
        name = plain_name(suite, case.get('name', ''))
        bad = case.find('failure') is not None or case.find('error') is not None
        idle = (case.find('skipped') is not None or case.get('status') == 'notrun' or
                case.get('result') in ('skipped', 'suppressed'))
        if bad or idle:
            self.failures.append(f"{file.name}: {name} {'failed' if bad else 'was skipped'}")
            return
        self.instances.add(f"{suite}.{case.get('name')}")
        self.passed.add(name)
        # Typed tests may name their types: 'Suite/Quaternion' is Suite as well.
        self.passed.update(f"{part}.{name.split('.', 1)[1]}" for part in suite.split('/'))


def launched_parts(launch):
    """The (name, program) of each <test> in a .test file."""
    return [(test.get('test-name'), test.get('type')) for test in xml.parse(launch).getroot().iter('test')]


def missing_results(launches, result_names):
    """Says which launched tests, or parts of them, left no result."""
    wanted = []
    for launch in launches:
        wanted.append((launch, f'rostest-test_rostest_{launch.stem}'))
        wanted += [(launch, f'rosunit-{name}') for name, _ in launched_parts(launch)]
    return [f'{launch}: no result {name}.xml' for launch, name in wanted if name not in result_names]


def instances_of(program):
    """The names in full of the tests that a gtest program has."""
    lines = subprocess.run([str(program), '--gtest_list_tests'], stdout=subprocess.PIPE, check=True,
                           universal_newlines=True).stdout.splitlines()
    names, suite = [], ''
    for line in lines:
        name = line.split('#')[0].strip()
        if not line.startswith(' '):
            suite = name
        elif name:
            names.append(suite + name)
    return names


def wanted_sources(kind, only):
    """Of the gtest programs, and of the launched tests."""
    launches = sorted(launch for launch in ROSTESTS.glob('*.test') if not only or launch.stem in only)
    programs = {program for launch in launches for _, program in launched_parts(launch)}
    gtests = [source for source in sorted(pathlib.Path('test').rglob('*.cpp'))
              if EXAMPLE not in source.parents and source.parent != ROSTESTS and (not only or source.parent.name in only)]
    rostests = [source for source in sorted(ROSTESTS.glob('*')) if source.suffix in ('.cpp', '.py') and
                (not only or source.name in programs or source.stem in programs)]
    return (gtests if kind != 'rostest' else []), (rostests, launches) if kind != 'gtest' else ([], [])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('build', type=pathlib.Path)
    parser.add_argument('--kind', choices=('gtest', 'rostest', 'all'), default='all')
    parser.add_argument('--only', nargs='*', default=[])
    arguments = parser.parse_args()

    gtests, (rostests, launches) = wanted_sources(arguments.kind, arguments.only)
    declared = {name: source for source in gtests + rostests for name in tests_of(source)}
    results = Results(arguments.build / 'test_results')
    complaints = list(results.failures)
    mentioned = ' '.join(complaints)
    complaints += [f'{source}: {name} did not run' for name, source in sorted(declared.items())
                   if name not in results.passed and name not in mentioned]
    programs = arguments.build / 'devel/lib/hovercraft_sim'
    for module in sorted({source.parent.name for source in gtests if tests_of(source)}):
        complaints += [f'test/{module}: {name} did not run' for name in instances_of(programs / f'hovercraft_sim_test_{module}')
                       if name not in results.instances and plain_name(*name.rsplit('.', 1)) not in mentioned]
    result_names = {file.stem for file in results.files}
    complaints += missing_results(launches, result_names)
    if arguments.kind != 'gtest' and not arguments.only and any(pathlib.Path('launch').glob('*.launch')):
        if 'roslaunch-check_launch' not in result_names:
            complaints.append('launch: no result roslaunch-check_launch.xml')
    if not results.passed:
        complaints.append('no test ran')
    if complaints:
        sys.exit('\n'.join(complaints))
    print(f'Every one of the {len(declared)} tests that the sources declare ran and passed.')


if __name__ == '__main__':
    main()
