#include <cmath>
#include <zlib.h>

#include <gtest/gtest.h>

#include "hovercraft_sim/report/figure.h"
#include "hovercraft_sim/report/figure_axes.h"
#include "hovercraft_sim/report/stroke_font.h"

namespace hovercraft_ros {
namespace {

/// A PNG that is read: its size, and its pixels as rows of RGB.
struct Picture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> pixels;

  explicit Picture(const std::string& png) {
    const auto number = [&](std::size_t at) {
      std::uint32_t value = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        value = value << 8U | static_cast<unsigned char>(png.at(at + i));
      }
      return value;
    };
    std::string data;
    for (std::size_t at = 8; at < png.size(); at += 12 + number(at)) {
      const std::string checked = png.substr(at + 4, 4 + number(at));
      const std::vector<Bytef> bytes(checked.begin(), checked.end());
      EXPECT_EQ(number(at + 8 + number(at)),
                crc32(crc32(0, nullptr, 0), bytes.data(), static_cast<uInt>(bytes.size())));
      if (checked.rfind("IDAT", 0) == 0) data += checked.substr(4);
    }
    width = number(16);
    height = number(20);
    pixels.resize(std::size_t{height} * (3 * width + 1));
    uLongf size = pixels.size();
    const std::vector<Bytef> packed(data.begin(), data.end());
    EXPECT_EQ(uncompress(pixels.data(), &size, packed.data(), packed.size()), Z_OK);
    EXPECT_EQ(size, pixels.size());
  }

  FigureColor at(std::size_t x, std::size_t y) const {
    const std::uint8_t* pixel = &pixels.at(y * (3 * width + 1) + 1 + 3 * x);
    return {pixel[0], pixel[1], pixel[2]};
  }
  /// Pixels that are not white, each by the share of black in it.
  double ink() const {
    double sum = 0.0;
    for (std::size_t y = 0; y < height; ++y) {
      for (std::size_t x = 0; x < width; ++x) sum += (255 - at(x, y).red) / 255.0;
    }
    return sum;
  }
};

TEST(Figure, ALineCoversItsLengthTimesItsWidth) {
  Figure figure = {100.0, 80.0, {}, {}, {}};
  figure.lines.push_back({{{10.0, 10.0}, {70.0, 55.0}}, {0, 0, 0}, 3.0, 0.0});
  const Picture picture(pngOf(figure));
  EXPECT_EQ(picture.width, 200U);
  EXPECT_EQ(picture.height, 160U);
  // 150 pixels long, 6 wide, with round ends: a disc of diameter 6 more.
  EXPECT_NEAR(picture.ink(), 150.0 * 6.0 + 28.3, 10.0);
  EXPECT_EQ(picture.at(80, 65).red, 0);  // its middle
  EXPECT_EQ(picture.at(20, 100).red, 255);
}

TEST(Figure, DashesCoverHalfOfIt) {
  Figure figure = {100.0, 20.0, {}, {}, {}};
  figure.lines.push_back({{{5.0, 10.0}, {95.0, 10.0}}, {0, 0, 0}, 1.0, 5.0});
  // Nine dashes of 10 pixels by 2, each with round ends: half a disc of diameter 2 at both.
  EXPECT_NEAR(Picture(pngOf(figure)).ink(), 9.0 * (10.0 * 2.0 + 3.14), 9.0);
}

TEST(Figure, AnAreaIsFilled) {
  Figure figure = {50.0, 50.0, {}, {}, {}};
  figure.areas.push_back({{{10.0, 10.0}, {40.0, 10.0}, {40.0, 40.0}}, {10, 20, 30}});
  const Picture picture(pngOf(figure));
  const FigureColor inside = picture.at(70, 30);
  EXPECT_EQ(inside.red, 10);
  EXPECT_EQ(inside.green, 20);
  EXPECT_EQ(inside.blue, 30);
  EXPECT_EQ(picture.at(30, 70).red, 255);
  EXPECT_NEAR(picture.ink(), 0.5 * 60.0 * 60.0 * 245.0 / 255.0, 40.0);
}

TEST(Figure, WhatLiesOutsideHurtsNothing) {
  Figure figure = {20.0, 20.0, {}, {}, {}};
  figure.lines.push_back({{{-1e9, 5.0}, {1e9, 5.0}}, {0, 0, 0}, 1.0, 0.0});
  figure.lines.push_back({{{-500.0, -500.0}, {-400.0, -400.0}}, {0, 0, 0}, 1.0, 0.0});
  figure.areas.push_back({{{-50.0, -50.0}, {-40.0, -50.0}, {-40.0, -40.0}}, {0, 0, 0}});
  figure.texts.push_back({{1e4, 1e4}, "far away", 12.0, FigureAnchor::kEnd, true, {0, 0, 0}});
  EXPECT_NEAR(Picture(pngOf(figure)).ink(), 40.0 * 2.0, 1.0);
}

TEST(StrokeFont, LettersStandOnTheirBaseLineAndCapitalsHaveTheSize) {
  double top = 0.0;
  double bottom = -1e9;
  const StrokedText strokes = strokesOf("H", 21.0);
  for (const auto& line : strokes.lines) {
    for (const FigurePoint& point : line) {
      top = std::min(top, point.y);
      bottom = std::max(bottom, point.y);
    }
  }
  EXPECT_DOUBLE_EQ(top, -21.0);
  EXPECT_DOUBLE_EQ(bottom, 0.0);
  EXPECT_EQ(strokes.lines.size(), 3U);
  EXPECT_DOUBLE_EQ(strokesOf("HH", 21.0).width, 2.0 * strokes.width);
  // Every character of ASCII, and what is none of it is a question mark.
  for (int code = 33; code < 127; ++code) {
    EXPECT_FALSE(strokesOf(std::string(1, static_cast<char>(code)), 10.0).lines.empty()) << code;
  }
  EXPECT_TRUE(strokesOf(" ", 10.0).lines.empty());
  EXPECT_EQ(strokesOf("\xff\x01", 10.0).width, strokesOf("??", 10.0).width);
}

TEST(Svg, TextsAreEscaped) {
  Figure figure = {10.0, 10.0, {}, {}, {}};
  figure.texts.push_back(
      {{1.0, 2.0}, "<a href=\"x\">&'\x01", 12.0, FigureAnchor::kMiddle, true, {}});
  const std::string svg = svgOf(figure);
  EXPECT_NE(svg.find(">&#60;a href=&#34;x&#34;&#62;&#38;&#39;?</text>"), std::string::npos) << svg;
  EXPECT_NE(svg.find("text-anchor=\"middle\""), std::string::npos);
  EXPECT_NE(svg.find("rotate(-90 1.00 2.00)"), std::string::npos);
}

TEST(FigureAxes, PlacesClipsAndMakesUnitsEqual) {
  FigureAxes axes({10.0, 10.0}, {110.0, 60.0}, {0.0, 10.0}, {0.0, 10.0});
  EXPECT_DOUBLE_EQ(axes.place(0.0, 0.0).x, 10.0);
  EXPECT_DOUBLE_EQ(axes.place(0.0, 0.0).y, 60.0);
  EXPECT_DOUBLE_EQ(axes.place(10.0, 10.0).y, 10.0);
  axes.makeEqual();  // 10 units a unit before, 5 up: x becomes 20 wide about its middle
  EXPECT_DOUBLE_EQ(axes.place(5.0, 0.0).x, 60.0);
  EXPECT_DOUBLE_EQ(axes.place(6.0, 0.0).x - axes.place(5.0, 0.0).x, 5.0);
  const auto clipped = axes.clipped({{0.0, 0.0}, {60.0, 0.0}, {60.0, 30.0}, {0.0, 30.0}});
  ASSERT_EQ(clipped.size(), 4U);
  for (const FigurePoint& corner : clipped) {
    EXPECT_TRUE(corner.x == 10.0 || corner.x == 60.0) << corner.x;
    EXPECT_TRUE(corner.y == 10.0 || corner.y == 30.0) << corner.y;
  }
  EXPECT_TRUE(axes.clipped({{0.0, 0.0}, {5.0, 0.0}, {5.0, 5.0}}).empty());
}

TEST(FigureAxes, StepsAreRound) {
  EXPECT_DOUBLE_EQ(roundStep(10.0, 5), 2.0);
  EXPECT_DOUBLE_EQ(roundStep(0.6, 8), 0.1);
  EXPECT_DOUBLE_EQ(roundStep(37.0, 8), 5.0);
  EXPECT_DOUBLE_EQ(roundStep(7e5, 8), 1e5);
}

}  // namespace
}  // namespace hovercraft_ros
