#include "hovercraft_sim/math/parse_number.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <locale.h>

#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {
namespace {

class DecimalScanner {
 public:
  explicit DecimalScanner(const std::string& text) : text_(text) {}

  /// True if the whole text is a decimal number.
  bool scan() {
    skipSign();
    const std::size_t whole = skipDigits();
    std::size_t fraction = 0;
    if (at('.')) {
      ++position_;
      fraction = skipDigits();
    }
    if (whole + fraction == 0) return false;
    if (at('e') || at('E')) {
      ++position_;
      skipSign();
      if (skipDigits() == 0) return false;
    }
    return position_ == text_.size();
  }

 private:
  bool at(char c) const { return position_ < text_.size() && text_[position_] == c; }
  void skipSign() {
    if (at('+') || at('-')) ++position_;
  }
  std::size_t skipDigits() {
    const std::size_t begin = position_;
    while (position_ < text_.size() && isDigit(text_[position_])) ++position_;
    return position_ - begin;
  }

  const std::string& text_;
  std::size_t position_ = 0;
};

bool isNotFiniteWord(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (!word.empty() && (word.front() == '+' || word.front() == '-')) word.erase(0, 1);
  if (!word.empty() && word.front() == '.') word.erase(0, 1);
  return word == "nan" || word == "inf" || word == "infinity";
}

}  // namespace

ParsedNumber parseNumber(const std::string& text) {
  const FloatingPointEnvironment environment;
  if (!DecimalScanner(text).scan()) {
    return {isNotFiniteWord(text) ? NumberSyntax::kNotFinite : NumberSyntax::kNoNumber, 0.0};
  }
  static const locale_t classic_locale = newlocale(LC_ALL_MASK, "C", nullptr);
  const double value = strtod_l(text.c_str(), nullptr, classic_locale);
  if (!std::isfinite(value)) return {NumberSyntax::kNotFinite, 0.0};
  return {NumberSyntax::kNumber, value};
}

}  // namespace hovercraft
