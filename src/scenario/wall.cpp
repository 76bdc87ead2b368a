#include "hovercraft_sim/scenario/wall.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft {
namespace {

/// 1 + cosine of the sharpest bend (-): 120 degrees, where the mitre is as long as the wall is
/// thick.
constexpr double kSharpestBend = 0.5;

using WallPoint = std::array<double, 2>;

WallPoint minus(const WallPoint& a, const WallPoint& b) {
  return {a[0] - b[0], a[1] - b[1]};
}

double dot(const WallPoint& a, const WallPoint& b) {
  return a[0] * b[0] + a[1] * b[1];
}

/// The wall seen from above: its two sides at each point.
class Outline {
 public:
  explicit Outline(const WallShape& wall) : wall_(wall), count_(wall.points.size()) {
    for (std::size_t i = 0; i < parts(); ++i) {
      const WallPoint along = minus(at(i + 1), at(i));
      const double length = std::sqrt(dot(along, along));
      directions_.push_back({along[0] / length, along[1] / length});
    }
    for (std::size_t i = 0; i < count_; ++i) {
      const bool is_first = !wall.closed && i == 0;
      const bool is_last = !wall.closed && i + 1 == count_;
      const WallPoint& before = i == 0 ? directions_.back() : directions_[i - 1];
      const WallPoint& in = is_first ? directions_.front() : before;
      const WallPoint& out = is_last ? directions_.back() : directions_[i];
      bends_.push_back(1.0 + dot(in, out));
      // (n_in + n_out) / (1 + n_in · n_out), n to the left.
      // A sharper bend is refused, whatever its sides are.
      const double half = 0.5 * wall.thickness / std::max(bends_.back(), kSharpestBend);
      const WallPoint across = {-half * (in[1] + out[1]), half * (in[0] + out[0])};
      left_.push_back({at(i)[0] + across[0], at(i)[1] + across[1]});
      right_.push_back({at(i)[0] - across[0], at(i)[1] - across[1]});
    }
  }

  std::size_t parts() const { return wall_.closed ? count_ : count_ - 1; }
  double bend(std::size_t i) const { return bends_[i]; }
  const WallPoint& left(std::size_t i) const { return left_[i % count_]; }
  const WallPoint& right(std::size_t i) const { return right_[i % count_]; }
  /// Whether both sides of a part go forward.
  bool isWhole(std::size_t part) const {
    return dot(minus(left(part + 1), left(part)), directions_[part]) > 0.0 &&
           dot(minus(right(part + 1), right(part)), directions_[part]) > 0.0;
  }

 private:
  const WallPoint& at(std::size_t i) const { return wall_.points[i % count_]; }

  const WallShape& wall_;
  std::size_t count_;
  std::vector<WallPoint> directions_;
  std::vector<double> bends_;
  std::vector<WallPoint> left_;
  std::vector<WallPoint> right_;
};

}  // namespace

WallShape parseWall(const ConfigReader& reader) {
  reader.allowOnly({"points", "closed", "thickness", "height"});
  WallShape wall;
  wall.points = reader.pairs("points", kCoordinate);
  wall.closed = reader.flagOr(false, "closed");
  wall.thickness = reader.length("thickness");
  wall.height = reader.length("height");
  const std::size_t least = wall.closed ? 3 : 2;
  if (wall.points.size() < least) {
    reader.fail("points", fmt::format("must be at least {}", least));
  }
  const auto fail = [&reader](std::size_t i, const char* rule) {
    reader.fail("", fmt::format("points[{}]: {}", i, rule));
  };
  const std::size_t parts = wall.points.size() - (wall.closed ? 0 : 1);
  for (std::size_t i = 0; i < parts; ++i) {
    const std::size_t next = (i + 1) % wall.points.size();
    const WallPoint along = minus(wall.points[next], wall.points[i]);
    if (!(dot(along, along) > 0.0)) fail(next, "must not be where the one before it is");
  }
  const Outline outline(wall);
  for (std::size_t i = 0; i < wall.points.size(); ++i) {
    if (!(outline.bend(i) >= kSharpestBend)) fail(i, "must not turn by more than 120 degrees");
  }
  for (std::size_t i = 0; i < parts; ++i) {
    if (!outline.isWhole(i)) {
      fail(i, "is too near to the next one: there the sides of a wall of this thickness cross");
    }
  }
  return wall;
}

std::string wallText(const WallShape& wall) {
  std::string text = "wall: {points: [";
  for (const WallPoint& p : wall.points) {
    text += fmt::format("{}[{}, {}]", text.back() == '[' ? "" : ", ", yamlNumber(p[0]),
                        yamlNumber(p[1]));
  }
  return text + fmt::format("], closed: {}, thickness: {}, height: {}}}",
                            wall.closed ? "true" : "false", yamlNumber(wall.thickness),
                            yamlNumber(wall.height));
}

std::vector<PointsShape> straightParts(const WallShape& wall) {
  const FloatingPointEnvironment environment;
  const Outline outline(wall);
  std::vector<PointsShape> parts;
  for (std::size_t i = 0; i < outline.parts(); ++i) {
    PointsShape part;
    for (const double z : {-0.5 * wall.height, 0.5 * wall.height}) {
      for (const WallPoint& p :
           {outline.left(i), outline.left(i + 1), outline.right(i + 1), outline.right(i)}) {
        part.points.emplace_back(p[0], p[1], z);
      }
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace hovercraft
