"""Compares doc/reference.md with what it describes: messages, launch files, programs, keys, and a running node.

usage: check_reference.py BUILD_FOLDER   (in the project's root, in the environment of scripts/test; exit status 1 if something differs)

Both ways: what is there must be on the page, and what is on the page must be there. Keys are asked of the parser itself: given a key
that does not exist, it lists those that do.
"""

import os
import pathlib
import re
import shlex
import signal
import socket
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree
import xmlrpc.client

PAGE = pathlib.Path('doc/reference.md')
SENSORS_PAGE = pathlib.Path('doc/sensors.md')
PACKAGE = 'hovercraft_sim'
DEADLINE = 60.0  # s for a node to come up on a busy machine
POLL = 0.1  # s

# Where a key may stand: section of the page, scenario, path of the map; {} is the place of the unknown key.
CRAFT = 'vehicles.hovercraft.'
PROBES = [('Scenario file', 'hovercraft', path) for path in (
    '{}', CRAFT + '{}', CRAFT + 'inertia.{}', CRAFT + 'engines.{}', CRAFT + 'engines.rear.{}', CRAFT + 'drag.{}', CRAFT + 'initial.{}',
    CRAFT + 'visual={{file: a.obj, {}: 1}}')] + [('Scenario file', 'pen', path) for path in (
        CRAFT + 'parts[0].{}', CRAFT + 'parts[0].box.{}', CRAFT + 'parts=[{{sphere: {{{}: 1}}, mass: 1}}]',
        CRAFT + 'parts=[{{cylinder: {{{}: 1}}, mass: 1}}]', CRAFT + 'parts=[{{cone: {{{}: 1}}, mass: 1}}]',
        CRAFT + 'parts=[{{mesh: {{{}: 1}}, mass: 1}}]')] + [
    ('Scenario file', 'gusts', 'vehicles.mvwt.drag.polar.{}')] + [
    ('Fleets', 'hovercraft', 'vehicles.fleet={{count: 2, like: hovercraft, spacing: 1, {}: 1}}')] + [
    ('Actuators', 'vectored_fans', CRAFT + 'actuators.fl={{kind: ' + kind + ', {}: 1}}')
    for kind in ('fan', 'propeller', 'lift_fan', 'rudder')] + [
    ('Gusts', 'gusts', 'gusts.{}'), ('Gusts', 'gusts', 'gusts.along.{}')] + [('World', 'crates', path) for path in (
        'world.{}', 'world.materials.wood.{}', 'world.material_pairs=[{{{}: 1}}]', 'world.obstacles={{post: {{{}: 1}}}}',
        'world.bodies.crate_a.{}', CRAFT + 'hull={{{}: 1}}', CRAFT + 'hull={{points: [{{{}: 1}}]}}')] + [
    ('Cushion and ground', 'rc5', path) for path in (
        'vehicles.rc5.cushion.{}', 'vehicles.rc5.cushion.fans.lift.{}', 'vehicles.rc5.cushion.rectangle.{}', 'vehicles.rc5.cushion.skirt.{}',
        'vehicles.rc5.cushion={{fans: {{lift: {{shutoff: 900, curve: 1, speeds: [{{{}: 1}}]}}}}}}', 'ground.{}', 'ground.plane.{}', 'ground.pads={{{}: 1}}')] + [
    ('Cushion and ground', 'rough', 'ground.height_map.{}')] + [
    ('sensors.md', 'senses', CRAFT + 'sensors.' + name + '.{}') for name in ('imu', 'gps', 'odometry', 'compass', 'lidar')]
UNKNOWN = 'no_such_key'
# Keys of the cells of a cushion, which stand in the place of a rectangle.
CELLS = ('vehicles.rc5.cushion={{fans: {{lift: {{shutoff: 900, curve: 1}}}}, cells: [{{{}: 1}}]}}', 'vehicles.rc5.cushion={{fans: {{lift: {{shutoff: 900, '
         'curve: 1}}}}, cells: [{{center: [0, 0, 0], area: 1, height: 1, hem: [{{{}: 1}}]}}]}}')
PROBES += [('Cushion and ground', 'rc5', path) for path in CELLS]

# Runs of the node that together have every topic: scenario, parameters, and what of its names stands for what on the page.
RUNS = (('lift_fan', '_clock:=true', {'/rc5/actuators/lift': 'actuators/NAME', '/rc5/': ''}),
        ('senses', '_map_height:=0.1', {'/hovercraft/': ''}),
        ('crates', '', {'/crate_[ab]/': '/BODY/', '/hovercraft/': ''}))
NOT_OF_THE_NODE = {'manoeuvres': 'published by pilot'}
# What roscpp itself has in each node.
OF_ROSCPP = ('/rosout', '/hovercraft_sim/get_loggers', '/hovercraft_sim/set_logger_level')

problems = []


def note(place, text):
    problems.append(f'{place}: {text}')


def compare(place, documented, real):
    for name in sorted(set(real) - set(documented)):
        note(place, f'{name} is missing')
    for name in sorted(set(documented) - set(real)):
        note(place, f'{name} does not exist')


def section(text, title):
    found = re.search(rf'^#+ {re.escape(title)}\n(.*?)(?=^#+ |\Z)', text, re.MULTILINE | re.DOTALL)
    if not found:
        sys.exit(f'{PAGE} has no section {title}')
    return found.group(1)


def rows(text):
    """The cells of each row of the tables; a bar in a cell is written with a backslash."""
    lines = [line for line in text.splitlines() if line.startswith('|') and not line.startswith('|---')]
    return [[cell.strip() for cell in re.split(r'(?<!\\)\|', line)[1:-1]] for line in lines]


def read(path):
    """The page without its blocks of code."""
    return re.sub(r'^```.*?^```$', '', path.read_text(), flags=re.MULTILINE | re.DOTALL)


def names(cell):
    return re.findall(r'`([^`]+)`', cell)


def words(text):
    return {word for span in names(text) for word in re.findall(r'[a-z][a-z_0-9]*', span)}


def fields(lines):
    """The names of the fields of a message: constants are no fields."""
    parts = [line.split('#')[0].split() for line in lines]
    return [part[1] for part in parts if len(part) >= 2 and '=' not in ''.join(part)]


def check_messages(page):
    documented = {re.match(r'\[(\w+)\]', row[0]).group(1): names(row[1].split('; constants')[0]) for row in rows(section(page, 'Messages'))[1:]}
    real = {path.stem: fields(path.read_text().splitlines()) for path in pathlib.Path('msg').glob('*.msg') if 'Format1' not in path.stem}
    compare('Messages', documented, real)
    for name in set(documented) & set(real):
        compare(f'Messages, {name}', documented[name], real[name])


def documented_services(page):
    return {name: (row[1], names(row[2])) for row in rows(section(page, 'Services'))[1:] for name in names(row[0])}


def check_service_fields(page):
    used = set()
    for name, (kind, request) in documented_services(page).items():
        package, kind = kind.split('/')
        if package != PACKAGE:
            continue
        used.add(kind)
        path = pathlib.Path(f'srv/{kind}.srv')
        if path.exists():
            compare(f'Services, {name}', request, fields(path.read_text().split('---')[0].splitlines()))
    compare('Services, types', used, [path.stem for path in pathlib.Path('srv').glob('*.srv')])


def check_launch_files(page):
    text = section(page, 'Launch files')
    files = re.split(r'^`(\w+)\.launch`.*$', text, flags=re.MULTILINE)
    documented = dict(zip(files[1::2], files[2::2]))
    paths = {path.stem: path for path in pathlib.Path('launch').glob('*.launch')}
    compare('Launch files', documented, paths)
    for name in set(documented) & set(paths):
        real = {argument.get('name'): argument.get('default').replace(f'$(find {PACKAGE})/', '')
                for argument in xml.etree.ElementTree.parse(paths[name]).getroot().findall('arg')}
        written = {names(row[0])[0]: names(row[1])[0] for row in rows(documented[name])[1:]}
        compare(f'{name}.launch', written.items(), real.items())


def run(environment, command, *arguments):
    return subprocess.run([command, *arguments], env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False,
                          stdin=subprocess.DEVNULL, timeout=DEADLINE).stdout.decode()


def check_programs(page, folder, environment):
    text = section(page, 'Programs')
    table = {names(row[0])[0]: {option for option in names(row[1]) if option.startswith('--')} for row in rows(text)[1:]}
    sources = {path.stem for path in pathlib.Path('src/tools').glob('*.cpp')} | {path.name for path in pathlib.Path('scripts').glob('plot_*.py')
                                                                                 if (folder / path.name).exists()} | {'study.py'}
    compare('Programs', set(table) - {'pilot'}, sources)
    for name in set(table) & (sources | {'pilot'}):
        offered = set(re.findall(r'^  .*?(--[a-z][a-z-]*)', run(environment, str(folder / name), '--help'), re.MULTILINE))
        compare(f'Programs, {name}', table[name], offered - {'--help', '--version'})
    nodes = {path.stem for path in pathlib.Path('src/nodes').glob('*.cpp')} | {path.name for path in pathlib.Path('examples').glob('*.py')}
    for name in sorted(nodes - set(names(text))):
        note('Programs', f'{name} is missing')


def check_parameters(page, environment, folder):
    """Asked of the node, which lists its parameters when one is unknown."""
    text = run(environment, 'bash', '-c', f'timeout {DEADLINE:.0f} {folder}/hovercraft_node __name:=probe _{UNKNOWN}:=1')
    known = re.search(r'known here: (.*?)[\r\n\x1b]', text)
    if not known:
        note('Parameters', f'hovercraft_node does not list them: {text}')
        return
    documented = [name for row in rows(section(page, 'Parameters'))[1:] for name in names(row[0])]
    compare('Parameters', documented, known.group(1).split(', '))


def known_keys(simulate, environment, scenario, path):
    place = path.format(UNKNOWN) + ('' if '=' in path else '=1')
    text = run(environment, simulate, f'config/{scenario}.yaml', '--set', place, '--duration', '0', '--output', '-')
    known = re.search(r'unknown key; known here: (.*)', text)
    if UNKNOWN not in text or not known:
        note('Keys', f'{scenario}.yaml with {place}: no list of keys in: {text.strip()[:300]}')
        return set()
    return set(known.group(1).split(', '))


def check_keys(page, simulate, environment):
    pages = {title: section(page, title) for title in {probe[0] for probe in PROBES} if title != SENSORS_PAGE.name}
    pages[SENSORS_PAGE.name] = read(SENSORS_PAGE)
    known = {title: set() for title in pages}
    for title, scenario, path in PROBES:
        written = words(pages[title])
        keys = known_keys(simulate, environment, scenario, path)
        known[title] |= keys
        for key in sorted(keys - written):
            parts = key.split('_')
            if not any({'_'.join(parts[:n]), '_'.join(parts[n:])} <= written for n in range(1, len(parts))) and key not in words(page):
                note(title, f'the key {key} ({path}) is missing')
    everywhere = set().union(*known.values())
    for title in set(pages) - {SENSORS_PAGE.name, 'Actuators'}:
        written = {word for row in rows(pages[title]) for word in words(row[0])}
        for key in sorted(written - everywhere):
            note(title, f'the key {key} does not exist')


def documented_topics(page):
    """(direction, name): type"""
    sensors = {name: row[1] for row in rows(read(SENSORS_PAGE)) if len(row) > 1 and re.match(r'\w+/\w+$', row[1]) for name in names(row[0])}
    topics = {}
    for row in rows(section(page, 'Topics'))[1:]:
        for name in names(row[1]):
            kind = sensors.get(name, row[2]) if 'sensors.md' in row[2] else row[2].split(',')[0]
            topics[row[0], name] = kind
    return topics


class Master:
    """A ROS master of our own."""

    def __init__(self, environment, home):
        with socket.socket() as any_port:
            any_port.bind(('127.0.0.1', 0))
            port = any_port.getsockname()[1]
        self.environment = dict(environment, ROS_MASTER_URI=f'http://localhost:{port}', ROS_HOME=home, ROS_HOSTNAME='localhost')
        self.proxy = xmlrpc.client.ServerProxy(self.environment['ROS_MASTER_URI'])
        self.log = pathlib.Path(home) / 'output'
        self.core = self.start(['roscore', '-p', str(port)])
        self.wait(self.is_up)

    def start(self, command):
        with open(self.log, 'ab') as log:
            return subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=log, stderr=log, start_new_session=True)

    def is_up(self):
        try:
            return bool(self.state()[0])
        except OSError:
            return False

    def state(self):
        return self.proxy.getSystemState('/check_reference')[2]

    @staticmethod
    def wait(condition):
        end = time.monotonic() + DEADLINE
        while not condition():
            if time.monotonic() > end:
                sys.exit(f'in vain for {DEADLINE:.0f} s')
            time.sleep(POLL)

    def end(self, process):
        if process.poll() is not None:
            sys.exit(f'it ended by itself:\n{self.log.read_text(errors="replace")}')
        os.killpg(process.pid, signal.SIGINT)
        process.wait(DEADLINE)

    def graph_of(self, node):
        """What a node publishes, subscribes to and serves."""
        return [{name for name, owners in part if node in owners} for part in self.state()]


def check_graph(page, master, folder):
    topics, services = documented_topics(page), documented_services(page)
    seen, served = set(), set()
    for scenario, parameter, renamed in RUNS:
        process = master.start([str(folder / 'hovercraft_node'), f'__name:={PACKAGE}',
                                f'_scenario_file:={pathlib.Path("config").resolve()}/{scenario}.yaml', *parameter.split()])
        node = f'/{PACKAGE}'
        # The services come last.
        master.wait(lambda: f'{node}/load' in master.graph_of(node)[2] or process.poll() is not None)
        time.sleep(5 * POLL)
        types = dict(master.proxy.getTopicTypes('/check_reference')[2])
        published, subscribed, offered = master.graph_of(node)
        master.end(process)
        master.proxy.deleteParam('/check_reference', node)
        for direction, group in (('out', published), ('in', subscribed)):
            for real in group - set(OF_ROSCPP) - {'/clock' if direction == 'in' else ''}:
                name = real
                for pattern, word in renamed.items():
                    name = re.sub('^' + pattern, word, name)
                seen.add((direction, name))
                kind = topics.get((direction, name))
                if kind not in (types[real], types[real].split('/')[0]):
                    note(f'Topics, {scenario}', f'{direction} {name} is {types[real]}, on the page {kind}')
        served |= {name.replace(f'{node}/', '') for name in offered - set(OF_ROSCPP)}
    compare('Topics', {f'{way} {name}' for way, name in topics if name not in NOT_OF_THE_NODE}, {f'{way} {name}' for way, name in seen})
    compare('Services', services, served)


def environment_of(build):
    text = subprocess.run(['bash', '-c', f'. {shlex.quote(str(build))}/devel/setup.bash && env -0'], check=True, stdout=subprocess.PIPE).stdout
    return dict(line.split('=', 1) for line in text.decode().split('\0') if line)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    build = pathlib.Path(sys.argv[1]).resolve()
    folder, page, environment = build / 'devel/lib' / PACKAGE, read(PAGE), environment_of(build)
    check_messages(page)
    check_service_fields(page)
    check_launch_files(page)
    check_programs(page, folder, environment)
    check_keys(page, str(folder / 'simulate'), environment)
    with tempfile.TemporaryDirectory(prefix='hovercraft_reference.') as home:
        master = Master(environment, home)
        try:
            check_parameters(page, master.environment, folder)
            check_graph(page, master, folder)
        finally:
            master.end(master.core)
    if problems:
        sys.exit('\n'.join(problems))
    print(f'{PAGE} agrees with messages, services, launch files, programs, {len(PROBES)} maps of keys and a running node.')


if __name__ == '__main__':
    main()
