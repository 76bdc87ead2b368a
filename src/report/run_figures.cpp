#include "hovercraft_sim/report/run_figures.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "hovercraft_sim/report/figure_axes.h"
#include "hovercraft_sim/scenario/world_builder.h"

namespace hovercraft_ros {
namespace {

/// Okabe and Ito 2008, darker where they are thin lines on white; as in the front end (theme.ts).
constexpr std::array<FigureColor, 7> kColors = {{{0x00, 0x72, 0xb2},
                                                 {0xd5, 0x5e, 0x00},
                                                 {0x00, 0x9e, 0x73},
                                                 {0xb0, 0x56, 0x8f},
                                                 {0x8a, 0x6d, 0x00},
                                                 {0x2a, 0x8f, 0xc4},
                                                 {0x44, 0x44, 0x44}}};
constexpr FigureColor kBodyColor = {0xb8, 0x93, 0x5a};
constexpr FigureColor kObstacleColor = {0xcb, 0xd2, 0xd9};
constexpr FigureColor kText = {27, 36, 48};
constexpr FigureColor kContactColor = {0xc0, 0x39, 0x2b};
constexpr double kWidth = 640.0;
constexpr double kPlotHeight = 300.0;
constexpr double kPathHeight = 560.0;
constexpr FigurePoint kLeftTop = {64.0, 44.0};
constexpr double kRight = 18.0;  // room beside and below a plot
constexpr double kBottom = 46.0;
constexpr double kTick = 9.0;  // length of a heading

FigureColor colorAt(std::size_t i) {
  return kColors[i % kColors.size()];
}

void include(FigureRange& range, double value) {
  if (!(std::abs(value) <= kGreatestDrawn)) return;
  range.least = std::min(range.least, value);
  range.most = std::max(range.most, value);
}

FigureRange emptyRange() {
  return {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
}

FigureRange orUnit(const FigureRange& range) {
  return range.least <= range.most ? range : FigureRange{0.0, 1.0};
}

/// The lines of a curve: of each column of half a unit its first, least, greatest and last value.
class CurveTracer {
 public:
  /// @param end s: what comes later, or before 0, is a gap.
  CurveTracer(const FigureAxes& axes, const RunPanel& panel, double end)
      : axes_(axes), panel_(panel), end_(end) {}

  std::vector<std::vector<FigurePoint>> trace(const RunCurve& curve) {
    lines_.clear();
    begin_ = true;
    for (std::size_t i = 0; i < curve.values.size(); ++i) {
      const double value = curve.values[i];
      const double time = kNanosecond * static_cast<double>(panel_.times_ns[i]);
      const bool is_within = time >= 0.0 && time <= end_;
      if (!is_within || !(std::abs(value) <= kGreatestDrawn)) {
        endColumn();
        begin_ = true;
        continue;
      }
      if (curve.is_demand && !begin_) add(axes_.place(time, held_));
      add(axes_.place(time, value));
      held_ = value;
    }
    endColumn();
    return std::move(lines_);
  }

 private:
  void add(const FigurePoint& point) {
    if (begin_) {
      lines_.emplace_back();
      begin_ = false;
    } else if (std::floor(2.0 * point.x) == std::floor(2.0 * column_.front().x)) {
      column_.push_back(point);
      return;
    } else {
      endColumn();
    }
    column_ = {point};
  }

  void endColumn() {
    if (column_.empty() || lines_.empty()) return;
    const auto by_height = [](const FigurePoint& a, const FigurePoint& b) { return a.y < b.y; };
    const auto [least, most] = std::minmax_element(column_.begin(), column_.end(), by_height);
    std::vector<FigurePoint>& line = lines_.back();
    line.push_back(column_.front());
    if (column_.size() > 2) {
      line.push_back(*least);
      line.push_back(*most);
    }
    if (column_.size() > 1) line.push_back(column_.back());
    column_.clear();
  }

  const FigureAxes& axes_;
  const RunPanel& panel_;
  double end_;
  std::vector<std::vector<FigurePoint>> lines_;
  std::vector<FigurePoint> column_;
  bool begin_ = true;
  double held_ = 0.0;
};

void drawPanel(const FigureAxes& axes, const RunPanel& panel, bool is_other, double end,
               Figure& figure) {
  std::vector<std::string> labels;
  CurveTracer tracer(axes, panel, end);
  for (const RunCurve& curve : panel.curves) {
    const auto at = std::find(labels.begin(), labels.end(), curve.label);
    const auto color = static_cast<std::size_t>(at - labels.begin());
    if (at == labels.end()) labels.push_back(curve.label);
    const double dash = curve.is_demand ? 2.0 : is_other ? 5.0 : 0.0;
    for (const auto& points : tracer.trace(curve)) {
      figure.lines.push_back({points, colorAt(color), curve.is_demand ? 0.9 : 1.5, dash});
    }
  }
}

/// What the lines are, in a row above the plot.
void drawLegend(const RunPanel& panel, bool has_other, Figure& figure) {
  double x = kLeftTop.x;
  std::vector<std::string> labels;
  const auto entry = [&](const std::string& text, const FigureColor& color, double dash) {
    figure.lines.push_back({{{x, 33.0}, {x + 20.0, 33.0}}, color, 1.5, dash});
    figure.texts.push_back({{x + 25.0, 37.0}, text, 11.0, FigureAnchor::kBegin, false, kText});
    x += 45.0 + 6.5 * static_cast<double>(text.size());
  };
  bool has_demand = false;
  for (const RunCurve& curve : panel.curves) {
    has_demand = has_demand || curve.is_demand;
    if (std::find(labels.begin(), labels.end(), curve.label) != labels.end()) continue;
    if (x > kWidth - 120.0) break;  // of a long list the first ones
    entry(curve.label, colorAt(labels.size()), 0.0);
    labels.push_back(curve.label);
  }
  if (has_demand) entry("demanded", kText, 2.0);
  if (has_other) entry("second run", kText, 5.0);
}

Figure panelFigure(const RunPanel& panel, const RunPanel* other, double end) {
  FigureRange values = emptyRange();
  for (const RunPanel* each : {&panel, other}) {
    if (each == nullptr) continue;
    for (const RunCurve& curve : each->curves) {
      for (const double value : curve.values) include(values, value);
    }
  }
  values = orUnit(values);
  const double room = 0.05 * (values.most - values.least);
  const FigureAxes axes(kLeftTop, {kWidth - kRight, kPlotHeight - kBottom}, {0.0, end},
                        {values.least - room, values.most + room});
  Figure figure = {kWidth, kPlotHeight, {}, {}, {}};
  const std::string unit = panel.unit.empty() ? "" : " (" + panel.unit + ")";
  axes.draw(figure, "time (s)", panel.unit.empty() ? "" : panel.unit);
  figure.texts.push_back(
      {{kLeftTop.x, 18.0}, panel.title + unit, 13.0, FigureAnchor::kBegin, false, kText});
  drawLegend(panel, other != nullptr, figure);
  drawPanel(axes, panel, false, end, figure);
  if (other != nullptr) drawPanel(axes, *other, true, end, figure);
  return figure;
}

/// The heading at even times, as short lines.
void drawHeadings(const FigureAxes& axes, const RunMotion& motion, const FigureColor& color,
                  Figure& figure) {
  const double span =
      kNanosecond * static_cast<double>(motion.times_ns.back() - motion.times_ns.front());
  if (!(span > 0.0)) return;
  const auto step_ns = static_cast<std::int64_t>(1e9 * roundStep(span, 30));
  std::int64_t next_ns = motion.times_ns.front();
  for (std::size_t i = 0; i < motion.times_ns.size(); ++i) {
    if (motion.times_ns[i] < next_ns) continue;
    next_ns = motion.times_ns[i] + std::max<std::int64_t>(step_ns, 1);
    const auto& [x, y, z, w] = motion.orientation;
    const double yaw =
        std::atan2(2.0 * (w[i] * z[i] + x[i] * y[i]), 1.0 - 2.0 * (y[i] * y[i] + z[i] * z[i]));
    const FigurePoint at = axes.place(motion.position[0][i], motion.position[1][i]);
    figure.lines.push_back(
        {{at, {at.x + kTick * std::cos(yaw), at.y - kTick * std::sin(yaw)}}, color, 1.2, 0.0});
  }
}

void drawWay(const FigureAxes& axes, const RunMotion& motion, const FigureColor& color, double dash,
             Figure& figure) {
  FigureLine line = {{}, color, 1.8, dash};
  for (std::size_t i = 0; i < motion.times_ns.size(); ++i) {
    const FigurePoint at = axes.place(motion.position[0][i], motion.position[1][i]);
    const bool is_last = i + 1 == motion.times_ns.size();
    if (!line.points.empty() && !is_last) {
      const FigurePoint& last = line.points.back();
      if (std::hypot(at.x - last.x, at.y - last.y) < 0.4) continue;
    }
    line.points.push_back(at);
  }
  figure.lines.push_back(line);
}

using PlanPoints = std::vector<std::pair<double, double>>;

/// Appends the points of which each turns left after the two before it, but for the last one.
void appendChain(const PlanPoints& points, PlanPoints& outline) {
  const std::size_t base = outline.size();
  for (const auto& [x, y] : points) {
    while (outline.size() >= base + 2) {
      const auto& [ax, ay] = outline[outline.size() - 2];
      const auto& [bx, by] = outline.back();
      if ((bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0.0) break;
      outline.pop_back();
    }
    outline.emplace_back(x, y);
  }
  outline.pop_back();
}

/// The convex outline of points: a lower and an upper chain (Andrew 1979).
PlanPoints outlineOf(PlanPoints points) {
  std::sort(points.begin(), points.end());
  PlanPoints outline;
  appendChain(points, outline);
  std::reverse(points.begin(), points.end());
  appendChain(points, outline);
  return outline;
}

void drawObstacles(const FigureAxes& axes, const RunData& run, Figure& figure) {
  if (!run.scenario || !run.scenario->world) return;
  for (const auto& obstacle : run.scenario->world->obstacles) {
    for (const auto& piece : hovercraft::piecesOf(obstacle)) {
      PlanPoints points;
      for (const hovercraft::Vector3& corner : hovercraft::hullPoints(piece)) {
        points.emplace_back(corner.x(), corner.y());
      }
      FigureArea area = {{}, kObstacleColor};
      for (const auto& [x, y] : outlineOf(std::move(points))) {
        area.corners.push_back(axes.place(x, y));
      }
      area.corners = axes.clipped(std::move(area.corners));
      if (!area.corners.empty()) figure.areas.push_back(area);
    }
  }
}

bool isDrawn(const RunContact& contact) {
  return contact.point.cwiseAbs().maxCoeff() <= kFarthestDrawn;
}

/// Axes around all ways and contacts, with one scale.
FigureAxes pathAxes(const std::vector<RunData>& runs) {
  FigureRange x = emptyRange();
  FigureRange y = emptyRange();
  for (const RunData& run : runs) {
    for (const RunBody& body : run.bodies) {
      for (const double value : body.motion.position[0]) include(x, value);
      for (const double value : body.motion.position[1]) include(y, value);
    }
    for (const RunContact& contact : run.contacts) {
      if (!isDrawn(contact)) continue;
      include(x, contact.point.x());
      include(y, contact.point.y());
    }
  }
  const double room = 0.05 * std::max(x.most - x.least, y.most - y.least);
  FigureAxes axes(kLeftTop, {kWidth - kRight, kPathHeight - kBottom},
                  {x.least - room, x.most + room}, {y.least - room, y.most + room});
  axes.makeEqual();
  return axes;
}

/// The ways of a run and their names, from `legend` on, the x of the next one.
void drawWays(const FigureAxes& axes, const RunData& run, bool is_first, double& legend,
              Figure& figure) {
  const double dash = is_first ? 0.0 : 5.0;
  for (std::size_t i = 0; i < run.bodies.size(); ++i) {
    const RunBody& body = run.bodies[i];
    const FigureColor color = body.is_craft ? colorAt(i) : kBodyColor;
    drawWay(axes, body.motion, color, dash, figure);
    if (is_first && body.is_craft) drawHeadings(axes, body.motion, color, figure);
    const std::string name = body.name + (is_first ? "" : ", second run");
    if (legend > kWidth - 100.0) continue;
    figure.lines.push_back({{{legend, 33.0}, {legend + 20.0, 33.0}}, color, 1.8, dash});
    figure.texts.push_back({{legend + 25.0, 37.0}, name, 11.0, FigureAnchor::kBegin, false, kText});
    legend += 45.0 + 6.5 * static_cast<double>(name.size());
  }
}

Figure pathFigure(const std::vector<RunData>& runs) {
  const FigureAxes axes = pathAxes(runs);
  Figure figure = {kWidth, kPathHeight, {}, {}, {}};
  drawObstacles(axes, runs.front(), figure);
  axes.draw(figure, "x (m)", "y (m)");
  figure.texts.push_back(
      {{kLeftTop.x, 18.0}, "Way in the world frame", 13.0, FigureAnchor::kBegin, false, kText});
  double legend = kLeftTop.x;
  for (const RunData& run : runs) drawWays(axes, run, &run == &runs.front(), legend, figure);
  for (const RunContact& contact : runs.front().contacts) {
    if (!isDrawn(contact)) continue;
    const FigurePoint at = axes.place(contact.point.x(), contact.point.y());
    figure.lines.push_back(
        {{{at.x - 3.5, at.y - 3.5}, {at.x + 3.5, at.y + 3.5}}, kContactColor, 1.3, 0.0});
    figure.lines.push_back(
        {{{at.x - 3.5, at.y + 3.5}, {at.x + 3.5, at.y - 3.5}}, kContactColor, 1.3, 0.0});
  }
  return figure;
}

/// What is left of a text as the name of a file, whatever a bag calls something.
std::string fileNameOf(const std::string& text) {
  std::string name;
  for (const char character : text) {
    const bool is_letter =
        (character >= 'a' && character <= 'z') || (character >= '0' && character <= '9');
    const bool is_capital = character >= 'A' && character <= 'Z';
    if (is_letter) name += character;
    if (is_capital) name += static_cast<char>(character - 'A' + 'a');
    if (!is_letter && !is_capital && !name.empty() && name.back() != '_') name += '_';
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name.empty() ? "plot" : name.substr(0, 80);
}

/// The same body in the second run, if there is one: by its name, or where each run has one body.
const RunBody* partnerOf(const RunBody& body, const std::vector<RunData>& runs) {
  if (runs.size() < 2) return nullptr;
  const bool is_only = runs[0].bodies.size() == 1 && runs[1].bodies.size() == 1;
  const RunBody* partner = nullptr;
  for (const RunBody& other : runs[1].bodies) {
    if (other.name == body.name || is_only) partner = &other;
  }
  return partner;
}

const RunPanel* partnerOf(const RunPanel& panel, const RunBody* other) {
  if (other == nullptr) return nullptr;
  const auto at =
      std::find_if(other->panels.begin(), other->panels.end(), [&](const RunPanel& each) {
        return each.title == panel.title && (each.is_main || each.source == panel.source);
      });
  return at == other->panels.end() ? nullptr : &*at;
}

/// Figures under names of files, none twice.
class FigureList {
 public:
  void add(const std::string& wanted, Figure figure) {
    std::string name = fileNameOf(wanted);
    for (int i = 2; !names_.insert(name).second; ++i) {
      name = fmt::format("{}_{}", fileNameOf(wanted), i);
    }
    figures_.push_back({name, std::move(figure)});
  }
  std::vector<NamedFigure> take() { return std::move(figures_); }

 private:
  std::vector<NamedFigure> figures_;
  std::set<std::string> names_;
};

}  // namespace

std::vector<NamedFigure> figuresOf(const std::vector<RunData>& runs) {
  FigureList figures;
  double end = 0.0;
  for (const RunData& run : runs) {
    end = std::max(end, kNanosecond * static_cast<double>(run.end_ns));
  }
  figures.add("way", pathFigure(runs));
  for (const RunBody& body : runs.front().bodies) {
    const RunBody* const partner = partnerOf(body, runs);
    for (const RunPanel& panel : body.panels) {
      const std::string source = panel.is_main ? "" : panel.source + "_";
      figures.add(body.name + "_" + source + panel.title,
                  panelFigure(panel, partnerOf(panel, partner), end));
    }
  }
  for (const RunPanel& panel : runs.front().panels) {
    figures.add(panel.source + "_" + panel.title, panelFigure(panel, nullptr, end));
  }
  return figures.take();
}

}  // namespace hovercraft_ros
