"""Runs clang-tidy on every source of the project that a compile database names.

A source that was found clean is not looked at again, in any checkout, until what decides changes: the source, a header or message of the
project that it includes, its compile command, the configuration, clang-tidy, or a package whose headers it reads. What was found clean is
kept in $XDG_CACHE_HOME/hovercraft_sim (~/.cache/hovercraft_sim) by content, not by time, so a CI can keep that folder.

Sources of test/ and bench/ are looked at in batches, each read as one file: most of their time is the headers they share. The sources that the
static analyzer sees (src/, examples/) are looked at one by one: in a batch it passes over a function that another one calls, and knows its
arguments only from there. scripts/check_linters shows that nothing is lost.

usage: clang_tidy.py BUILD_FOLDER   (exit status 1 if there is a finding; run in the project's root)
"""

import collections
import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import re
import resource
import shlex
import subprocess
import sys
import tempfile
import time

CLANG_TIDY = 'clang-tidy-22'
ROOT = pathlib.Path.cwd()
FOLDERS = ('src', 'test', 'bench', 'examples')
WITHOUT_ANALYZER = '-clang-analyzer-*'
SOURCES_OF_A_BATCH = 8
KEPT_DAYS = 30  # a result that nobody asked for so long is thrown away
# The analyzer gives up on a function after that many states: a third of the default, as in its shallow mode. Functions that take more
# than that are few (calls of roscpp and rosbag), and give up at the default too, three times as late.
ANALYZER = [f'--extra-arg={argument}' for argument in ('-Xclang', '-analyzer-config', '-Xclang', 'max-nodes=75000')]
# stable_sort of libstdc++ 12 calls what C++17 deprecates; what of ours is deprecated, the compilers say, and a warning is an error.
WARNINGS = ['--extra-arg=-Wno-deprecated-declarations']
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)
INCLUDED_MESSAGE = re.compile(r'^\s*#\s*include\s+<hovercraft_sim/\w+\.h>', re.MULTILINE)
# What may clash where sources are read as one: the names that are declared at the beginning of a line.
DECLARED = re.compile(r'^(?:struct|class|enum class|enum|#\s*define) (\w+)|^using (\w+) =|'
                      r'^(?![A-Z_]+\(|namespace|using)(?=[A-Za-z_])[^\n(=;]*?\b(\w+)(?:\[\w*\])?(?:\(| =|;| ?\{)', re.MULTILINE)
USING = re.compile(r'^using ([\w:]+);', re.MULTILINE)

Source = collections.namedtuple('Source', 'path arguments key')


@functools.lru_cache(maxsize=None)
def text_of(path):
    return path.read_text()


@functools.lru_cache(maxsize=None)
def project_files(source):
    """The source and every header of the project that it includes, directly or not, in a fixed order."""
    found, waiting = set(), [source]
    while waiting:
        path = waiting.pop()
        if path in found:
            continue
        found.add(path)
        for name in INCLUDE.findall(text_of(path)):
            candidates = (ROOT / 'include' / name, path.parent / name, ROOT / name)
            waiting += [candidate.resolve() for candidate in candidates if candidate.is_file()]
    return sorted(found)


def settings_of(folder):
    return [path for path in (ROOT / '.clang-tidy', ROOT / folder / '.clang-tidy') if path.is_file()]


def digest_of_files(digest, paths):
    for path in paths:
        digest.update(str(path.relative_to(ROOT)).encode() + b'\0' + path.read_bytes())


def compile_arguments(entry):
    """The arguments of an entry of the compile database, without compiler, source and object."""
    arguments = entry.get('arguments') or shlex.split(entry['command'])
    kept, skip = [], False
    for argument in arguments[1:]:
        if skip or argument in ('-c', entry['file']):
            skip = False
            continue
        skip = argument == '-o'
        if not skip and not re.fullmatch(r'-D\w+_EXPORTS', argument):
            kept.append(argument)
    return kept


def key_of(path, arguments, version):
    """A digest of all in the project that decides what clang-tidy says about a source, and of clang-tidy itself."""
    digest = hashlib.sha256(version + pathlib.Path(__file__).read_bytes())
    digest.update('\0'.join(arguments).replace(str(ROOT), '.').encode())
    files = project_files(path)
    digest_of_files(digest, settings_of(path.relative_to(ROOT).parts[0]) + files)
    if any(INCLUDED_MESSAGE.search(text_of(file)) for file in files):
        digest_of_files(digest, sorted(file for folder in ('msg', 'srv', 'cfg') for file in (ROOT / folder).iterdir()))
    return digest.hexdigest()


class Memory:
    """What was found clean, and with which versions of the packages whose headers were read."""

    def __init__(self):
        cache = pathlib.Path(os.environ.get('XDG_CACHE_HOME') or pathlib.Path.home() / '.cache')
        self.folder = cache / 'hovercraft_sim' / 'clang_tidy'
        self.folder.mkdir(parents=True, exist_ok=True)
        lines = subprocess.run(['dpkg-query', '-W', '-f=${binary:Package}\t${Version}\n'], stdout=subprocess.PIPE, check=True,
                               universal_newlines=True).stdout
        for old in self.folder.iterdir():
            if time.time() - old.stat().st_mtime > KEPT_DAYS * 86400:
                old.unlink()
        self.versions = dict(line.split('\t') for line in lines.splitlines())
        self.owners = {}

    def is_clean(self, source):
        try:
            record = json.loads((self.folder / source.key).read_text())
            os.utime(self.folder / source.key)  # it was of use: it is kept
        except (OSError, ValueError):
            return False
        return (all(self.versions.get(package) == version for package, version in record['packages'].items()) and
                all(digest_of(path) == digest for path, digest in record['files'].items()))

    def remember(self, source, headers):
        """headers: those outside the project."""
        self.find_owners(headers)
        owners = {header: self.owners[header] for header in headers}
        record = {'packages': {name: self.versions.get(name) for name in sorted(set(owners.values()) - {None})},
                  'files': {header: digest_of(header) for header, owner in sorted(owners.items()) if owner is None}}
        part = self.folder / f'{source.key}.{os.getpid()}'
        part.write_text(json.dumps(record))
        part.replace(self.folder / source.key)

    def find_owners(self, headers):
        unknown = sorted(headers - self.owners.keys())
        if not unknown:
            return
        self.owners.update(dict.fromkeys(unknown))
        answer = subprocess.run(['dpkg-query', '-S', *unknown], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False,
                                universal_newlines=True).stdout
        for line in answer.splitlines():
            names, _, header = line.partition(': ')
            name = names.split(', ')[0]
            if header in self.owners:
                self.owners[header] = name if name in self.versions else name.split(':')[0]


def digest_of(path):
    try:
        return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()
    except OSError:
        return None


def without_analyzer(source):
    return any(WITHOUT_ANALYZER in settings.read_text() for settings in settings_of(source.path.relative_to(ROOT).parts[0]))


class Batch:
    """Sources that may be read as one file: of one folder and compile command, and none declares a name that another one does."""

    def __init__(self, source):
        self.sources = [source]
        self.names = names_declared_in(source)

    def takes(self, source):
        first, names = self.sources[0], names_declared_in(source)
        if (len(self.sources) == SOURCES_OF_A_BATCH or first.path.parent != source.path.parent or
                first.arguments != source.arguments or
                any(self.names.get(name, meaning) != meaning for name, meaning in names.items())):
            return False
        self.sources.append(source)
        self.names.update(names)
        return True

    def weight(self):
        """Grows with the time it takes: what is read of the project, twice as much where ROS is read too."""
        files = set().union(*(project_files(source.path) for source in self.sources))
        text = ''.join(text_of(path) for path in files)
        return len(text) * (2 if '<ros' in text else 1)


def names_declared_in(source):
    """Each name with what it means: a name that is only taken from elsewhere may be taken twice."""
    text = text_of(source.path)
    names = {name: source.path for match in DECLARED.findall(text) for name in match if name}
    names.update((meaning.split('::')[-1], meaning) for meaning in USING.findall(text))
    return names


def may_be_in_a_batch(source):
    """Not what the analyzer sees; and a name that is taken in vain would be excused by another source that uses it."""
    code = re.sub(r'//.*|#\s*include.*', '', text_of(source.path))
    return without_analyzer(source) and all(len(re.findall(rf'\b{meaning.split("::")[-1]}\b', code)) > 1
                                            for meaning in USING.findall(code))


def batches_of(sources):
    """Those that take the longest first."""
    batches, alone = [], []
    for source in sources:
        if not may_be_in_a_batch(source):
            alone.append(Batch(source))
        elif not any(batch.takes(source) for batch in batches):
            batches.append(Batch(source))
    return sorted(batches + alone, key=Batch.weight, reverse=True)


def run_clang_tidy(database, file, arguments):
    """Returns what it finds and the headers outside the project that it read."""
    run = subprocess.run([CLANG_TIDY, '-p', str(database), '--quiet', '--extra-arg=-H', *WARNINGS, *arguments, str(file)],
                         stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
    paths = [os.path.normpath(line.lstrip('.')[1:]) for line in run.stderr.splitlines() if re.match(r'\.+ /', line)]
    if run.returncode == 0:
        return '', {path for path in paths if ROOT not in pathlib.Path(path).parents}
    return run.stdout.strip() or run.stderr, set()


def in_place(finding, places, generated):
    """What was found in the generated file, said of the source that each line came from; places are (first line, path)."""
    def place_of(line):
        first, path = max(place for place in places if place[0] <= int(line))
        return path, int(line) - first + 1

    lines, is_ours = [], False
    for line in finding.splitlines():
        said = re.match(r'(/[^:]+):(\d+)(:.*)', line)
        quoted = re.match(r'( *)(\d+)( \|.*)', line)
        if said:
            is_ours = said.group(1) == str(generated)
        if said and is_ours:
            path, number = place_of(said.group(2))
            line = f'{path}:{number}{said.group(3)}'
        elif quoted and is_ours:
            number = place_of(quoted.group(2))[1]
            line = f'{number:{len(quoted.group(1) + quoted.group(2))}}{quoted.group(3)}'
        lines.append(line)
    return '\n'.join(lines)


def look_at_one_file(folder, build, sources):
    """The sources as one file, in a folder of its own with the settings of theirs."""
    home = folder / sources[0].path.relative_to(ROOT).parts[0]
    home.mkdir()
    for settings in settings_of(home.name):
        (folder / settings.relative_to(ROOT)).write_text(settings.read_text())
    generated, text, places = home / 'batch.cpp', '', []
    for source in sources:
        places.append((text.count('\n') + 1, source.path))
        text += text_of(source.path).rstrip('\n') + '\n'
    generated.write_text(text)
    command = ['c++', *sources[0].arguments, '-iquote', str(sources[0].path.parent), '-c', str(generated)]
    entry = {'directory': str(build), 'file': str(generated), 'arguments': command}
    (folder / 'compile_commands.json').write_text(json.dumps([entry]))
    finding, headers = run_clang_tidy(folder, generated, [])
    return in_place(finding, places, generated), headers


def look_at(build, batch):
    """Returns what is found, and the headers that were read, for each run; and the sources of that run."""
    sources = batch.sources
    if len(sources) > 1:
        with tempfile.TemporaryDirectory() as folder:
            finding, headers = look_at_one_file(pathlib.Path(folder).resolve(), build, sources)
        # Where they cannot be compiled as one, each is looked at by itself.
        if 'clang-diagnostic-error' not in finding:
            return [(sources, finding, headers)]
    return [([source], *run_clang_tidy(build, source.path, [] if without_analyzer(source) else ANALYZER)) for source in sources]


def sources_of(build):
    version = subprocess.run([CLANG_TIDY, '--version'], stdout=subprocess.PIPE, check=True).stdout
    ours = {}
    for entry in json.loads((build / 'compile_commands.json').read_text()):
        path = pathlib.Path(entry['directory'], entry['file']).resolve()
        if ROOT in path.parents and path.relative_to(ROOT).parts[0] in FOLDERS:
            arguments = compile_arguments(entry)
            ours[path] = Source(path, arguments, key_of(path, arguments, version))
    if not ours:
        sys.exit('clang_tidy.py: the compile database names no source of the project')
    return [ours[path] for path in sorted(ours)]


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    memory = Memory()
    sources = sources_of(build)
    dirty = [source for source in sources if not memory.is_clean(source)]
    batches = batches_of(dirty)
    print(f'clang-tidy: {len(sources)} sources, {len(dirty)} to look at in {len(batches)} batches', flush=True)

    findings = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        runs = [pool.submit(look_at, build, batch) for batch in batches]
        for run in concurrent.futures.as_completed(runs):
            for looked_at, finding, headers in run.result():
                if finding:
                    findings += 1
                    print(finding, flush=True)
                    continue
                for source in looked_at:
                    memory.remember(source, headers)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f'clang-tidy: {used.ru_utime + used.ru_stime:.0f} s of processor time')
    if findings:
        sys.exit(f'clang-tidy: findings in {findings} of {len(batches)} batches')


if __name__ == '__main__':
    main()
