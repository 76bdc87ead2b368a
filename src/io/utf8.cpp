#include "hovercraft_sim/io/utf8.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace hovercraft {
namespace {

constexpr std::uint32_t kNoCharacter = 0xffffffff;

/// The character that begins at a byte, and how many bytes it takes.
struct Character {
  std::uint32_t code = kNoCharacter;
  std::size_t length = 1;
};

std::uint32_t byteAt(const std::string& text, std::size_t i) {
  return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
}

Character characterAt(const std::string& text, std::size_t i) {
  struct Form {
    std::uint32_t mask, lead, least;
  };
  // RFC 3629: the bits of the first byte, and the least code that needs so many bytes.
  static constexpr std::array<Form, 4> kForms = {
      {{0x80, 0x00, 0}, {0xe0, 0xc0, 0x80}, {0xf0, 0xe0, 0x800}, {0xf8, 0xf0, 0x10000}}};
  const std::uint32_t first = byteAt(text, i);
  for (std::size_t more = 0; more < kForms.size(); ++more) {
    const Form& form = kForms[more];
    if ((first & form.mask) != form.lead) continue;
    std::uint32_t code = first & ~form.mask & 0xffU;
    for (std::size_t k = 1; k <= more; ++k) {
      const std::uint32_t byte = byteAt(text, i + k);
      if ((byte & 0xc0U) != 0x80U) return {};
      code = code << 6U | (byte & 0x3fU);
    }
    const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
    if (code < form.least || code > 0x10ffff || is_surrogate) return {};
    return {code, more + 1};
  }
  return {};
}

bool isControl(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7f && code <= 0x9f);
}

}  // namespace

std::optional<TextFault> faultOfText(const std::string& text) {
  std::size_t line = 1;
  for (std::size_t i = 0; i < text.size();) {
    const Character character = characterAt(text, i);
    const std::uint32_t code = character.code;
    if (code == kNoCharacter) return TextFault{line, "must be UTF-8"};
    if (code == 0x85 || code == 0x2028 || code == 0x2029) {
      return TextFault{line, "a line must end in LF or CR LF"};
    }
    if (isControl(code) && code != '\t' && code != '\n' && code != '\r') {
      return TextFault{line, "must not hold a control character"};
    }
    if (code == '\n') ++line;
    i += character.length;
  }
  return std::nullopt;
}

bool hasControlCharacter(const std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    const Character character = characterAt(text, i);
    if (isControl(character.code) && character.code != '\t' && character.code != '\n') return true;
    i += character.length;
  }
  return false;
}

std::string withoutByteOrderMark(const std::string& text) {
  const std::string mark = "\xef\xbb\xbf";
  return text.compare(0, mark.size(), mark) == 0 ? text.substr(mark.size()) : text;
}

}  // namespace hovercraft
