"""The nodes in Python, as far as they go without a master."""

import pathlib
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
NODES = ('scripts/joy_teleop.py', 'scripts/teleop.py', 'examples/fixed_localiser.py', 'examples/follow_waypoints.py',
         'examples/hold_heading.py')


class Nodes(unittest.TestCase):
    def answer(self, node, option):
        return subprocess.run([sys.executable, str(ROOT / node), option], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, check=True,
                              timeout=60, universal_newlines=True).stdout

    def test_say_what_they_are_for_and_their_version(self):
        for node in NODES:
            name = pathlib.Path(node).name
            with self.subTest(node):
                self.assertRegex(self.answer(node, '--help'), rf'^{name} \[_PARAMETER:=VALUE \.\.\.\].*\n.*\w+')
                self.assertRegex(self.answer(node, '--version'), rf'^{name} of hovercraft_sim \d')


if __name__ == '__main__':
    unittest.main()
