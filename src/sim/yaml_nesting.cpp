#include "hovercraft_sim/sim/yaml_nesting.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace hovercraft {
namespace {

constexpr int kMostLevels = 200;  // a level takes some kilobytes of the stack's 8 megabytes
constexpr std::size_t kMostIndent = 1000;  // blanks; a level of a block takes at least one

/// What stands before the first word of a line: blanks, and marks of lists and of keys.
struct LineStart {
  std::size_t indent = 0;
  int marks = 0;
};

LineStart startOf(const std::string& text, std::size_t position) {
  LineStart start;
  for (; position < text.size(); ++position) {
    const char c = text[position];
    const bool is_mark = (c == '-' || c == '?' || c == ':') && position + 1 < text.size() &&
                         (text[position + 1] == ' ' || text[position + 1] == '\t');
    if (is_mark) {
      ++start.marks;
    } else if (c != ' ' && c != '\t') {
      break;
    }
    ++start.indent;
  }
  return start;
}

}  // namespace

void checkNesting(const std::string& text, const std::string& source) {
  int brackets = 0;
  std::size_t line = 1;
  bool begins_line = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    bool is_deep = false;
    if (begins_line) {
      const LineStart start = startOf(text, i);
      is_deep = start.marks > kMostLevels || start.indent > kMostIndent;
    }
    begins_line = c == '\n';
    if (c == '[' || c == '{') ++brackets;
    // In a quoted text a bracket may close what it did not open.
    if (c == ']' || c == '}') brackets = std::max(brackets - 1, 0);
    if (is_deep || brackets > kMostLevels) {
      throw std::invalid_argument(fmt::format("{}: line {}: must not be nested more than {} deep",
                                              source, line, kMostLevels));
    }
    if (begins_line) ++line;
  }
}

}  // namespace hovercraft
