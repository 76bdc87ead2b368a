#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hovercraft_sim/io/input_file.h"
#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// A file of comma-separated values with a header, read row by row: only the current row is in
/// memory, and a line has a bound. No quotes, no comments; blanks around a field, CR before LF, a
/// byte-order mark and blank lines at the end are passed over. Every function throws
/// std::invalid_argument with one line: file, line number, column, value, rule.
class HOVERCRAFT_PUBLIC CsvReader {
 public:
  /// Opens the file and reads the header.
  explicit CsvReader(std::string path, InputKind kind = InputKind::kFile);

  /// Throws unless the header is one of these, each a list as `time,rear,left,right`.
  void requireHeader(const std::vector<std::string>& headers) const;
  bool hasColumn(const std::string& name) const;
  const std::vector<std::string>& header() const { return header_; }

  /// Moves to the next row; false at the end of the file.
  bool next();

  /// Fields of the current row, by the index of their column.
  const std::string& text(std::size_t column) const { return fields_[column]; }
  /// A finite number.
  double number(std::size_t column) const;
  /// Seconds as whole nanoseconds (parseNanoseconds()), from 0 to kMaxNanoseconds.
  std::int64_t timeNs(std::size_t column) const;

  /// Throws "file:line: column = value: rule".
  [[noreturn]] void fail(std::size_t column, const std::string& rule) const;
  /// Throws "file:line: rule".
  [[noreturn]] void fail(const std::string& rule) const;

 private:
  bool readLine();
  void split();

  std::string path_;
  InputFile file_;
  std::int64_t line_number_ = 0;
  std::string line_;
  std::vector<std::string> header_;
  std::vector<std::string> fields_;  // kept from row to row, so that their memory is
};

}  // namespace hovercraft
