"""What the Python rostests share: services of the node, tools, and waiting on a condition with a deadline."""

import contextlib
import os
import subprocess
import tempfile
import threading
import time

import rospy
import yaml
from hovercraft_sim.srv import Snapshot

DEADLINE = 60.0  # s of wall time to wait for anything


def service(name, kind):
    """A service of the node, once it is there."""
    rospy.wait_for_service('/hovercraft_sim/' + name, timeout=DEADLINE)
    return rospy.ServiceProxy('/hovercraft_sim/' + name, kind)


def run_tool(*arguments):
    """A program of the package and its arguments; its exit status and all that it said."""
    done = subprocess.run(['rosrun', 'hovercraft_sim', *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          universal_newlines=True, timeout=DEADLINE)
    return done.returncode, done.stdout


def wait_until(condition, what):
    deadline = time.monotonic() + DEADLINE
    while not condition():
        if time.monotonic() > deadline:
            raise AssertionError(f'waited {DEADLINE} s of wall time for {what}')
        threading.Event().wait(0.005)


def wait_for_connections(*wires):
    """Until each Subscriber and Publisher has a peer, and no message can be lost any more."""
    wait_until(lambda: all(map(is_connected, wires)), ', '.join(wire.resolved_name for wire in wires))


def is_connected(wire):
    """rospy counts what a subscriber is about to call as well; the type of its messages comes with the answer."""
    if isinstance(wire, rospy.Publisher):
        return wire.get_num_connections() > 0
    calls = list(wire.impl.connections)
    return bool(calls) and all(call.type is not None for call in calls)


@contextlib.contextmanager
def listening(topics):
    """What newcomers to some topics hear: of {name: (topic, type)} the messages by name."""
    heard = {name: [] for name in topics}
    subscribers = [rospy.Subscriber(topic, kind, heard[name].append) for name, (topic, kind) in topics.items()]
    try:
        wait_for_connections(*subscribers)
        yield heard
    finally:
        for subscriber in subscribers:
            subscriber.unregister()


def snapshot_now():
    """What the node would go on from, whether it waits or not."""
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, 'snapshot.yaml')
        answer = service('save', Snapshot)(file)
        if not answer.success:
            raise AssertionError(answer.message)
        with open(file) as snapshot:
            return yaml.safe_load(snapshot)
