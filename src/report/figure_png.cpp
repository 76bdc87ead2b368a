#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <zlib.h>

#include "hovercraft_sim/report/figure.h"
#include "hovercraft_sim/report/stroke_font.h"

namespace hovercraft_ros {
namespace {

constexpr double kScale = 2.0;        // pixels a unit
constexpr double kCapitals = 0.7;     // of the size of a font
constexpr double kPenOfText = 0.085;  // width of the lines of a letter, of its size
constexpr int kMostPixels = 16384;    // a side

/// What can stand for the characters of units that are no ASCII.
std::string asciiOf(const std::string& text) {
  static const std::array<std::pair<const char*, const char*>, 4> words = {
      {{"²", "^2"}, {"³", "^3"}, {"°", "deg "}, {"µ", "u"}}};
  std::string ascii = text;
  for (const auto& [from, to] : words) {
    const std::string find = from;
    for (std::size_t at = ascii.find(find); at != std::string::npos; at = ascii.find(find)) {
      ascii.replace(at, find.size(), to);
    }
  }
  return ascii;
}

/// Pixels that lines are drawn into, each covered by the share of it that lies under a line.
class Raster {
 public:
  Raster(int width, int height)
      : width_(width),
        height_(height),
        pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3, 255) {}

  void line(const std::vector<FigurePoint>& points, double width, const FigureColor& color);
  void area(const std::vector<FigurePoint>& corners, const FigureColor& color);
  /// Rows with the filter type 0 before each.
  std::vector<std::uint8_t> rows() const;

 private:
  struct Box {
    int left, top, right, bottom;  // right and bottom are not in it
    bool isEmpty() const { return left >= right || top >= bottom; }
  };
  Box boxOf(const std::vector<FigurePoint>& points, double margin) const;
  void blend(int x, int y, double share, const FigureColor& color);

  int width_;
  int height_;
  std::vector<std::uint8_t> pixels_;
};

Raster::Box Raster::boxOf(const std::vector<FigurePoint>& points, double margin) const {
  double left = width_;
  double right = 0.0;
  double top = height_;
  double bottom = 0.0;
  for (const FigurePoint& point : points) {
    left = std::min(left, point.x - margin);
    right = std::max(right, point.x + margin);
    top = std::min(top, point.y - margin);
    bottom = std::max(bottom, point.y + margin);
  }
  const auto within = [](double value, int most) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(most)));
  };
  return {within(std::floor(left), width_), within(std::floor(top), height_),
          within(std::ceil(right) + 1.0, width_), within(std::ceil(bottom) + 1.0, height_)};
}

void Raster::blend(int x, int y, double share, const FigureColor& color) {
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                              static_cast<std::size_t>(x));
  const std::array<std::uint8_t, 3> parts = {color.red, color.green, color.blue};
  for (std::size_t k = 0; k < parts.size(); ++k) {
    pixels_[at + k] = static_cast<std::uint8_t>(
        std::lround(pixels_[at + k] + share * (parts[k] - pixels_[at + k])));
  }
}

double distanceTo(const FigurePoint& a, const FigurePoint& b, double x, double y) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double squared = dx * dx + dy * dy;
  const double along =
      squared > 0.0 ? std::clamp(((x - a.x) * dx + (y - a.y) * dy) / squared, 0.0, 1.0) : 0.0;
  return std::hypot(x - a.x - along * dx, y - a.y - along * dy);
}

/// The whole line first, so that its joints are not drawn twice.
void Raster::line(const std::vector<FigurePoint>& points, double width, const FigureColor& color) {
  const double half = 0.5 * width;
  const Box all = boxOf(points, half + 1.0);
  if (points.empty() || all.isEmpty()) return;
  const auto columns = static_cast<std::size_t>(all.right - all.left);
  std::vector<float> shares(columns * static_cast<std::size_t>(all.bottom - all.top), 0.0F);
  for (std::size_t i = 0; i < std::max<std::size_t>(points.size() - 1, 1); ++i) {
    const FigurePoint& a = points[i];
    const FigurePoint& b = points[std::min(i + 1, points.size() - 1)];
    const Box box = boxOf({a, b}, half + 1.0);
    for (int y = box.top; y < box.bottom; ++y) {
      for (int x = box.left; x < box.right; ++x) {
        const double share = half + 0.5 - distanceTo(a, b, x + 0.5, y + 0.5);
        float& kept = shares[static_cast<std::size_t>(y - all.top) * columns +
                             static_cast<std::size_t>(x - all.left)];
        kept = std::max(kept, static_cast<float>(std::clamp(share, 0.0, std::min(1.0, width))));
      }
    }
  }
  for (int y = all.top; y < all.bottom; ++y) {
    for (int x = all.left; x < all.right; ++x) {
      const float share = shares[static_cast<std::size_t>(y - all.top) * columns +
                                 static_cast<std::size_t>(x - all.left)];
      if (share > 0.0F) blend(x, y, static_cast<double>(share), color);
    }
  }
}

void Raster::area(const std::vector<FigurePoint>& corners, const FigureColor& color) {
  const Box box = boxOf(corners, 0.0);
  for (int y = box.top; y < box.bottom; ++y) {
    double left = width_;
    double right = 0.0;
    const double middle = y + 0.5;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const FigurePoint& a = corners[i];
      const FigurePoint& b = corners[(i + 1) % corners.size()];
      if ((a.y <= middle) == (b.y <= middle)) continue;
      const double x = a.x + (middle - a.y) / (b.y - a.y) * (b.x - a.x);
      left = std::min(left, x);
      right = std::max(right, x);
    }
    for (int x = box.left; x < box.right; ++x) {
      const double share = std::min(right, x + 1.0) - std::max(left, static_cast<double>(x));
      if (share > 0.0) blend(x, y, std::min(share, 1.0), color);
    }
  }
}

std::vector<std::uint8_t> Raster::rows() const {
  const std::size_t row = 3 * static_cast<std::size_t>(width_);
  std::vector<std::uint8_t> rows;
  rows.reserve(pixels_.size() + static_cast<std::size_t>(height_));
  for (std::size_t at = 0; at < pixels_.size(); at += row) {
    rows.push_back(0);
    rows.insert(rows.end(), pixels_.begin() + static_cast<std::ptrdiff_t>(at),
                pixels_.begin() + static_cast<std::ptrdiff_t>(at + row));
  }
  return rows;
}

/// The line in dashes, of `dash` each.
std::vector<std::vector<FigurePoint>> dashesOf(const std::vector<FigurePoint>& points,
                                               double dash) {
  std::vector<std::vector<FigurePoint>> dashes;
  double done = 0.0;  // of the dash or the gap
  bool is_dash = true;
  if (!points.empty()) dashes.push_back({points.front()});
  for (std::size_t i = 1; i < points.size(); ++i) {
    FigurePoint from = points[i - 1];
    double left = std::hypot(points[i].x - from.x, points[i].y - from.y);
    while (done + left >= dash) {
      const double share = (dash - done) / left;
      from = {from.x + share * (points[i].x - from.x), from.y + share * (points[i].y - from.y)};
      left -= dash - done;
      done = 0.0;
      if (is_dash) dashes.back().push_back(from);
      is_dash = !is_dash;
      if (is_dash) dashes.push_back({from});
    }
    done += left;
    if (is_dash) dashes.back().push_back(points[i]);
  }
  return dashes;
}

std::vector<FigurePoint> scaled(const std::vector<FigurePoint>& points) {
  std::vector<FigurePoint> pixels;
  pixels.reserve(points.size());
  for (const FigurePoint& point : points) pixels.push_back({kScale * point.x, kScale * point.y});
  return pixels;
}

void drawText(Raster& raster, const FigureText& text) {
  const double size = kScale * text.size;
  const StrokedText strokes = strokesOf(asciiOf(text.text), kCapitals * size);
  const double begin = text.anchor == FigureAnchor::kBegin    ? 0.0
                       : text.anchor == FigureAnchor::kMiddle ? -0.5 * strokes.width
                                                              : -strokes.width;
  for (const auto& line : strokes.lines) {
    std::vector<FigurePoint> placed;
    for (const FigurePoint& point : line) {
      const double along = begin + point.x;
      placed.push_back(
          text.is_upright
              ? FigurePoint{kScale * text.place.x + point.y, kScale * text.place.y - along}
              : FigurePoint{kScale * text.place.x + along, kScale * text.place.y + point.y});
    }
    raster.line(placed, kPenOfText * size, text.color);
  }
}

void put32(std::string& bytes, std::uint32_t value) {
  for (const unsigned shift : {24U, 16U, 8U, 0U}) {
    bytes += static_cast<char>(static_cast<std::uint8_t>(value >> shift));
  }
}

/// Length, type, data, check sum (PNG specification, 5.3).
void putChunk(std::string& png, const std::string& type, const std::string& data) {
  put32(png, static_cast<std::uint32_t>(data.size()));
  const std::string checked = type + data;
  png += checked;
  std::vector<Bytef> bytes(checked.begin(), checked.end());
  put32(png, static_cast<std::uint32_t>(
                 crc32(crc32(0, nullptr, 0), bytes.data(), static_cast<uInt>(bytes.size()))));
}

std::string compressed(const std::vector<std::uint8_t>& rows) {
  uLongf size = compressBound(static_cast<uLong>(rows.size()));
  std::vector<Bytef> bytes(size);
  if (compress2(bytes.data(), &size, rows.data(), static_cast<uLong>(rows.size()), 9) != Z_OK) {
    throw std::runtime_error("zlib could not compress a picture");
  }
  return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)};
}

}  // namespace

std::string pngOf(const Figure& figure) {
  const int width = std::clamp(static_cast<int>(kScale * figure.width), 1, kMostPixels);
  const int height = std::clamp(static_cast<int>(kScale * figure.height), 1, kMostPixels);
  Raster raster(width, height);
  for (const FigureArea& area : figure.areas) raster.area(scaled(area.corners), area.color);
  for (const FigureLine& line : figure.lines) {
    const auto points = scaled(line.points);
    const auto parts = line.dash > 0.0 ? dashesOf(points, kScale * line.dash)
                                       : std::vector<std::vector<FigurePoint>>{points};
    for (const auto& part : parts) raster.line(part, kScale * line.width, line.color);
  }
  for (const FigureText& text : figure.texts) drawText(raster, text);
  std::string header;
  put32(header, static_cast<std::uint32_t>(width));
  put32(header, static_cast<std::uint32_t>(height));
  header += std::string("\x08\x02\x00\x00\x00", 5);  // 8 bits, RGB
  std::string png = "\x89PNG\r\n\x1a\n";
  putChunk(png, "IHDR", header);
  putChunk(png, "IDAT", compressed(raster.rows()));
  putChunk(png, "IEND", "");
  return png;
}

}  // namespace hovercraft_ros
