#include "hovercraft_sim/geometry/mesh_text.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "hovercraft_sim/math/parse_number.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {
namespace {

constexpr std::size_t kLongestShown = 24;  // bytes of a word in a message
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

char lowerCase(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

bool MeshWord::is(const char* lower_case_text) const {
  if (length != std::strlen(lower_case_text)) return false;
  for (std::size_t i = 0; i < length; ++i) {
    if (lowerCase(begin[i]) != lower_case_text[i]) return false;
  }
  return true;
}

std::string quoted(const MeshWord& word) {
  std::string text(word.begin, std::min(word.length, kLongestShown));
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return "'" + text + (word.length > kLongestShown ? "...'" : "'");
}

MeshText::MeshText(const std::string& content, std::string name)
    : content_(content), name_(std::move(name)) {
  const std::size_t zero = content_.find('\0');
  if (zero != std::string::npos) {
    throw std::invalid_argument(
        fmt::format("{}: the byte {} is zero: must be a text", name_, zero));
  }
  if (content_.compare(0, kByteOrderMark.size(), kByteOrderMark) == 0) {
    position_ = kByteOrderMark.size();
  }
}

/// @returns whether the last word ended in a backslash, which is no part of it.
bool MeshText::appendWords(std::vector<MeshWord>& words, std::size_t end, bool is_obj) {
  bool is_continued = false;
  while (true) {
    while (position_ < end && isBlank(content_[position_])) ++position_;
    if (position_ == end) return is_continued;
    const std::size_t begin = position_;
    while (position_ < end && !isBlank(content_[position_])) ++position_;
    is_continued = is_obj && content_[position_ - 1] == '\\';
    const std::size_t length = position_ - begin - (is_continued ? 1 : 0);
    if (length > 0) words.push_back({&content_[begin], length});
  }
}

MeshText::LineEnd MeshText::appendLine(std::vector<MeshWord>& words, bool is_obj) {
  if (position_ >= content_.size()) return LineEnd::kEndOfFile;
  ++line_;
  const std::size_t end = std::min(content_.find_first_of("\r\n", position_), content_.size());
  const std::string_view line = std::string_view(content_).substr(position_, end - position_);
  const std::size_t length_of_words = is_obj ? std::min(line.find('#'), line.size()) : line.size();
  const bool is_continued = appendWords(words, position_ + length_of_words, is_obj);
  const bool is_pair = content_.compare(end, 2, "\r\n") == 0;
  position_ = std::min(end + (is_pair ? 2 : 1), content_.size());
  return is_continued ? LineEnd::kContinued : LineEnd::kPlain;
}

double MeshText::coordinate(const MeshWord& word, double scale) const {
  const ParsedNumber parsed = parseNumber(word.text());
  if (parsed.syntax == NumberSyntax::kNoNumber) refuse(quoted(word) + ": must be a number");
  if (parsed.syntax == NumberSyntax::kNotFinite) refuse(quoted(word) + ": must be finite");
  const double scaled = parsed.value * scale;
  if (!(std::abs(scaled) <= kMostMeshCoordinate)) {
    refuse(fmt::format("{}: must be at most {:g} m", quoted(word), kMostMeshCoordinate));
  }
  return scaled;
}

void MeshText::refuse(const std::string& reason) const {
  throw std::invalid_argument(fmt::format("{}: line {}: {}", name_, line_, reason));
}

}  // namespace hovercraft
