"""Checks that every test of the sources ran and passed.

The sources decide what should have run: each TEST of test/**/*.cpp and each test method of test/rostest/*.py must be
in a result file, completed and passed; each test/rostest/*.test must have been launched, each <test> in it must have left a result; and so must the check of
the launch files.

usage: check_results.py BUILD_FOLDER [--kind gtest|rostest|all]   (exit status 1 if one is missing or failed; run in
the project's root)
"""

import argparse
import ast
import pathlib
import re
import sys
import xml.etree.ElementTree as xml

DECLARATION = re.compile(r'^\s*(?:TYPED_TEST_P|TYPED_TEST|TEST_P|TEST_F|TEST)\(\s*(\w+)\s*,\s*(\w+)\s*\)', re.MULTILINE)
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
        return [f'{suite}.{name}' for suite, name in DECLARATION.findall(text)]
    classes = [node for node in ast.parse(text).body if isinstance(node, ast.ClassDef)]
    return [f'{node.name}.{method.name}' for node in classes for method in node.body
            if isinstance(method, ast.FunctionDef) and method.name.startswith('test_')]


def read_results(folder):
    """Returns the plain names of the gtests that ran and passed, the failures, and the names of all result files."""
    passed, failures = set(), []
    files = sorted(folder.rglob('*.xml'))
    for file in files:
        try:
            cases = list(xml.parse(file).getroot().iter('testcase'))
        except xml.ParseError as error:
            failures.append(f'{file.name} is not complete: {error}')
            continue
        for case in cases:
            name = plain_name(case.get('classname', ''), case.get('name', ''))
            bad = case.find('failure') is not None or case.find('error') is not None
            idle = (case.find('skipped') is not None or case.get('status') == 'notrun' or
                    case.get('result') in ('skipped', 'suppressed'))
            if bad or idle:
                failures.append(f"{file.name}: {name} {'failed' if bad else 'was skipped'}")
            else:
                passed.add(name)
                # Typed tests may name their types: 'Suite/Quaternion' is Suite as well.
                passed.update(f"{part}.{name.split('.', 1)[1]}" for part in case.get('classname', '').split('/'))
    return passed, failures, {file.stem for file in files}


def missing_results(result_names):
    """Says which launched tests, or parts of them, left no result."""
    wanted = [('launch', 'roslaunch-check_launch')] if any(pathlib.Path('launch').glob('*.launch')) else []
    for launch in sorted(ROSTESTS.glob('*.test')):
        wanted.append((launch, f'rostest-test_rostest_{launch.stem}'))
        wanted += [(launch, f"rosunit-{test.get('test-name')}") for test in xml.parse(launch).getroot().iter('test')]
    return [f'{launch}: no result {name}.xml' for launch, name in wanted if name not in result_names]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('build', type=pathlib.Path)
    parser.add_argument('--kind', choices=('gtest', 'rostest', 'all'), default='all')
    arguments = parser.parse_args()

    sources = sorted(pathlib.Path('test').rglob('*.cpp')) + sorted(ROSTESTS.glob('*.py'))
    sources = [source for source in sources
               if EXAMPLE not in source.parents and
               arguments.kind in ('all', 'rostest' if ROSTESTS in source.parents else 'gtest')]
    declared = {name: source for source in sources for name in tests_of(source)}
    passed, complaints, result_names = read_results(arguments.build / 'test_results')
    mentioned = ' '.join(complaints)
    complaints += [f'{source}: {name} did not run' for name, source in sorted(declared.items())
                   if name not in passed and name not in mentioned]
    if arguments.kind != 'gtest':
        complaints += missing_results(result_names)
    if not passed:
        complaints.append('no test ran')
    if complaints:
        sys.exit('\n'.join(complaints))
    print(f'Every one of the {len(declared)} tests that the sources declare ran and passed.')


if __name__ == '__main__':
    main()
