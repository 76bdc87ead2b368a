#pragma once

#include <string>

namespace hovercraft {

/// Refuses a text whose brackets, list marks or indentation go deeper than any file that somebody
/// wrote: yaml-cpp before 0.7 calls itself once for each level, until there is no more stack.
/// @param source what the text is, for the message.
/// @throws std::invalid_argument that names source, line and rule.
void checkNesting(const std::string& text, const std::string& source);

}  // namespace hovercraft
