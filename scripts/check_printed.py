"""Runs what the documents print, as printed, in a clean copy of the checkout; printed_rules.py says how.

usage: check_printed.py BUILD_FOLDER [--section TEXT]   (in the project's root; exit status 1 if one fails)

BUILD_FOLDER is a build of this checkout (Release): a build in the copy takes its object files, so that it takes seconds. HOME is a
folder of its own, and the ROS master has a free port. `sudo` is a stand-in that looks whether apt has the packages installed.
--section runs that one alone, after "Two commands".
"""

import argparse
import concurrent.futures
import os
import pathlib
import re
import shlex
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import xmlrpc.client

import printed
import printed_rules

DEADLINE = 300.0  # s for a command to end, or for what it runs for to come: a build on a busy machine takes a third of it
SIGINT_PATIENCE = 30.0  # s
POLL = 0.1  # s
FAILURE_SHOWN = 1000  # characters of each at the end
# In the output of what works there is none of these.
FORBIDDEN = re.compile(r'non-unique executable|^Traceback|^.*\[ERROR\].*|command not found', re.MULTILINE)

# Takes the object file of the given build where there is one of the same target and source.
COMPILER = '''#!/bin/bash
arguments=("$@")
object='' depends=''
while [[ $# -gt 0 ]]; do
  case $1 in
    -o) object=$2 ;;
    -MF) depends=$2 ;;
  esac
  shift
done
known=OBJECTS/CMakeFiles/${object##*CMakeFiles/}
if [[ $object == *.dir/*.o && -f $known ]]; then
  [[ -z $depends ]] || : > "$depends"
  exec cp "$known" "$object"
fi
exec REAL_COMPILER "${arguments[@]}"
'''

# `sudo apt-get install` is not run: its packages must be those of scripts/common.sh, and there, except for rviz.
SUDO = '''#!/bin/bash
[[ "$1 $2" == 'apt-get install' ]] || { echo "sudo $*: not allowed here"; exit 1; }
for package in "${@:3}"; do
  [[ $package != -* && $package != rviz ]] || continue
  dpkg-query -W -f='${db:Status-Status}\\n' "$package" | grep -x installed || { echo "$package is not installed"; exit 1; }
done
'''


def free_port():
    with socket.socket() as any_port:
        any_port.bind(('127.0.0.1', 0))
        return any_port.getsockname()[1]


def copy_checkout(target):
    """What git has, or would add; without git everything but the folders that .gitignore names."""
    if pathlib.Path('.git').exists() and shutil.which('git'):
        files = subprocess.run(['git', 'ls-files', '-z', '--cached', '--others', '--exclude-standard'], check=True,
                               stdout=subprocess.PIPE).stdout.decode().split('\0')
        for file in filter(os.path.isfile, files):
            (target / file).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(file, target / file)
    else:
        shutil.copytree('.', target, symlinks=True, ignore=shutil.ignore_patterns('.git', 'build', 'build_*', 'out', '__pycache__'))


class Failure(Exception):
    """What a printed command did wrong."""


class Process:
    """A command in a terminal of its own, with its output in a file."""

    def __init__(self, command, environment, log):
        self.command, self.log = command, log
        with open(log, 'wb') as out:
            self.popen = subprocess.Popen(['bash', '-c', command], env=environment, stdin=subprocess.DEVNULL, stdout=out,
                                          stderr=subprocess.STDOUT, start_new_session=True)

    def output(self):
        return self.log.read_text(errors='replace')

    def wait(self, seconds):
        try:
            return self.popen.wait(seconds)
        except subprocess.TimeoutExpired:
            return None

    def interrupt(self):
        """Ctrl-C, as a terminal sends it: to every process of the command."""
        if not self.end():
            raise Failure(f'it goes on {SIGINT_PATIENCE:.0f} s after Ctrl-C\n{self.output()}')

    def end(self):
        """Ends it, by Ctrl-C if that does: the nodes that a roslaunch started would outlive it. Says whether that did."""
        if self.popen.poll() is None:
            os.killpg(self.popen.pid, signal.SIGINT)
        if self.wait(SIGINT_PATIENCE) is not None:
            return True
        os.killpg(self.popen.pid, signal.SIGKILL)
        self.popen.wait()
        return False


class Terminal:
    """Runs the commands of a document in order. What they export and where they go to lasts until the next section, or block."""

    def __init__(self, folder, checkout, home, build):
        self.folder, self.checkout = folder, checkout
        self.state = folder / 'environment'
        self.running = {}  # command: Process, what stays until its section ends
        self.count = 0
        for name in ('bin', 'tmp', 'log'):
            (folder / name).mkdir(parents=True)
        self.environment = {
            'PATH': f'{folder}/bin:/usr/bin:/bin:/usr/sbin:/sbin', 'HOME': str(home), 'TMPDIR': f'{folder}/tmp',
            'CXX': f'{folder}/bin/compiler', 'ROS_MASTER_URI': f'http://localhost:{free_port()}', 'ROS_HOSTNAME': 'localhost',
            'ROS_LANG_DISABLE': 'geneus:genlisp:gennodejs',  # messages for languages that nothing here uses
            'LANG': 'C.UTF-8', 'PYTHONUNBUFFERED': '1', 'PYTHONDONTWRITEBYTECODE': '1'}
        cache = (build / 'CMakeCache.txt').read_text()
        compiler = re.search(r'^CMAKE_CXX_COMPILER:\w+=(.*)$', cache, re.MULTILINE).group(1)
        # Else it would have other object files.
        unity = re.search(r'^HOVERCRAFT_UNITY:BOOL=(.*)$', cache, re.MULTILINE)
        self.environment['HOVERCRAFT_UNITY'] = unity.group(1) if unity else 'OFF'
        self.write_program('compiler', COMPILER.replace('OBJECTS', str(build)).replace('REAL_COMPILER', compiler))
        self.write_program('sudo', SUDO)

    def write_program(self, name, text):
        path = self.folder / 'bin' / name
        path.write_text(text)
        path.chmod(0o755)

    def begin_section(self, is_bare):
        self.end_section()
        preamble = '' if is_bare else '. build_release/devel/setup.bash && '
        self.state.write_text('')
        self.begin_block()
        self.run(f'{preamble}true')

    def begin_block(self):
        self.place = self.checkout

    def end_section(self):
        self.keep_only(())

    def keep_only(self, commands):
        for command in [running for running in reversed(list(self.running)) if running not in commands]:
            self.running.pop(command).interrupt()

    def start(self, command, keeps_state=False):
        self.count += 1
        script = f'. {self.state}; cd {shlex.quote(str(self.place))}\n{command}\n'
        if keeps_state:
            script += f'status=$?; export -p > {self.state}; pwd > {self.state}.place; exit $status'
        return Process(script, self.environment, self.folder / 'log' / f'{self.count}.log')

    def run(self, command):
        """Runs a command that ends by itself; returns its output."""
        process = self.start(command, keeps_state=True)
        try:
            status = process.wait(DEADLINE)
        finally:
            process.end()
        if status is None:
            raise Failure(f'it has not ended after {DEADLINE:.0f} s: it needs a rule with until\n{process.output()}')
        if status != 0:
            raise Failure(f'exit status {status}\n{process.output()}')
        self.place = pathlib.Path(f'{self.state}.place').read_text().rstrip('\n')
        return process.output()

    def publishes(self, topic):
        try:
            _, _, topics = xmlrpc.client.ServerProxy(self.environment['ROS_MASTER_URI']).getPublishedTopics('/printed', '')
        except (OSError, xmlrpc.client.Error):
            return False
        return topic in [name for name, _ in topics]

    def holds(self, condition, output):
        """A topic that is published, a command that succeeds, or words in the output."""
        if isinstance(condition, re.Pattern):
            return condition.search(output) is not None
        if re.fullmatch(r'/\S+', condition):
            return self.publishes(condition)
        process = self.start(condition)
        if process.wait(DEADLINE) is None:
            process.end()
        return process.popen.returncode == 0

    def start_until(self, command, condition):
        """Starts what runs for ever, and waits for the condition."""
        process = self.start(command)
        end = time.monotonic() + DEADLINE
        while not self.holds(condition, process.output()):
            if process.popen.poll() is not None:
                raise Failure(f'it ended by itself, with exit status {process.popen.returncode}\n{process.output()}')
            if time.monotonic() > end:
                process.end()
                raise Failure(f'in vain for {DEADLINE:.0f} s: {condition}\n{process.output()}')
            time.sleep(POLL)
        return process

    def obey(self, command, rule):
        """Runs a command by its rule."""
        if rule.beside is not None:
            self.keep_only(rule.beside + ((command,) if command in self.running else ()))
            for other in rule.beside:
                if other not in self.running:
                    self.running[other] = self.start_until(other, rule_of(other).until)
        if rule.until is None:
            output = self.run(command)
        elif command in self.running:
            output = ''
        else:
            process = self.start_until(command, rule.until)
            try:
                if rule.drive:
                    self.start_until(rule.drive, rule_of(rule.drive).until).interrupt()
            finally:
                if not rule.stays:
                    process.interrupt()
            if rule.stays:
                self.running[command] = process
            output = process.output()
        found = FORBIDDEN.search(output)
        if found:
            raise Failure(f'it prints: {found.group(0)}\n{output}')
        if rule.says and not re.search(rule.says, output):
            raise Failure(f'it does not say {rule.says}\n{output}')
        if rule.then:
            self.run(rule.then)

    def write(self, name, text):
        """A file that a document prints; one that is shipped must be the same."""
        path = pathlib.Path(name.replace('~', self.environment['HOME'], 1) if name.startswith('~/') else self.checkout / name)
        if path.exists() and path.read_text() != text:
            raise Failure(f'{name}, which is shipped, reads otherwise')
        if not path.parent.is_dir():
            raise Failure(f'{name}: nothing printed makes its folder')
        path.write_text(text)


def rule_of(command):
    return next((rule for rule in printed_rules.RULES if re.fullmatch(rule.pattern, command)), printed_rules.Rule(command))


def handle(terminal, item):
    """Returns the reason why it was not run, or None."""
    if item.kind == 'fault':
        raise Failure(item.text)
    if item.kind == 'file':
        terminal.write(item.name, item.text)
        return None
    rule = rule_of(item.text)
    if not rule.skip:
        terminal.obey(item.text, rule)
    return rule.skip


def report(item, began, verdict, detail=''):
    text = item.name if item.kind == 'file' else item.text.splitlines()[0]
    print(f'{verdict:7} {time.monotonic() - began:5.1f} s  {item.document}:{item.line}: {text[:100]}{detail}', flush=True)


def run_all(terminal, items):
    """Runs them in order; returns what is said of those that failed."""
    failures, section, block = [], None, 0
    for item in items:
        began = time.monotonic()
        try:
            if (item.document, item.section) != section:
                section = item.document, item.section
                terminal.begin_section(item.section in printed_rules.BARE_SECTIONS)
            if not item.block or item.block != block:
                terminal.begin_block()
            block = item.block
            reason = handle(terminal, item)
            report(item, began, 'skipped' if reason else 'ok', f': {reason}' if reason else '')
        except Failure as failure:
            failures.append(f'{item.document}:{item.line}: {item.name or item.text}\n{failure}')
            report(item, began, 'FAILED', f'\n{failure}')
    try:
        terminal.end_section()
    except Failure as failure:
        failures.append(f'at the end of {section}\n{failure}')
        print(f'FAILED {failures[-1]}', flush=True)
    return failures


def run_in_lanes(terminals, items):
    """What the first document prints up to what it builds; then the rest of it beside the other documents."""
    first = printed_rules.DOCUMENTS[0]
    built = [n for n, item in enumerate(items) if (item.document, item.section) == (first, printed_rules.LAST_IN_ORDER)]
    begin = built[-1] + 1 if built else len(items)
    failures = run_all(terminals[0], items[:begin])
    lanes = [[item for item in items[begin:] if (item.document == first) == is_first] for is_first in (True, False)]
    with concurrent.futures.ThreadPoolExecutor() as pool:
        return failures + sum(pool.map(run_all, terminals, lanes), [])


def unused_rules(items):
    """Patterns that no printed command fits any more."""
    used = {id(rule_of(item.text)) for item in items if item.kind == 'command'}
    helpers = {other for rule in printed_rules.RULES for other in (rule.beside or ()) + ((rule.drive,) if rule.drive else ())}
    used |= {id(rule_of(helper)) for helper in helpers}
    return [rule.pattern for rule in printed_rules.RULES if id(rule) not in used]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('build', type=pathlib.Path)
    parser.add_argument('--section', help='only sections of this name')
    arguments = parser.parse_args()
    build = arguments.build.resolve()

    # What is started in the background ignores it, and so would rosbag and roslaunch.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    printed.check_reader()
    tools = [path.name for path in (build / 'devel/lib/hovercraft_sim').iterdir()] + list(printed_rules.READERS_PROGRAMS)
    items = [item for document in printed_rules.DOCUMENTS
             for item in printed.read(document, printed_rules.TEXTS, tools, printed_rules.CHECKED_ELSEWHERE.get(document, ()))
             if item.section not in printed_rules.UNREAD_SECTIONS]
    unused = unused_rules(items)
    if unused:
        sys.exit('\n'.join(f'printed_rules.py: no document prints {pattern}' for pattern in unused))
    if arguments.section:
        items = [item for item in items if item.section in ('Two commands', arguments.section)]
    folder = pathlib.Path(tempfile.mkdtemp(prefix='hovercraft_printed.'))
    terminals = []
    try:
        (folder / 'home').mkdir()
        copy_checkout(folder / 'hovercraft_sim')
        terminals = [Terminal(folder / lane, folder / 'hovercraft_sim', folder / 'home', build) for lane in ('first', 'second')]
        failures = run_in_lanes(terminals, items)
    finally:
        for terminal in terminals:
            for process in terminal.running.values():
                process.end()
        shutil.rmtree(folder, ignore_errors=True)
    if failures:
        # Once more: a CI keeps the end of a long log.
        sys.exit('\n'.join([f'{len(failures)} of what the documents print failed:'] + [failure[:FAILURE_SHOWN] for failure in failures]))
    print(f'None of the {len(items)} commands and files that the documents print failed; those that are skipped say why.')


if __name__ == '__main__':
    main()
