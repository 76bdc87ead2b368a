#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// Where a craft is at one time and how it moves: W world, B the frame that the trajectory follows.
struct TrajectorySample {
  std::int64_t time_ns = 0;        // ns
  Vector3 p_WB = Vector3::Zero();  // m
  Quaternion q_WB;                 // B -> W
  Vector3 v_WB = Vector3::Zero();  // m/s, in W
  Vector3 w_WB = Vector3::Zero();  // rad/s, in W
};

/// The way of one craft. Times increase from sample to sample.
struct Trajectory {
  std::string vehicle;          // empty where the source holds one craft and does not name it
  std::string source;           // for people: which file, which topic, which point of the craft
  bool has_velocities = true;   // else v_WB and w_WB mean nothing
  bool holds_time_zero = true;  // false for a bag: ROS takes time 0 for no time
  std::vector<TrajectorySample> samples;  // in the order of time
};

}  // namespace hovercraft
