#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/math/parse_number.h"

namespace hovercraft {
namespace {

TEST(ParseNumber, TakesEveryFormOfADecimalNumber) {
  const std::vector<std::pair<std::string, double>> forms = {
      {"1", 1.0},   {"+1", 1.0},      {"-1", -1.0},    {".5", 0.5},     {"5.", 5.0},
      {"1e3", 1e3}, {"1E+3", 1000.0}, {"2e-3", 0.002}, {"1e-400", 0.0}, {"007", 7.0}};
  for (const auto& [text, value] : forms) {
    const ParsedNumber parsed = parseNumber(text);
    EXPECT_EQ(parsed.syntax, NumberSyntax::kNumber) << text;
    EXPECT_EQ(parsed.value, value) << text;
  }
}

TEST(ParseNumber, TellsWhatIsNotFiniteFromWhatIsNoNumber) {
  for (const char* text :
       {"nan", "NaN", "-nan", ".nan", "inf", "+Inf", "-.inf", "infinity", "1e999", "-1e999"}) {
    EXPECT_EQ(parseNumber(text).syntax, NumberSyntax::kNotFinite) << text;
  }
  for (const char* text : {"", " ", "1 ", " 1", "1,5", "0x10", "1e", "e5", ".", "-", "1.2.3", "--1",
                           "1_000", "12a", "nano"}) {
    EXPECT_EQ(parseNumber(text).syntax, NumberSyntax::kNoNumber) << text;
  }
}

}  // namespace
}  // namespace hovercraft
