"""Runs clang-tidy on every source of the project that a compile database names.

A source that was found clean is not looked at again until it, a header of the project that it includes, its compile
command, the configuration or clang-tidy itself changes.

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
    digest.update(entry['command'].encode())
    for path in project_files(pathlib.Path(entry['file']).resolve()):
        digest.update(str(path).encode() + b'\0' + path.read_bytes())
    return digest.hexdigest()


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
    stamps = build / 'clang_tidy'
    stamps.mkdir(exist_ok=True)
    version = subprocess.run(['clang-tidy', '--version'], stdout=subprocess.PIPE, check=True).stdout
    configurations = [ROOT / '.clang-tidy'] + [ROOT / folder / '.clang-tidy' for folder in FOLDERS]
    configuration = version + b''.join(path.read_bytes() for path in configurations if path.is_file())

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
