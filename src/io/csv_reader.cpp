#include "hovercraft_sim/io/csv_reader.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {
namespace {

constexpr std::size_t kLongestLine = 65536;  // bytes: no row of numbers is a tenth as long
constexpr std::size_t kLongestShown = 80;    // bytes of a field in a message
constexpr const char* kBlanks = " \t\r";
constexpr const char* kByteOrderMark = "\xEF\xBB\xBF";

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

/// What a message shows of a text: no more than a field, and nothing that a terminal obeys.
std::string shown(std::string text) {
  if (text.size() > kLongestShown) text = text.substr(0, kLongestShown) + "...";
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');
  return text;
}

}  // namespace

CsvReader::CsvReader(std::string path, InputKind kind)
    : path_(std::move(path)), file_(path_, kind) {
  if (!readLine()) throw std::invalid_argument(path_ + ": the file is empty; a header is missing");
  if (line_.rfind(kByteOrderMark, 0) == 0) line_.erase(0, std::strlen(kByteOrderMark));
  split();
  header_ = fields_;
}

void CsvReader::requireHeader(const std::vector<std::string>& headers) const {
  const std::string found = fmt::format("{}", fmt::join(header_, ","));
  if (std::find(headers.begin(), headers.end(), found) != headers.end()) return;
  throw std::invalid_argument(fmt::format("{}:1: header = {}: must be {}", path_, shown(found),
                                          fmt::join(headers, " or ")));
}

bool CsvReader::hasColumn(const std::string& name) const {
  return std::find(header_.begin(), header_.end(), name) != header_.end();
}

bool CsvReader::readLine() {
  if (!file_.readLine(line_, kLongestLine)) return false;
  ++line_number_;
  return true;
}

void CsvReader::split() {
  std::size_t count = 0;
  std::size_t begin = 0;
  while (begin <= line_.size()) {
    const std::size_t end = std::min(line_.find(',', begin), line_.size());
    if (count == fields_.size()) fields_.emplace_back();
    const std::size_t first = std::min(line_.find_first_not_of(kBlanks, begin), end);
    std::size_t last = end;
    while (last > first && isBlank(line_[last - 1])) --last;
    fields_[count++].assign(line_, first, last - first);
    begin = end + 1;
  }
  fields_.resize(count);
}

bool CsvReader::next() {
  if (!readLine()) return false;
  split();
  if (fields_.size() == 1 && fields_.front().empty()) {
    const std::int64_t blank_line = line_number_;
    while (readLine()) {
      if (line_.find_first_not_of(kBlanks) == std::string::npos) continue;
      line_number_ = blank_line;
      fail("a blank line must be the last");
    }
    return false;
  }
  if (fields_.size() != header_.size()) {
    fail(fmt::format("{} fields: must have {}, as the header", fields_.size(), header_.size()));
  }
  return true;
}

double CsvReader::number(std::size_t column) const {
  const ParsedNumber parsed = parseNumber(fields_[column]);
  if (parsed.syntax == NumberSyntax::kNoNumber) fail(column, "must be a number");
  if (parsed.syntax == NumberSyntax::kNotFinite) fail(column, "must be finite");
  return parsed.value;
}

std::int64_t CsvReader::timeNs(std::size_t column) const {
  const double seconds = number(column);
  constexpr double kMostSeconds = kMaxNanoseconds / static_cast<double>(kNanosecondsPerSecond);
  if (seconds < 0.0) fail(column, "must be 0 or greater");
  if (seconds > kMostSeconds) fail(column, fmt::format("must be at most {:.0f} s", kMostSeconds));
  return parseNanoseconds(fields_[column]);
}

void CsvReader::fail(std::size_t column, const std::string& rule) const {
  throw std::invalid_argument(fmt::format("{}:{}: {} = {}: {}", path_, line_number_,
                                          header_[column], shown(fields_[column]), rule));
}

void CsvReader::fail(const std::string& rule) const {
  throw std::invalid_argument(fmt::format("{}:{}: {}", path_, line_number_, rule));
}

}  // namespace hovercraft
