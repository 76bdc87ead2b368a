#pragma once

#include <istream>
#include <string>

#include "hovercraft_sim/math/export.h"

namespace hovercraft_ros {

/// Reads the whole structure of a bag of format 2.0 and every length, count, position and offset in
/// it, chunks decompressed, before rosbag does: rosbag believes them, and a file of 28 bytes ends
/// the program. It takes as long as decompressing the bag once; a chunk at a time is in memory.
/// @param bag open for reading, binary. @param name for messages.
/// @throws std::invalid_argument that names the file, the byte and the rule; also if the bag has no
/// index, is encrypted or of another format.
HOVERCRAFT_PUBLIC void checkBag(std::istream& bag, const std::string& name);

}  // namespace hovercraft_ros
