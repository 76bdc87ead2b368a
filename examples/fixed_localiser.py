#!/usr/bin/env python3
"""Stands for a localiser: a fixed transform from the map to an odometry frame, right as long as the odometry has not drifted."""

import math

import rospy
from geometry_msgs.msg import TransformStamped
from hovercraft_sim.version import answer_help, answer_version
from tf2_msgs.msg import TFMessage

if __name__ == '__main__':
    answer_version()
    answer_help(__doc__)
    rospy.init_node('fixed_localiser')
    x, y, yaw = (float(rospy.get_param('~' + name, 0.0)) for name in ('x', 'y', 'yaw'))
    transform = TransformStamped()
    transform.header.frame_id = rospy.get_param('~map_frame', 'map')
    transform.child_frame_id = rospy.get_param('~odom_frame', 'hovercraft/odom')
    transform.transform.translation.x, transform.transform.translation.y = x, y
    transform.transform.rotation.z, transform.transform.rotation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    publisher = rospy.Publisher('/tf_static', TFMessage, queue_size=1, latch=True)
    publisher.publish(TFMessage([transform]))
    rospy.spin()
