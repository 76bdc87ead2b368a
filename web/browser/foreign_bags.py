#!/usr/bin/env python3
"""Writes bags that this package did not record: poses alone, odometry alone, and one whose texts would be markup on a careless page.

usage: foreign_bags.py FOLDER
"""

import math
import pathlib
import sys

from geometry_msgs.msg import PoseStamped
from hovercraft_sim.msg import Contact
from nav_msgs.msg import Odometry
import rosbag
import rospy
from std_msgs.msg import String

MARKUP = '</script><script>window.hurt = 1</script><img src=x onerror="window.hurt = 1">'


def circle(kind, pose_of):
    for i in range(200):
        time = 0.05 * i
        message = kind()
        message.header.stamp = rospy.Time.from_sec(100 + time)
        pose = pose_of(message)
        pose.position.x, pose.position.y = 2 * math.sin(time), 2 - 2 * math.cos(time)
        pose.orientation.z, pose.orientation.w = math.sin(time / 2), math.cos(time / 2)
        yield message


def main():
    folder = pathlib.Path(sys.argv[1])
    with rosbag.Bag(folder / 'poses.bag', 'w') as bag:
        for message in circle(PoseStamped, lambda stamped: stamped.pose):
            bag.write('/car/pose', message, message.header.stamp)
    with rosbag.Bag(folder / 'odometry.bag', 'w') as bag:
        for message in circle(Odometry, lambda odom: odom.pose.pose):
            message.twist.twist.linear.x, message.twist.twist.angular.z = 2, 1
            bag.write('/odom', message, message.header.stamp)
    with rosbag.Bag(folder / 'hostile.bag', 'w') as bag:
        for message in circle(PoseStamped, lambda stamped: stamped.pose):
            bag.write('/car/pose', message, message.header.stamp)
        contact = Contact(body_a=MARKUP, body_b='b')
        contact.header.stamp = rospy.Time.from_sec(102)
        bag.write('/contacts', contact, contact.header.stamp)
        bag.write('/sim/scenario', String(MARKUP), contact.header.stamp)


if __name__ == '__main__':
    main()
