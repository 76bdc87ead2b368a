#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/report/figure.h"

namespace hovercraft_ros {

struct FigureRange {
  double least = 0.0;
  double most = 1.0;
};

/// A rectangle of a figure with two scales: lines at round numbers, their labels, a title.
class FigureAxes {
 public:
  /// @param frame from (left, top) to (right, bottom), in units of the figure. A range without an
  /// extent gets one.
  FigureAxes(const FigurePoint& left_top, const FigurePoint& right_bottom, FigureRange x,
             FigureRange y);

  /// Units of x and y become as long as each other: one of the ranges grows.
  void makeEqual();
  FigurePoint place(double x, double y) const;
  /// What of a convex polygon lies in the frame (Sutherland and Hodgman 1974).
  std::vector<FigurePoint> clipped(std::vector<FigurePoint> corners) const;
  void draw(Figure& figure, const std::string& x_label, const std::string& y_label) const;

 private:
  FigurePoint left_top_;
  FigurePoint right_bottom_;
  FigureRange x_;
  FigureRange y_;
};

/// A step of 1, 2 or 5 times a power of ten that divides the range into about `count`.
double roundStep(double range, int count);

}  // namespace hovercraft_ros
