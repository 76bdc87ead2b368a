#pragma once

#include <cstddef>
#include <string>

namespace hovercraft {

/// The whole content of a regular file, or of one that a link points to. Anything else (a folder, a
/// FIFO, a device, a socket) is refused without being read, and nothing is waited for. Memory is
/// bounded: what is longer, or grows meanwhile, is refused.
/// @param name begins every message, such as "mesh file 'hull.obj'".
/// @param most_bytes that it may hold.
/// @throws std::invalid_argument
std::string contentOfRegularFile(const std::string& path, const std::string& name,
                                 std::size_t most_bytes);

}  // namespace hovercraft
