#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

/// The rules of determinism (ARCHITECTURE.md): what the C library computes with an error of its
/// own, such as a sine, differs between machines, so it is named in few places, none of which makes
/// a state.

namespace hovercraft {
namespace {

/// A place that may name such a function, and why no state depends on it.
struct NamedPlace {
  std::string file;
  std::string name;
  int times;
  std::string reason;
};

const std::vector<NamedPlace>& namedPlaces() {
  static const std::vector<NamedPlace> places = {
      {"src/math/elementary.cpp", "exp", 2, "Boost.Multiprecision's, in integer arithmetic"},
      {"src/math/elementary.cpp", "sin", 1, "Boost.Multiprecision's, in integer arithmetic"},
      {"src/math/elementary.cpp", "cos", 1, "Boost.Multiprecision's, in integer arithmetic"},
      {"src/math/elementary.cpp", "atan2", 1, "Boost.Multiprecision's, in integer arithmetic"},
      {"src/math/elementary.cpp", "asin", 1, "Boost.Multiprecision's, in integer arithmetic"},
      {"src/math/quaternion.cpp", "atan2", 1, "angleBetween: for reports"},
      {"src/geometry/shells.cpp", "atan2", 1, "the winding number, rounded: a verdict on a mesh"},
      {"src/analysis/compare.cpp", "sin", 5, "interpolates between samples of a finished run"},
      {"src/view/flown_path.cpp", "hypot", 1, "the spacing of a line that is drawn"},
      {"src/view/vehicle_markers.cpp", "acos", 1, "a right angle of a marker that is drawn"},
      {"src/view/robot_description.cpp", "atan2", 2, "the attitude of a fan that is drawn"},
      {"src/view/robot_description.cpp", "hypot", 1, "the attitude of a fan that is drawn"},
      {"src/report/figure_axes.cpp", "pow", 1, "round numbers beside a drawing"},
      {"src/report/figure_axes.cpp", "log10", 1, "round numbers beside a drawing"},
      {"src/report/figure_png.cpp", "hypot", 2, "pixels of a drawing"},
      {"src/report/run_figures.cpp", "atan2", 1, "a drawing"},
      {"src/report/run_figures.cpp", "cos", 1, "a drawing"},
      {"src/report/run_figures.cpp", "sin", 1, "a drawing"},
      {"src/report/run_figures.cpp", "hypot", 1, "a drawing"},
      {"src/report/run_motion.cpp", "atan2", 1, "speeds of a finished run that are drawn"},
      {"src/report/run_panels.cpp", "atan2", 2, "angles of a finished run that are drawn"},
      {"src/report/run_panels.cpp", "asin", 1, "angles of a finished run that are drawn"},
      {"src/report/run_panels.cpp", "acos", 1, "angles of a finished run that are drawn"},
      {"src/report/run_reader.cpp", "hypot", 1, "the top speed of a finished run"},
  };
  return places;
}

/// The functions of <cmath> that IEEE 754 does not round correctly, and what calls them or leaves
/// the order of a sum open. With f or l at its end each is the same in another precision.
const std::regex& inexact() {
  static const std::regex expression(
      "\\b(?:__builtin_)?((?:a?(?:sin|cos|tan)h?|atan2|sincos|exp|exp2|exp10|expm1|log|log2|log10|"
      "log1p|pow|powi|hypot|cbrt|fma|erfc?|[tl]gamma|lerp)[fl]?|std\\s*::\\s*(?:transform_)?reduce|"
      "AngleAxis[df]?|Rotation2D[df]?|eulerAngles|\\w+_distribution)\\b");
  return expression;
}

/// The text with a space for each character of a comment, a string or an #include.
std::string codeOf(const std::string& text) {
  static const std::regex not_code(
      "//[^\\n]*|/\\*[^*]*\\*+(?:[^/*][^*]*\\*+)*/"
      "|\"(?:[^\"\\\\\\n]|\\\\.)*\"|'(?:[^'\\\\\\n]|\\\\.)'|"
      "#[ \\t]*include[^\\n]*");
  std::string code = text;
  for (std::sregex_iterator match(text.begin(), text.end(), not_code), end; match != end; ++match) {
    const auto begin = code.begin() + match->position();
    std::replace_if(
        begin, begin + match->length(), [](char c) { return c != '\n'; }, ' ');
  }
  return code;
}

/// Where a text names an inexact function: the lines by the function's name.
std::map<std::string, std::vector<int>> inexactNamesIn(const std::string& text) {
  const std::string code = codeOf(text);
  std::map<std::string, std::vector<int>> lines;
  for (std::sregex_iterator match(code.begin(), code.end(), inexact()), end; match != end;
       ++match) {
    const auto before = std::count(code.begin(), code.begin() + match->position(), '\n');
    lines[match->str(1)].push_back(static_cast<int>(before) + 1);
  }
  return lines;
}

int allowed(const std::string& file, const std::string& name) {
  for (const NamedPlace& place : namedPlaces()) {
    if (place.file == file && place.name == name) return place.times;
  }
  return 0;
}

std::string contentsOf(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::vector<std::string> filesBelow(const std::vector<std::string>& roots) {
  std::vector<std::string> files;
  for (const std::string& root : roots) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
      if (entry.is_regular_file()) files.push_back(entry.path().generic_string());
    }
  }
  return files;
}

TEST(ExactFunctions, OnlyNamedPlacesCallTheCLibrarysInexactOnes) {
  const std::vector<std::string> files = filesBelow({"include/hovercraft_sim", "src"});
  EXPECT_GT(files.size(), 100U);
  for (const std::string& file : files) {
    for (const auto& [name, lines] : inexactNamesIn(contentsOf(file))) {
      EXPECT_LE(static_cast<int>(lines.size()), allowed(file, name))
          << file << ":" << lines.front() << ": '" << name
          << "' differs in the last bit from machine to machine: use math/elementary.h and "
             "math/vector.h; where no state depends on it, name the place here";
    }
  }
}

TEST(ExactFunctions, EveryNamedPlaceIsThere) {
  for (const NamedPlace& place : namedPlaces()) {
    const auto found = inexactNamesIn(contentsOf(place.file));
    const auto lines = found.find(place.name);
    ASSERT_NE(lines, found.end()) << place.file << " names no " << place.name;
    EXPECT_EQ(static_cast<int>(lines->second.size()), place.times) << place.file;
  }
}

// The rule must be able to refuse, however a call is written.
TEST(ExactFunctions, EveryWayToCallOneIsSeen) {
  for (const char* code : {"std::sin(x)",
                           "sin(x)",
                           "::cos (x)",
                           "std::\n  tan(x)",
                           "sinf(x)",
                           "std::powl(x, y)",
                           "__builtin_exp(x)",
                           "const auto f = &std::log;",
                           "using std::atan2;",
                           "std::pow<double>(x)",
                           "v.array().exp()",
                           "std::fma(a, b, c)",
                           "fmaf(a, b, c)",
                           "std::hypot(x, y)",
                           "cbrt(x)",
                           "acosh(x)",
                           "expm1(x)",
                           "log1p(x)",
                           "Eigen::AngleAxisd(a, axis)",
                           "/* */ tan(x)",
                           "std::normal_distribution<double> d",
                           "f(\"//\", sin(x))",
                           "std::reduce(a, b)"}) {
    EXPECT_EQ(inexactNamesIn(code).size(), 1U) << code;
  }
}

TEST(ExactFunctions, CommentsStringsAndOtherNamesAreNone) {
  for (const char* code :
       {"// sin(x)", "/* sin(x)\n * cos(x) */", "\"sin(x)\"", "\"a \\\" sin(x)\"", "exactSin(x)",
        "sine", "command_log.push(c)", "CommandLog", "std::sqrt(x)", "std::abs(x)",
        "std::fmod(x, y)", "std::ldexp(x, 2)", "std::frexp(x, &e)", "#include <random/exp.h>",
        "expected(x)", "kLog", "tangent(x)"}) {
    EXPECT_TRUE(inexactNamesIn(code).empty()) << code;
  }
}

TEST(ExactFunctions, TheLineIsNamed) {
  const auto found =
      inexactNamesIn("// sin\n/* a\nb */\nx = std::sin(a) + sin(b);\n\"\\n\" sin(c)");
  ASSERT_EQ(found.count("sin"), 1U);
  EXPECT_EQ(found.at("sin"), (std::vector<int>{4, 4, 5}));
}

}  // namespace
}  // namespace hovercraft
