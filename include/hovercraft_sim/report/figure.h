#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"

namespace hovercraft_ros {

/// A place in a figure, in its units (a 96th of an inch), y down.
struct FigurePoint {
  double x = 0.0;
  double y = 0.0;
};

struct FigureColor {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
};

struct FigureLine {
  std::vector<FigurePoint> points;
  FigureColor color;
  double width = 1.0;
  double dash = 0.0;  // length of a dash and of the gap after it; 0: none
};

struct FigureArea {
  std::vector<FigurePoint> corners;  // of a convex polygon
  FigureColor color;
};

enum class FigureAnchor { kBegin, kMiddle, kEnd };

struct FigureText {
  FigurePoint place;  // of the anchor, on the base line
  std::string text;
  double size = 12.0;  // height of the font; capitals are 0.7 of it
  FigureAnchor anchor = FigureAnchor::kBegin;
  bool is_upright = false;  // read from below
  FigureColor color;
};

/// A drawing on white: areas, then lines, then texts.
struct Figure {
  double width = 0.0;
  double height = 0.0;
  std::vector<FigureArea> areas;
  std::vector<FigureLine> lines;
  std::vector<FigureText> texts;
};

/// As an SVG document; texts are escaped, whatever a bag calls something.
HOVERCRAFT_PUBLIC std::string svgOf(const Figure& figure);

/// As a PNG of two pixels a unit.
HOVERCRAFT_PUBLIC std::string pngOf(const Figure& figure);

}  // namespace hovercraft_ros
