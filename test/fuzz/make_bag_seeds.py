#!/usr/bin/env python3
"""Writes test/fuzz/seeds/{bag,report_bag,layout}: small bags of every kind of message that the tools read, as long as they must be, and messages alone.

usage: make_bag_seeds.py FOLDER      (with the package's messages on PYTHONPATH)

Unlike rosbag's they have no padding, and no message definitions but in report_bag, so that a fuzzer seldom changes what does not matter. FOLDER is
test/fuzz/seeds.
"""

import bz2
import io
import os
import struct
import sys

from geometry_msgs.msg import PoseStamped, TwistStamped
from hovercraft_sim.msg import AppliedCommand, Cushion, CushionCell, RunEvent, State, ThrustCommand
from nav_msgs.msg import Odometry
import roslz4
from std_msgs.msg import Float64, String

STEP_NS = 10000000
SCENARIO = """step_size: 0.01
model: planar
vehicles:
  craft:
    mass: 2
    inertia: {ixx: 0.5, iyy: 0.5, izz: 0.5}
    engines:
      rear: {position: [-1, 0, 0], direction: [1, 0, 0], min_thrust: -9, max_thrust: 9}
      left: {position: [1, 0, 0], direction: [0, -1, 0], min_thrust: -9, max_thrust: 9}
      right: {position: [1, 0, 0], direction: [0, 1, 0], min_thrust: -9, max_thrust: 9}
"""


def fields(values):
    """A header: each field behind its length."""
    texts = [key.encode() + b'=' + value for key, value in values.items()]
    return b''.join(struct.pack('<I', len(text)) + text for text in texts)


def record(header, data):
    head = fields(header)
    return struct.pack('<I', len(head)) + head + struct.pack('<I', len(data)) + data


def packed(compression, chunk):
    if compression == 'bz2':
        return bz2.compress(chunk)
    return roslz4.compress(chunk) if compression == 'lz4' else chunk


def time_of(stamp_ns):
    return struct.pack('<II', stamp_ns // 1000000000, stamp_ns % 1000000000)


def bag(messages, compression='none', is_closed=True, is_defined=False):
    """The bytes of a bag with one chunk. @param messages (topic, stamp in ns, message). @param is_defined: with the definitions of the messages."""
    topics = sorted({(topic, type(message)) for topic, _, message in messages}, key=lambda pair: pair[0])
    connections = {topic: struct.pack('<I', number) for number, (topic, _) in enumerate(topics)}
    described = b''.join(
        record({'op': b'\x07', 'conn': connections[topic], 'topic': topic.encode()},
               fields({'type': kind._type.encode(), 'md5sum': kind._md5sum.encode(), 'message_definition': kind._full_text.encode() if is_defined else b''}))
        for topic, kind in topics)
    chunk, entries = described, {number: b'' for number in connections.values()}
    for topic, stamp_ns, message in messages:
        text = io.BytesIO()
        message.serialize(text)
        entries[connections[topic]] += time_of(stamp_ns) + struct.pack('<I', len(chunk))
        chunk += record({'op': b'\x02', 'conn': connections[topic], 'time': time_of(stamp_ns)}, text.getvalue())
    first_line = b'#ROSBAG V2.0\n'

    def header(index_pos):
        return record({'op': b'\x03', 'index_pos': struct.pack('<Q', index_pos), 'conn_count': struct.pack('<I', len(topics)),
                       'chunk_count': struct.pack('<I', 1)}, b'')
    chunk_pos = len(first_line + header(0))
    body = record({'op': b'\x05', 'compression': compression.encode(), 'size': struct.pack('<I', len(chunk))},
                  packed(compression, chunk))
    counts = b''
    for number, entry in entries.items():
        count = struct.pack('<I', len(entry) // 12)
        body += record({'op': b'\x04', 'ver': struct.pack('<I', 1), 'conn': number, 'count': count}, entry)
        counts += number + count
    info = record({'op': b'\x06', 'ver': struct.pack('<I', 1), 'chunk_pos': struct.pack('<Q', chunk_pos), 'start_time': time_of(0),
                   'end_time': time_of(10**9), 'count': struct.pack('<I', len(entries))}, counts)
    index = described + info if is_closed else b''
    return first_line + header(chunk_pos + len(body) if is_closed else 0) + body + index


def state(tick):
    message = State()
    message.tick = tick
    message.header.stamp.nsecs = tick * STEP_NS
    message.pose.orientation.w = 1.0
    return message


def command(number):
    message = AppliedCommand()
    message.number, message.tick, message.engines, message.rear = number, number, 7, 1.0
    return message


def event(number, kind):
    message = RunEvent()
    message.number, message.tick, message.kind, message.vehicle = number, number, kind, 'craft'
    message.pose.orientation.w = 1.0
    return message


def stamped(kind, tick):
    message = kind()
    message.header.stamp.nsecs = tick * STEP_NS
    pose = getattr(message, 'pose', None)
    if pose is not None:
        getattr(pose, 'pose', pose).orientation.w = 1.0
    return message


def layout(message):
    text = io.BytesIO()
    message.serialize(text)
    # Without comments, which are most of it.
    lines = [line.split('#')[0].rstrip() for line in message._full_text.splitlines()]
    definition = '\n'.join(line for line in lines if line)
    return '{}\n{}\n'.format(message._type, definition).encode() + b'\0' + text.getvalue()


def write(folder, target, seeds, ending):
    os.makedirs(os.path.join(folder, target), exist_ok=True)
    for name, content in seeds.items():
        with open(os.path.join(folder, target, name + ending), 'wb') as file:
            file.write(content)


def main():
    folder = sys.argv[1]
    recording = [('/hovercraft_sim/scenario', STEP_NS, String(SCENARIO)),
                 ('/craft/commands', STEP_NS, command(1)), ('/craft/commands', 2 * STEP_NS, command(2)),
                 ('/hovercraft_sim/events', STEP_NS, event(1, RunEvent.APPLY_WRENCH)),
                 ('/craft/state', STEP_NS, state(1)), ('/craft/state', 2 * STEP_NS, state(2))]
    hull = [('/craft/pose', STEP_NS, stamped(PoseStamped, 1)), ('/craft/twist', STEP_NS, stamped(TwistStamped, 1)),
            ('/craft/pose', 2 * STEP_NS, stamped(PoseStamped, 2)), ('/raft/odom', STEP_NS, stamped(Odometry, 1)),
            ('/raft/odom', 2 * STEP_NS, stamped(Odometry, 2))]
    thrusts = [('/craft/thrust', STEP_NS, ThrustCommand(rear=1.0)), ('/craft/thrust/rear', 2 * STEP_NS, Float64(2.0))]
    seeds = {'recording': bag(recording), 'recording_bz2': bag(recording, 'bz2'), 'recording_lz4': bag(recording, 'lz4'),
             'hull': bag(hull), 'thrusts': bag(thrusts), 'not_closed': bag(recording, is_closed=False),
             'lengths': b'#ROSBAG V2.0\n' + b'\xff' * 15}
    defined = {'recording': bag(recording, is_defined=True), 'hull': bag(hull, 'lz4', is_defined=True),
               'thrusts': bag(thrusts + hull[:2], is_defined=True)}
    layouts = {'pose': stamped(PoseStamped, 1), 'odometry': stamped(Odometry, 1), 'state': state(1), 'event': event(1, RunEvent.RESET),
               'text': String('text'), 'cushion': Cushion(cells=[CushionCell(), CushionCell()])}
    write(folder, 'bag', seeds, '.bag')
    write(folder, 'report_bag', defined, '.bag')
    write(folder, 'layout', {name: layout(message) for name, message in layouts.items()}, '')


if __name__ == '__main__':
    main()
