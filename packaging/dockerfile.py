"""The steps of a Dockerfile as scripts for bare trees of Debian, where there is no container runtime (scripts/check_container).

usage: dockerfile.py DOCKERFILE CONTEXT FOLDER

CONTEXT is a copy of the checkout: what CONTEXT/.dockerignore names is removed from it. Into FOLDER come `suite`, one script for each
stage (0.sh, 1.sh, ...), and run.sh, which starts the entry point of the last one with the arguments that are appended. Inside the trees
FOLDER's parent is /shared: CONTEXT is /shared/context, and what one stage takes from another lies in /shared/from/STAGE.

An instruction, or a form of one, that is not known is refused: it would be passed over here and run by a container runtime.
"""

import json
import pathlib
import re
import shlex
import shutil
import sys

# The beginning of each script.
HEAD = '#!/bin/bash\nset -euo pipefail\n'

# What debian:SUITE-slim leaves out, and the name of the machine that a container runtime makes known.
FROM_SLIM = r'''
cd /
rm -rf /root/hovercraft_sim
for left_out in doc info linda lintian/overrides locale man; do
  echo "path-exclude /usr/share/$left_out/*"
done > /etc/dpkg/dpkg.cfg.d/docker
echo 'path-include /usr/share/doc/*/copyright' >> /etc/dpkg/dpkg.cfg.d/docker
echo "127.0.0.1 $(cat /proc/sys/kernel/hostname)" >> /etc/hosts
'''

# as USER FOLDER NAME=VALUE... -- COMMAND...: with the environment that a container runtime sets, and with what scripts/chroot.sh hands in.
AS = r'''
as() {
  local user=$1 folder=$2 environment=() name
  shift 2
  while [[ $1 != -- ]]; do
    environment+=("$1")
    shift
  done
  shift
  for name in http_proxy https_proxy; do
    [[ -z ${!name:-} ]] || environment+=("$name=${!name}")
  done
  [[ ! -d /cache ]] || environment+=(CCACHE_DIR=/cache CCACHE_BASEDIR=/build CCACHE_NOHASHDIR=1 CMAKE_CXX_COMPILER_LAUNCHER=ccache)
  cd "$folder"
  ${begin:-} env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOSTNAME="$(cat /proc/sys/kernel/hostname)" \
    HOME="$(getent passwd "$user" | cut -d: -f6)" "${environment[@]}" \
    setpriv --reuid "$user" --regid "$(id -g "$user")" --init-groups "$@"
}
'''

# copy FOLDER TARGET SOURCE...: of a folder what is in it.
COPY = r'''
copy() {
  local folder=$1 target=$2 source
  shift 2
  for source in "$@"; do
    if [[ -d $folder/$source ]]; then
      mkdir -p "$target"
      cp -a --no-preserve=ownership "$folder/$source/." "$target"
    else
      mkdir -p "$(dirname "${target}x")"
      cp -a --no-preserve=ownership "$folder/$source" "$target"
    fi
  done
}
'''


class Refusal(Exception):
    """What is not known of the Dockerfile."""


def instructions_of(text):
    """(line, NAME, rest) of each; comments and empty lines go, also between continued ones."""
    found, begun, first = [], '', 0
    for number, line in enumerate(text.splitlines(), 1):
        if re.match(r'\s*#\s*(syntax|escape|check)\s*=', line) and not found:
            raise Refusal(f'line {number}: directives are not known: {line}')
        if not line.strip() or line.lstrip().startswith('#'):
            continue
        first = first if begun else number
        begun += line.rstrip().removesuffix('\\')
        if line.rstrip().endswith('\\'):
            continue
        name, _, rest = begun.strip().partition(' ')
        found.append((first, name.upper(), rest.strip()))
        begun = ''
    if begun:
        raise Refusal(f'line {first}: the last instruction does not end')
    return found


def words_of(rest):
    """Of an instruction whose words are taken as they stand."""
    if re.search(r'[$*?\[\\`]', rest) or '<<' in rest:
        raise Refusal(f'neither variables nor patterns are known here: {rest}')
    return shlex.split(rest)


def exec_form(rest):
    words = json.loads(rest) if rest.startswith('[') else None
    if not words or not all(isinstance(word, str) for word in words):
        raise Refusal(f'only the form ["PROGRAM", "ARGUMENT"] is known: {rest}')
    return words


class Stage:
    """One FROM and what follows it."""

    def __init__(self, suite, name):
        self.suite = suite
        self.name = name
        self.user = 'root'
        self.folder = '/'
        self.environment = {}
        self.entry_point = None
        self.ports = []
        self.lines = []
        self.taken = []  # by later stages

    def as_user(self):
        values = [shlex.quote(f'{name}={value}') for name, value in self.environment.items()]
        return ' '.join(['as', shlex.quote(self.user), shlex.quote(self.folder), *values, '--'])


class Reader:
    """Makes stages of instructions. One method for each that is known."""

    def __init__(self):
        self.stages = []

    def read(self, text):
        for line, name, rest in instructions_of(text):
            method = getattr(self, 'read_' + name.lower(), None)
            try:
                if not method:
                    raise Refusal(f'{name} is not known')
                if not self.stages and name != 'FROM':
                    raise Refusal(f'{name} before FROM')
                if self.stages and name != 'FROM':
                    self.stages[-1].lines.append('echo ' + shlex.quote(f'== {name} {" ".join(rest.split())}'))
                method(rest)
            except (Refusal, ValueError) as error:
                raise Refusal(f'line {line}: {error}') from error
        if not self.stages or not self.stages[-1].entry_point:
            raise Refusal('the last stage has no ENTRYPOINT')
        if len({stage.suite for stage in self.stages}) > 1:
            raise Refusal('the stages are of several suites')
        return self.stages

    def source_stage(self, name, path):
        stage = next((stage for stage in self.stages[:-1] if stage.name == name), None)
        if not stage:
            raise Refusal(f'there is no stage {name} before')
        if not path.startswith('/'):
            raise Refusal(f'{path}: must begin with /')
        stage.taken.append(path)
        return f'/shared/from/{name}'

    def read_from(self, rest):
        found = re.fullmatch(r'debian:([a-z]+)-slim(?: AS ([a-z]+))?', rest)
        if not found:
            raise Refusal(f'FROM must be debian:SUITE-slim, with AS NAME or without: {rest}')
        self.stages.append(Stage(*found.groups()))

    def read_run(self, rest):
        stage = self.stages[-1]
        mounts = []
        while rest.startswith('--'):
            option, _, rest = rest.partition(' ')
            rest = rest.lstrip()
            found = re.fullmatch(r'--mount=type=bind,from=([a-z]+),source=(/[a-z/]+),target=(/[a-z/]+)', option)
            if not found:
                raise Refusal(f'RUN {option} is not known')
            name, source, target = found.groups()
            mounts.append((self.source_stage(name, source) + source, target))
        if rest.startswith('[') or '<<' in rest:
            raise Refusal(f'RUN is known as a line of sh only: {rest}')
        for source, target in mounts:
            stage.lines.append(f'mkdir -p {target} && mount --bind -o ro {source} {target}')
        stage.lines.append(f'{stage.as_user()} /bin/sh -c {shlex.quote(rest)}')
        for _, target in mounts:
            stage.lines.append(f'cd / && umount {target} && rmdir {target}')

    def read_copy(self, rest):
        stage = self.stages[-1]
        words = words_of(rest)
        folder = '/shared/context'
        if words[0].startswith('--from='):
            name = words.pop(0).removeprefix('--from=')
            folder = [self.source_stage(name, source) for source in words[:-1]][0]
        if len(words) < 2 or any(word.startswith('--') for word in words):
            raise Refusal(f'COPY must be SOURCE... TARGET, and with --from=STAGE or without: {rest}')
        if len(words) > 2 and not words[-1].endswith('/'):
            raise Refusal(f'the target of several sources must end in /: {rest}')
        target = words[-1] if words[-1].startswith('/') else f'{stage.folder.rstrip("/")}/{words[-1]}'
        stage.lines.append(' '.join(map(shlex.quote, ['copy', folder, target, *words[:-1]])))

    def read_workdir(self, rest):
        words = words_of(rest)
        if len(words) != 1 or not words[0].startswith('/'):
            raise Refusal(f'WORKDIR must be one absolute path: {rest}')
        self.stages[-1].folder = words[0]
        self.stages[-1].lines.append(f'mkdir -p {shlex.quote(words[0])}')

    def read_user(self, rest):
        if not re.fullmatch(r'[a-z]+', rest):
            raise Refusal(f'USER must be a name: {rest}')
        self.stages[-1].user = rest

    def read_env(self, rest):
        for word in words_of(rest):
            name, equals, value = word.partition('=')
            if not equals:
                raise Refusal(f'ENV must be NAME=VALUE: {rest}')
            self.stages[-1].environment[name] = value

    def read_label(self, rest):
        if not all('=' in word for word in words_of(rest)):
            raise Refusal(f'LABEL must be NAME=VALUE: {rest}')

    def read_expose(self, rest):
        self.stages[-1].ports += [int(word) for word in rest.split()]

    def read_entrypoint(self, rest):
        self.stages[-1].entry_point = exec_form(rest)


def drop_ignored(context):
    """Patterns as .dockerignore has them here: a path, with * in a name at most."""
    for line in (context / '.dockerignore').read_text(encoding='utf-8').splitlines():
        if not line.strip() or line.startswith('#'):
            continue
        if not re.fullmatch(r'[\w.*-]+(/[\w.*-]+)*', line) or '**' in line:
            raise Refusal(f'.dockerignore: {line} is not known')
        for path in context.glob(line):
            if path.is_dir():
                shutil.rmtree(path)
            else:
                path.unlink()


def write(stages, folder):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / 'suite').write_text(stages[0].suite + '\n', encoding='utf-8')
    for number, stage in enumerate(stages):
        lines = list(stage.lines)
        for path in stage.taken:
            taken = shlex.quote(f'/shared/from/{stage.name}{path}')
            lines.append(f'mkdir -p $(dirname {taken}) && cp -a {shlex.quote(path)} {taken}')
        (folder / f'{number}.sh').write_text(HEAD + FROM_SLIM + AS + COPY + '\n'.join(lines) + '\n', encoding='utf-8')
    last = stages[-1]
    entry = ' '.join(map(shlex.quote, last.entry_point))
    (folder / 'run.sh').write_text(f'{HEAD}{AS}begin=exec\n{last.as_user()} {entry} "$@"\n', encoding='utf-8')
    (folder / 'user').write_text(last.user + '\n', encoding='utf-8')
    (folder / 'ports').write_text(' '.join(map(str, last.ports)) + '\n', encoding='utf-8')


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__.split('\n\n')[1])
    dockerfile, context, folder = map(pathlib.Path, sys.argv[1:])
    try:
        stages = Reader().read(dockerfile.read_text(encoding='utf-8'))
        drop_ignored(context)
    except Refusal as error:
        sys.exit(f'{dockerfile}: {error}')
    write(stages, folder)


if __name__ == '__main__':
    main()
