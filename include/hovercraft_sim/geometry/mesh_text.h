#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// A view of a word of a text, which must outlive it.
struct MeshWord {
  const char* begin = nullptr;
  std::size_t length = 0;

  bool is(const char* lower_case_text) const;  // whether it is this text, in any case
  std::string text() const { return {begin, length}; }
};

/// The text of a mesh file, line by line. A line ends with LF, CR or both; a byte order mark at the
/// beginning counts as blank.
class MeshText {
 public:
  /// @param content outlives this. @param name begins every message.
  /// @throws std::invalid_argument if there is a zero byte.
  MeshText(const std::string& content, std::string name);

  /// What follows on a line after its words.
  enum class LineEnd { kPlain, kContinued, kEndOfFile };

  /// Appends the words of the next line. In an OBJ file # begins a comment, and a backslash at the
  /// end continues the line.
  bool appendWords(std::vector<MeshWord>& words, std::size_t end, bool is_obj);
  LineEnd appendLine(std::vector<MeshWord>& words, bool is_obj);

  /// The number of the line that was read last, from 1.
  int line() const { return line_; }

  /// A coordinate, scaled, m. @throws std::invalid_argument unless it is a number within
  /// kMostMeshCoordinate.
  double coordinate(const MeshWord& word, double scale) const;

  /// Throws std::invalid_argument: name, line, reason.
  [[noreturn]] void refuse(const std::string& reason) const;

 private:
  const std::string& content_;
  std::string name_;
  std::size_t position_ = 0;
  int line_ = 0;
};

/// A word as a message shows it: in quotes, short, printable.
std::string quoted(const MeshWord& word);

}  // namespace hovercraft
