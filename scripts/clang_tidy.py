"""Runs clang-tidy on every source of the project that a compile database names.

A source that was found clean is not looked at again, in any checkout of this user, until it, a header or message of the
project, its compile command, the configuration or a package of the system changes. What was found clean is kept in
$XDG_CACHE_HOME/hovercraft_sim (~/.cache/hovercraft_sim), as ccache keeps what it compiled.

usage: clang_tidy.py BUILD_FOLDER   (exit status 1 if there is a finding; run in the project's root)
"""

import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path.cwd()
FOLDERS = ('src', 'test', 'bench', 'examples')
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)


def project_files(source):
    """The source and every header of the project that it includes, directly or not, in a fixed order."""
    found, waiting = set(), [source]
    while waiting:
        path = waiting.pop()
        if path in found:
            continue
        found.add(path)
        for name in INCLUDE.findall(path.read_text()):
            candidates = (ROOT / 'include' / name, path.parent / name, ROOT / name)
            waiting += [candidate.resolve() for candidate in candidates if candidate.is_file()]
    return sorted(found)


def key_of(entry, configuration):
    """A digest of all that decides what clang-tidy says about an entry of the compile database."""
    digest = hashlib.sha256(configuration)
    digest.update(entry['command'].replace(str(ROOT), '.').encode())
    for path in project_files(pathlib.Path(entry['file']).resolve()):
        digest.update(str(path.relative_to(ROOT)).encode() + b'\0' + path.read_bytes())
    return digest.hexdigest()


def configuration_of_all():
    """What decides for every source alike: settings, messages, and the packages with their versions."""
    settings = [ROOT / '.clang-tidy'] + [ROOT / folder / '.clang-tidy' for folder in FOLDERS]
    messages = sorted(path for folder in ('msg', 'srv', 'cfg') for path in (ROOT / folder).iterdir())
    packages = subprocess.run(['dpkg-query', '-W'], stdout=subprocess.PIPE, check=True).stdout
    return packages + b''.join(path.read_bytes() for path in settings + messages if path.is_file())


def tidy(build, entry, stamp):
    """Returns what clang-tidy finds, or '' and leaves the stamp."""
    run = subprocess.run(['clang-tidy', '-p', str(build), '--quiet', entry['file']],
                         stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
    if run.returncode == 0:
        stamp.touch()
        return ''
    return run.stdout or run.stderr


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    cache = pathlib.Path(os.environ.get('XDG_CACHE_HOME') or pathlib.Path.home() / '.cache')
    stamps = cache / 'hovercraft_sim' / 'clang_tidy'
    stamps.mkdir(parents=True, exist_ok=True)
    configuration = configuration_of_all()

    entries = json.loads((build / 'compile_commands.json').read_text())
    ours = {entry['file']: entry for entry in entries
            if pathlib.Path(entry['file']).resolve().relative_to(ROOT).parts[0] in FOLDERS}
    if not ours:
        sys.exit('clang_tidy.py: the compile database names no source of the project')
    keys = {file: key_of(entry, configuration) for file, entry in ours.items()}
    dirty = [file for file in sorted(ours) if not (stamps / keys[file]).exists()]
    print(f'clang-tidy: {len(ours)} sources, {len(dirty)} to look at', flush=True)

    findings = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        runs = [pool.submit(tidy, build, ours[file], stamps / keys[file]) for file in dirty]
        for run in concurrent.futures.as_completed(runs):
            if run.result():
                findings += 1
                print(run.result(), flush=True)
    if findings:
        sys.exit(f'clang-tidy: findings in {findings} sources')


if __name__ == '__main__':
    main()
