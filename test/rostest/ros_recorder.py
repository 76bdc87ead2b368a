"""A recorder that the Python rostests wait for: what its connections with the simulation carried."""

import collections
import os
import signal
import time
import xmlrpc.client

import rosgraph
import rospy

from ros_waiting import wait_until

SIMULATION = '/hovercraft_sim'
# What the recorder must have received after the last message of interest before it is stopped: its ten threads have taken
# that one from the queue long before.
LATER_MESSAGES = 50
# s of wall time from command to command: rosbag keeps 100 messages of a topic for its threads, and forgets the oldest where a
# busy machine lets these wait for longer.
COMMAND_PERIOD = 0.05

Wire = collections.namedtuple('Wire', 'peer is_outgoing topic messages')


def slave_of(node):
    """The slave API of a node."""
    return xmlrpc.client.ServerProxy(rosgraph.Master(rospy.get_name()).lookupNode(node))


def wires_of(node):
    """The connections of a roscpp node, with the messages that each has carried."""
    slave = slave_of(node)
    _, _, connections = slave.getBusInfo(rospy.get_name())
    # roscpp tells of an outgoing connection [number, bytes, bytes, messages, ...], of an incoming one
    # [number, bytes, messages, ...].
    published, subscribed = slave.getBusStats(rospy.get_name())[:2]
    counts = {wire[0]: wire[3] for _, wires, *_ in published for wire in wires}
    counts.update({wire[0]: wire[2] for _, wires, *_ in subscribed for wire in wires})
    return [Wire(peer, direction == 'o', topic, counts.get(number, 0))
            for number, peer, direction, _, topic, *_ in connections]


def seldom(act):
    """What can be called as often as one likes: it acts once per COMMAND_PERIOD."""
    due = time.monotonic()

    def act_if_due():
        nonlocal due
        if time.monotonic() >= due:
            act()
            due = time.monotonic() + COMMAND_PERIOD
    return act_if_due


class Recorder:
    """A node of rosbag that somebody has started."""

    def __init__(self, name, topics):
        self.name, self.topics = name, set(topics)

    def runs(self):
        """The master knows it: it has been started."""
        try:
            return bool(rosgraph.Master(rospy.get_name()).lookupNode(self.name))
        except rosgraph.MasterException:
            return False

    def listens(self):
        """The node has a connection to it for every topic; that the master knows of it is not enough."""
        return {wire.topic for wire in wires_of(SIMULATION) if wire.is_outgoing and wire.peer == self.name} >= self.topics

    def received(self):
        """Messages by topic."""
        counts = collections.Counter()
        for wire in wires_of(self.name):
            if not wire.is_outgoing:
                counts[wire.topic] += wire.messages
        return counts

    def wait_for_what_was_sent(self, topics):
        """Of these topics. The simulation must go on, so that later messages come."""
        sent = {wire.topic: wire.messages for wire in wires_of(SIMULATION)
                if wire.is_outgoing and wire.peer == self.name and wire.topic in topics}
        wait_until(lambda: all(self.received()[topic] >= count for topic, count in sent.items()),
                   'the recorder to receive everything')
        seen = sum(self.received().values())
        wait_until(lambda: sum(self.received().values()) >= seen + LATER_MESSAGES, 'what the recorder receives later')

    def close(self, bag):
        """As roslaunch ends it; `bag` is there when its index is."""
        _, _, pid = slave_of(self.name).getPid(rospy.get_name())
        os.kill(pid, signal.SIGINT)
        wait_until(lambda: os.path.exists(bag), 'the recorder to close its bag')
