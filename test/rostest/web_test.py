#!/usr/bin/env python3
"""web_node before viewers that are no browsers: what it tells, who drives, what it refuses. Browsers: web/browser/live.test.ts."""

import contextlib
import random
import socket
import subprocess
import time
import unittest

import rospy
import rostest
from hovercraft_sim.msg import AppliedCommand, RunEvent, Telemetry

from ros_waiting import DEADLINE, wait_for_connections, wait_until
from web_client import BINARY, CLOSE, PING, Refused, Viewer, http

CRAFT = 'hovercraft'
TOKEN = '0123456789abcdef'
DRIVE_EVERY = 0.05  # s
STATE_EVERY = 10  # ticks


def port_of(node):
    wait_until(lambda: rospy.has_param(f'/{node}/bound_port'), f'the port of {node}')
    return rospy.get_param(f'/{node}/bound_port')


class WebTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.port = port_of('web')
        cls.commands = []
        cls.events = []
        cls.wires = [rospy.Subscriber('/hovercraft/commands', AppliedCommand, cls.commands.append, queue_size=1000),
                     rospy.Subscriber('/hovercraft_sim/events', RunEvent, cls.events.append, queue_size=1000)]
        wait_for_connections(*cls.wires)

    def setUp(self):
        self.stack = contextlib.ExitStack()
        self.addCleanup(self.stack.close)
        # The viewers of the test before have left.
        viewer = self.viewer()
        viewer.wait('seats', lambda seats: seats['viewers'] == 1 and seats['seats'])
        viewer.wait('state')
        self.first = viewer

    def viewer(self, **options):
        viewer = Viewer(options.pop('port', self.port), **options)
        self.stack.callback(viewer.close)
        return viewer

    def patient_viewer(self):
        """Who comes as soon as there is room: one that has closed is counted until that is seen."""
        end = time.monotonic() + DEADLINE
        while True:
            try:
                return Viewer(self.port)
            except Refused:
                if time.monotonic() > end:
                    raise
                time.sleep(0.01)

    def drive(self, viewer, levels, holds, what):
        """Drives until a state holds."""
        end = time.monotonic() + DEADLINE
        after = 0.0
        while time.monotonic() < end:
            if time.monotonic() >= after:
                viewer.send('drive', craft=CRAFT, levels=levels)
                after = time.monotonic() + DRIVE_EVERY
            message = viewer.message()
            self.assertIsNotNone(message, viewer.closed)
            if message['type'] == 'state' and holds(message):
                return message
        raise AssertionError(what)

    def take_helm(self, viewer):
        me = viewer.last.get('hello') or viewer.wait('hello')
        viewer.send('seat', craft=CRAFT, take=True)
        viewer.wait('seats', lambda seats: seats['seats'][0]['driver'] == me['you'])

    def is_stopped(self):
        return bool(self.commands) and (self.commands[-1].rear, self.commands[-1].left, self.commands[-1].right) == (0, 0, 0)

    # What a viewer is told.

    def test_a_newcomer_is_told_who_he_is_the_scene_the_pace_and_the_state(self):
        viewer = self.viewer()
        self.assertEqual(viewer.message()['type'], 'hello')
        scene = viewer.message()
        self.assertEqual(scene['type'], 'scene')
        self.assertEqual([control['name'] for control in scene['controls'][0]], ['rear', 'left', 'right'])
        self.assertEqual([(control['ahead'], control['turn']) for control in scene['controls'][0]], [(1, 0), (0, -1), (0, 1)])
        body = scene['report']['runs'][0]['bodies'][0]
        self.assertEqual((body['name'], len(body['engines'])), (CRAFT, 3))
        self.assertEqual(viewer.wait('pace', lambda pace: pace['there'])['wanted'], 1)
        first = viewer.wait('state')
        self.assertEqual([len(first[key][0]) for key in ('poses', 'motions', 'applied', 'demanded')], [7, 6, 3, 3])
        self.assertGreater(viewer.wait('state', lambda state: state['t'] > first['t'])['tick'], first['tick'])

    # Who drives.

    def test_the_driver_moves_the_craft_and_nobody_else_does(self):
        driver, other = self.first, self.viewer()
        driver.send('name', name='<b>Ann</b>')
        self.take_helm(driver)
        seats = other.wait('seats', lambda seats: seats['seats'][0]['name'] == '<b>Ann</b>')
        self.assertEqual(seats['seats'][0]['craft'], CRAFT)
        other.send('seat', craft=CRAFT, take=True)
        self.assertIn('drives hovercraft', other.wait('note')['text'])
        start = driver.wait('state')['poses'][0][0]
        other.send('drive', craft=CRAFT, levels={'left': 1.25})
        moved = self.drive(driver, {'rear': 4.0, 'left': 0.0, 'right': 0.0}, lambda state: state['poses'][0][0] > start + 0.5, 'it moves')
        self.assertEqual(moved['demanded'][0], [4, 0, 0])
        self.assertGreater(moved['motions'][0][0], 0)
        self.assertNotIn(1.25, [command.left for command in self.commands])
        driver.send('seat', craft=CRAFT, take=False)
        wait_until(self.is_stopped, 'the stop of a driver who leaves')
        self.take_helm(other)

    def test_a_driver_whose_connection_ends_is_stopped(self):
        self.take_helm(self.first)
        self.drive(self.first, {'rear': 3.0}, lambda state: state['applied'][0][0] > 2.0, 'thrust')
        self.assertFalse(self.is_stopped())
        self.first.close()
        wait_until(self.is_stopped, 'the stop')

    def test_a_driver_who_falls_silent_is_stopped_and_may_go_on(self):
        self.take_helm(self.first)
        for _ in range(2):
            self.drive(self.first, {'rear': 3.0}, lambda state: state['applied'][0][0] > 2.0, 'thrust')
            self.assertFalse(self.is_stopped())
            wait_until(self.is_stopped, 'the stop')
            self.first.wait('state', lambda state: state['applied'][0][0] < 0.5)

    def test_a_silent_driver_loses_his_seat(self):
        self.take_helm(self.first)
        self.first.wait('seats', lambda seats: seats['seats'][0]['driver'] == 0)

    def test_bad_drives_change_nothing(self):
        self.take_helm(self.first)
        before = len(self.commands)
        for text in ('{"op":"drive","craft":"hovercraft","levels":{"rear":1e999}}', '{"op":"drive","craft":"hovercraft","levels":{"rear":NaN}}',
                     '{"op":"drive","craft":"hovercraft","levels":{"engine":1}}', '{"op":"drive","craft":"../hovercraft","levels":{"rear":1}}',
                     '{"op":"drive","craft":"hovercraft","levels":{"rear":"1"}}', 'x', '{"op":"shutdown"}'):
            self.first.send_frame(text.encode())
            self.assertTrue(self.first.wait('note')['failure'], text)
        self.assertEqual(len(self.commands), before)

    # The run.

    def paused_tick(self, holds, what):
        """The tick at which the paused run stands, once it holds; states come every few ticks, so the last one may be of an earlier."""
        end = time.monotonic() + DEADLINE
        while time.monotonic() < end:
            telemetry = rospy.wait_for_message('/hovercraft_sim/telemetry', Telemetry, timeout=DEADLINE)
            if telemetry.paused and holds(telemetry.tick):
                return telemetry.tick
        raise AssertionError(what)

    def test_pause_step_resume_reset_and_pace(self):
        other = self.viewer()
        self.first.send('pause', paused=True)
        other.wait('pace', lambda pace: pace['paused'])
        self.assertIn('paused the run', other.wait('note')['text'])
        tick = self.paused_tick(lambda tick: True, 'the pause')
        self.first.send('step', steps=50)
        last = self.paused_tick(lambda now: now > tick, 'the steps')
        self.assertEqual(last, tick + 50)
        self.first.wait('state', lambda state: last - STATE_EVERY < state['tick'] <= last)
        events = len(self.events)
        self.first.send('reset', seed=7)
        wait_until(lambda: len(self.events) > events, 'the reset')
        self.assertEqual((self.events[-1].kind, self.events[-1].seed), (RunEvent.RESET, 7))
        self.first.send('pace', factor=2.5)
        other.wait('pace', lambda pace: pace['wanted'] == 2.5)
        self.first.send('pace', factor=1e-9)
        self.assertIn('refused', self.first.wait('note', lambda note: note['failure'])['text'])
        self.first.send('pace', factor=1)
        self.first.send('pause', paused=False)
        other.wait('pace', lambda pace: not pace['paused'] and pace['wanted'] == 1)

    # What it refuses.

    def test_pages_have_a_policy_and_no_path_leads_to_a_file(self):
        status, headers, body = http(self.port, '/')
        self.assertEqual(status, 200)
        self.assertIn(b'<script src="/report.js">', body)
        self.assertIn("default-src 'none'", headers['content-security-policy'])
        self.assertIn("frame-ancestors 'none'", headers['content-security-policy'])
        self.assertEqual(headers['x-content-type-options'], 'nosniff')
        self.assertNotIn('access-control-allow-origin', headers)
        self.assertEqual(http(self.port, '/report.js')[0], 200)
        status, headers, body = http(self.port, '/', method='HEAD')
        self.assertEqual((status, body), (200, b''))
        for path in ('/etc/passwd', '/../../../../etc/passwd', '/%2e%2e/%2e%2e/etc/passwd', '//etc/passwd', '/report.js/../live.html', '/.git/config',
                     '/report.js%00.html', 'http://localhost/etc/passwd', '/socket/x'):
            self.assertEqual(http(self.port, path)[0], 404, path)
        self.assertEqual(http(self.port, '/', method='POST')[0], 405)
        self.assertEqual(http(self.port, '/socket')[0], 400)

    def test_foreign_hosts_and_origins_are_refused(self):
        own = f'localhost:{self.port}'
        for host in ('evil.example', f'evil.example:{self.port}', 'localhost.evil.example', f'robot.example:{self.port}'):
            self.assertEqual(http(self.port, '/', host=host)[0], 403, host)
            with self.assertRaises(Refused, msg=host):
                self.viewer(host=host, origin=f'http://{host}')
        self.assertEqual(http(self.port, '/', host='')[0], 400)
        for origin in ('http://evil.example', 'null', 'http://localhost:1', f'http://127.0.0.1:{self.port}', 'file://'):
            with self.assertRaises(Refused, msg=origin) as refusal:
                self.viewer(host=own, origin=origin)
            self.assertEqual(refusal.exception.args, (403,))
        self.viewer(host=own, origin=f'http://{own}').wait('hello')

    def test_other_addresses_need_the_token(self):
        port = port_of('open_web')
        for path in ('/socket', '/socket?token=', '/socket?token=0123456789abcdeX', '/socket?token=0123456789abcdef0'):
            with self.assertRaises(Refused) as refusal:
                self.viewer(port=port, path=path)
            self.assertEqual(refusal.exception.args, (401,))
        self.viewer(port=port, path=f'/socket?token={TOKEN}', host='robot.example').wait('scene')
        self.assertEqual(http(port, '/', host='robot.example')[0], 200)

    def test_an_address_without_a_token_does_not_begin(self):
        for arguments, words in ((('_address:=0.0.0.0',), 'give a token'), (('_address:=0.0.0.0', '_token:=short'), '16 to 128'),
                                 (('_address:=nowhere',), 'address to listen on'), (('_port:=70000',), '0 to 65535'),
                                 ((f'_port:={self.port}',), 'cannot listen'), (('_tokn:=x',), 'tokn')):
            run = subprocess.run(['rosrun', 'hovercraft_sim', 'web_node', '__name:=wrong_web', *arguments], stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT, text=True, timeout=DEADLINE)
            self.assertEqual(run.returncode, 1, run.stdout)
            self.assertIn(words, run.stdout)
            self.assertNotIn('short', run.stdout)
            for name in ('address', 'port', 'token', 'tokn'):
                if rospy.has_param('/wrong_web/' + name):
                    rospy.delete_param('/wrong_web/' + name)

    def test_too_many_viewers_are_refused(self):
        viewers = [self.viewer() for _ in range(5)]
        viewers[-1].wait('hello')
        with self.assertRaises(Refused) as refusal:
            self.viewer()
        self.assertEqual(refusal.exception.args, (503,))

    # Who does not keep to the rules.

    def test_a_flood_a_giant_and_bytes_are_closed(self):
        flood = self.viewer()
        with contextlib.suppress(ConnectionError):
            for _ in range(2000):
                flood.send('seat', craft=CRAFT, take=False)
        self.assertIn(flood.wait_for_close(), (1008, 0))
        pings = self.viewer()
        with contextlib.suppress(ConnectionError):
            for _ in range(2000):
                pings.send_frame(b'', PING)
        pings.wait_for_close()
        giant = self.viewer()
        with contextlib.suppress(ConnectionError):
            giant.send_frame(b' ' * 100000)
        self.assertIn(giant.wait_for_close(), (1009, 0))
        binary = self.viewer()
        binary.send_frame(b'{"op":"reset"}', BINARY)
        self.assertIn(binary.wait_for_close(), (1003, 0))
        self.first.wait('state')

    def test_a_fuzzed_viewer_ends_nobody_else(self):
        seed = 20261128
        draw = random.Random(seed)
        good = [b'{"op":"seat","craft":"hovercraft","take":true}', b'{"op":"drive","craft":"hovercraft","levels":{"rear":1}}',
                b'{"op":"name","name":"x"}', b'{"op":"reset"']
        for _ in range(150):
            viewer = self.patient_viewer()
            with contextlib.suppress(ConnectionError):
                for _ in range(draw.randrange(1, 12)):
                    text = bytearray(draw.choice(good))
                    for _ in range(draw.randrange(4)):
                        text[draw.randrange(len(text))] = draw.randrange(256)
                    kind = draw.choice((0, 1, 1, 1, 1, 2, 3, CLOSE, PING, 15))
                    if draw.random() < 0.2:
                        viewer.wire.sendall(bytes(draw.randrange(256) for _ in range(draw.randrange(60))))
                    else:
                        viewer.send_frame(bytes(text), kind, draw.random() < 0.8, draw.random() < 0.9)
            viewer.close()
        for _ in range(50):  # and as HTTP
            with socket.create_connection(('127.0.0.1', self.port)) as wire, contextlib.suppress(ConnectionError):
                wire.sendall(bytes(draw.randrange(256) for _ in range(draw.randrange(400))))
        self.first.wait('seats', lambda seats: seats['viewers'] == 1, deadline=DEADLINE)
        before = self.first.wait('state')
        self.first.wait('state', lambda state: state['tick'] > before['tick'])

    def test_a_viewer_who_takes_nothing_is_dropped_and_nobody_waits_for_him(self):
        lazy = self.viewer(receive_buffer=4096)
        self.first.wait('seats', lambda seats: seats['viewers'] == 2)
        before = self.first.wait('state')
        self.first.wait('state', lambda state: state['t'] > before['t'] + 1)
        self.first.wait('seats', lambda seats: seats['viewers'] == 1)
        lazy.close()

    def test_who_says_nothing_is_no_viewer_for_long(self):
        with socket.create_connection(('127.0.0.1', self.port)) as wire:
            wire.sendall(b'GET / HTTP/1.1\r\nHost: loc')
            wire.settimeout(DEADLINE)
            self.assertEqual(wire.recv(1), b'')


if __name__ == '__main__':
    rospy.init_node('web_test')
    rostest.rosrun('hovercraft_sim', 'viewers', WebTest)
