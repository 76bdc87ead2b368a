#include "hovercraft_sim/report/figure_axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <functional>

namespace hovercraft_ros {
namespace {

constexpr FigureColor kGrid = {225, 230, 235};
constexpr FigureColor kText = {40, 48, 56};
constexpr double kLabelSize = 11.0;
constexpr double kTitleSize = 12.0;

/// What differs by rounding only is one value: no two labels would differ.
FigureRange withExtent(FigureRange range) {
  const double size = std::max(std::abs(range.least), std::abs(range.most));
  if (range.most - range.least > std::max(1e-12, 1e-6 * size)) return range;
  const double room = size > 1e-12 ? 0.5 * size : 0.5;
  return {range.least - room, range.most + room};
}

}  // namespace

double roundStep(double range, int count) {
  const double wanted = range / count;
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= 0.99 * wanted) return factor * power;
  }
  return 10.0 * power;
}

FigureAxes::FigureAxes(const FigurePoint& left_top, const FigurePoint& right_bottom, FigureRange x,
                       FigureRange y)
    : left_top_(left_top), right_bottom_(right_bottom), x_(withExtent(x)), y_(withExtent(y)) {}

void FigureAxes::makeEqual() {
  const double width = right_bottom_.x - left_top_.x;
  const double height = right_bottom_.y - left_top_.y;
  const double unit = std::max((x_.most - x_.least) / width, (y_.most - y_.least) / height);
  const auto grow = [unit](FigureRange& range, double length) {
    const double middle = 0.5 * (range.least + range.most);
    range = {middle - 0.5 * unit * length, middle + 0.5 * unit * length};
  };
  grow(x_, width);
  grow(y_, height);
}

FigurePoint FigureAxes::place(double x, double y) const {
  const double along = (x - x_.least) / (x_.most - x_.least);
  const double up = (y - y_.least) / (y_.most - y_.least);
  return {left_top_.x + along * (right_bottom_.x - left_top_.x),
          right_bottom_.y - up * (right_bottom_.y - left_top_.y)};
}

std::vector<FigurePoint> FigureAxes::clipped(std::vector<FigurePoint> corners) const {
  // Each side of the frame: how far a point lies inside of it.
  const std::array<std::function<double(const FigurePoint&)>, 4> sides = {
      [this](const FigurePoint& p) { return p.x - left_top_.x; },
      [this](const FigurePoint& p) { return right_bottom_.x - p.x; },
      [this](const FigurePoint& p) { return p.y - left_top_.y; },
      [this](const FigurePoint& p) { return right_bottom_.y - p.y; }};
  for (const auto& inside : sides) {
    std::vector<FigurePoint> kept;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const FigurePoint& a = corners[i];
      const FigurePoint& b = corners[(i + 1) % corners.size()];
      const double begin = inside(a);
      const double end = inside(b);
      if (begin >= 0.0) kept.push_back(a);
      if ((begin >= 0.0) == (end >= 0.0)) continue;
      const double share = begin / (begin - end);
      kept.push_back({a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)});
    }
    corners = std::move(kept);
  }
  return corners;
}

void FigureAxes::draw(Figure& figure, const std::string& x_label,
                      const std::string& y_label) const {
  const double x_step = roundStep(x_.most - x_.least, 8);
  const double first_x = std::ceil(x_.least / x_step);
  for (int k = 0; (first_x + k) * x_step <= x_.most; ++k) {
    const double i = first_x + k;
    const double x = place(i * x_step, y_.least).x;
    figure.lines.push_back({{{x, left_top_.y}, {x, right_bottom_.y}}, kGrid, 0.8, 0.0});
    figure.texts.push_back({{x, right_bottom_.y + 15.0},
                            fmt::format("{:.6g}", i * x_step + 0.0),
                            kLabelSize,
                            FigureAnchor::kMiddle,
                            false,
                            kText});
  }
  const double y_step = roundStep(y_.most - y_.least, 5);
  const double first_y = std::ceil(y_.least / y_step);
  for (int k = 0; (first_y + k) * y_step <= y_.most; ++k) {
    const double i = first_y + k;
    const double y = place(x_.least, i * y_step).y;
    figure.lines.push_back({{{left_top_.x, y}, {right_bottom_.x, y}}, kGrid, 0.8, 0.0});
    figure.texts.push_back({{left_top_.x - 6.0, y + 4.0},
                            fmt::format("{:.6g}", i * y_step + 0.0),
                            kLabelSize,
                            FigureAnchor::kEnd,
                            false,
                            kText});
  }
  figure.texts.push_back({{0.5 * (left_top_.x + right_bottom_.x), right_bottom_.y + 33.0},
                          x_label,
                          kTitleSize,
                          FigureAnchor::kMiddle,
                          false,
                          kText});
  figure.texts.push_back({{left_top_.x - 46.0, 0.5 * (left_top_.y + right_bottom_.y)},
                          y_label,
                          kTitleSize,
                          FigureAnchor::kMiddle,
                          true,
                          kText});
}

}  // namespace hovercraft_ros
