#include "hovercraft_sim/collision/feature_walk.h"

namespace hovercraft {
namespace {

struct Top {
  std::int32_t place;
  double value;
};

/// Goes `stride` places to the higher side, if one is higher than here.
template <typename Function>
bool rise(std::int32_t count, std::int32_t stride, const Function& f, Top& top) {
  const Top right{(top.place + stride) % count, f((top.place + stride) % count)};
  const Top left{(top.place - stride + count) % count, f((top.place - stride + count) % count)};
  if (right.value <= top.value && left.value <= top.value) return false;
  top = right.value > left.value ? right : left;
  return true;
}

/// Looks past values that are level with the top to either side: sides in line and spokes in a
/// plane have the same value but for rounding. @returns whether a higher one came, which is the new
/// top.
template <typename Function>
bool leaveLevel(std::int32_t count, double level, const Function& f, Top& top) {
  for (const std::int32_t way : {1, count - 1}) {
    Top next = top;
    for (std::int32_t looks = 1; looks < count; ++looks) {
      next.place = (next.place + way) % count;
      next.value = f(next.place);
      if (next.value > top.value) {
        top = next;
        return true;
      }
      if (next.value < top.value - level) break;
    }
  }
  return false;
}

/// The place of the largest value of f over a cycle of `count` places, where f rises to it from
/// both sides, starting at `hint`: two looks to either side when the hint is right, else strides
/// that halve. @param level difference below which two values may be the same but for rounding.
template <typename Function>
std::int32_t topOfCycle(std::int32_t count, std::int32_t hint, double level, const Function& f) {
  const std::int32_t start = hint < 0 || hint >= count ? 0 : hint;
  Top top{start, f(start)};
  bool higher = rise(count, 1, f, top);
  for (std::int32_t rounds = 0; rounds < count; ++rounds) {
    for (std::int32_t stride = higher ? count / 4 : 0; stride >= 1; stride /= 2) {
      for (std::int32_t moves = 0; moves < count && rise(count, stride, f, top); ++moves) {
      }
    }
    higher = leaveLevel(count, level, f, top);
    if (!higher) break;
  }
  return top.place;
}

}  // namespace

FeatureWalk::Slope FeatureWalk::steepest(int side, const Vector3& direction) {
  return vertex(side).apex >= 0 ? steepestOfMany(side, direction) : steepestOfAll(side, direction);
}

FeatureWalk::Slope FeatureWalk::steepestOfAll(int side, const Vector3& direction) const {
  const Data::Vertex& v = vertex(side);
  const Data::Spoke* const fan = body_[side]->fan.data() + v.fan_begin;
  const double x = direction.x();
  const double y = direction.y();
  const double z = direction.z();
  double best = -std::numeric_limits<double>::infinity();
  std::int32_t chosen = 0;
  for (std::int32_t i = 0; i < v.fan_count; ++i) {
    const Vector3& d = fan[i].direction;
    const double slope = (d.x() * x + d.y() * y) + d.z() * z;
    if (slope > best) {
      best = slope;
      chosen = i;
    }
  }
  return {best, v.fan_begin + chosen};
}

/// The spokes, cut by a plane across the cone, are the corners of a convex polygon, and the slope
/// over the length to that plane is linear on it: it rises to its largest value from both sides. If
/// that is negative, its product with the least length is a bound on all slopes; if the slope there
/// is no more than rounding, that of another spoke may be larger.
FeatureWalk::Slope FeatureWalk::steepestOfMany(int side, const Vector3& direction) {
  const Data& body = *body_[side];
  const Data::Vertex& v = vertex(side);
  const Data::Inner& cone = body.inner[at(v.apex)];
  const Data::Spoke* const fan = body.fan.data() + v.fan_begin;
  const auto value = [&](std::int32_t i) {
    return dot(fan[i].direction, direction) / dot(fan[i].direction, cone.point);
  };
  const double length = norm(direction);
  const std::int32_t top =
      topOfCycle(v.fan_count, hints_[at(side)], kLevelLoop * length / cone.least, value);
  hints_[at(side)] = top;
  const double slope = dot(fan[top].direction, direction);
  if (slope > std::max(kVoronoiSlack * length, rounding_)) return {slope, v.fan_begin + top};
  if (slope > 0.0) return steepestOfAll(side, direction);
  return {value(top) * cone.least, v.fan_begin + top};
}

/// The place in the ring of a side of the face that p lies outside of, or -1.
std::int32_t FeatureWalk::ringOutside(int side, const Data::Face& f, const Vector3& p) {
  return f.middle >= 0 ? ringOutsideOfMany(side, f, p) : ringOutsideOfAll(side, f, p);
}

std::int32_t FeatureWalk::ringOutsideOfAll(int side, const Data::Face& f, const Vector3& p) const {
  const Data::RingPlane* const ring = body_[side]->ring.data() + f.ring_begin;
  double least = -margin();
  std::int32_t chosen = -1;
  for (std::int32_t i = 0; i < f.ring_count; ++i) {
    const double inside = dot(ring[i].inward, p) - ring[i].offset;
    if (inside < least) {
      least = inside;
      chosen = f.ring_begin + i;
    }
  }
  return chosen;
}

/// Seen from the middle of the face, its sides are the corners of the dual polygon, and the share
/// of the way from the middle to a side that p has gone is linear on it. Where p is outside of the
/// side of the largest share by no more than the margin, it may be by more of another.
std::int32_t FeatureWalk::ringOutsideOfMany(int side, const Data::Face& f, const Vector3& p) {
  const Data& body = *body_[side];
  const Data::Inner& inner = body.inner[at(f.middle)];
  const Vector3 from_middle = p - inner.point;
  const Data::RingPlane* const ring = body.ring.data() + f.ring_begin;
  const auto share = [&](std::int32_t i) {
    return -dot(ring[i].inward, from_middle) / (dot(ring[i].inward, inner.point) - ring[i].offset);
  };
  const double level =
      (kLevelLoop * norm(from_middle) + kPointRounding * body.radius) / inner.least;
  const std::int32_t top = topOfCycle(f.ring_count, hints_[at(side)], level, share);
  hints_[at(side)] = top;
  const double inside = dot(ring[top].inward, p) - ring[top].offset;
  if (inside < -margin()) return f.ring_begin + top;
  return inside < 0.0 ? ringOutsideOfAll(side, f, p) : -1;
}

/// Vertex on side x, face on the other.
FeatureWalk::Outcome FeatureWalk::vertexFace(int x) {
  const int y = 1 - x;
  const Data::Face& f = face(y);
  const Vector3 v = toWorld(x, vertex(x).p);
  const Vector3 p = toBody(y, v);
  const std::int32_t outside = ringOutside(y, f, p);
  if (outside >= 0) {
    setFeature(y, FeatureKind::kEdge, body_[y]->ring_edge[at(outside)]);
    return Outcome::kMoved;
  }
  const double height = dot(f.normal, p) - f.offset;
  if (height <= kTouchingDistance * scale_) return leaveFace(x, p);
  const Vector3 u =
      times(*rotation_[y], Vector3(-f.normal));  // unit, from the vertex to the face, in W
  const Slope slope = steepest(x, transposeTimes(*rotation_[x], u));
  if (slope.value > kVoronoiSlack) {
    moveAlong(x, slope);
    return Outcome::kMoved;
  }
  setAnswer(x, v, v + height * u, u, height);
  excess_ = slope.value;
  return Outcome::kClosest;
}

/// A point p of side x, in the frame of y, lies below the face that it is over: either it is inside
/// the body of the face, or the face of the other side it lies outside of most is nearer.
FeatureWalk::Outcome FeatureWalk::leaveFace(int x, const Vector3& p) {
  const int y = 1 - x;
  double highest = kTouchingDistance * scale_;
  std::int32_t chosen = -1;
  const std::vector<Data::Face>& faces = body_[y]->faces;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const double height = dot(faces[i].normal, p) - faces[i].offset;
    if (height > highest) {
      highest = height;
      chosen = static_cast<std::int32_t>(i);
    }
  }
  if (chosen < 0) return Outcome::kOverlap;
  setFeature(y, FeatureKind::kFace, chosen);
  return Outcome::kMoved;
}

/// Cuts the edge from `start` to `end` (frame of y) to the prism over the face.
/// @returns false if nothing is left.
bool FeatureWalk::cutToPrism(int y, const Vector3& start, const Vector3& end, Cut& cut) const {
  const Data::Face& f = face(y);
  for (std::int32_t i = f.ring_begin; i < f.ring_begin + f.ring_count; ++i) {
    const Data::RingPlane& plane = body_[y]->ring[at(i)];
    const double a = dot(plane.inward, start) - plane.offset + margin();
    const double b = dot(plane.inward, end) - plane.offset + margin();
    if (a < 0.0 && b < 0.0) return false;
    if (a < 0.0 && a / (a - b) > cut.from) {
      cut.from = a / (a - b);
      cut.from_side = i;
    } else if (b < 0.0 && a / (a - b) < cut.to) {
      cut.to = a / (a - b);
      cut.to_side = i;
    }
  }
  return cut.from <= cut.to;
}

/// Edge on side x, face on the other: the lower end of what is over the face says where to go.
FeatureWalk::Outcome FeatureWalk::edgeFace(int x) {
  const int y = 1 - x;
  const Data::Face& f = face(y);
  const Data::Edge& e = edge(x);
  const Vector3 start = toBody(y, toWorld(x, body_[x]->vertices[at(e.vertex[0])].p));
  const Vector3 end = toBody(y, toWorld(x, body_[x]->vertices[at(e.vertex[1])].p));
  Cut cut;
  if (!cutToPrism(y, start, end, cut)) return nearestSide(x, start, end);
  const double height_start = dot(f.normal, start) - f.offset;
  const double rise = dot(f.normal, Vector3(end - start));
  const double height_from = height_start + cut.from * rise;
  const double height_to = height_start + cut.to * rise;
  if (std::min(height_from, height_to) <= kTouchingDistance * scale_) {
    if (std::max(height_from, height_to) >= 0.0) return Outcome::kOverlap;
    return leaveFace(x, start + (0.5 * (cut.from + cut.to)) * (end - start));
  }
  const bool lower_from = height_from < height_to;
  const std::int32_t side = lower_from ? cut.from_side : cut.to_side;
  if (side >= 0) {
    setFeature(y, FeatureKind::kEdge, body_[y]->ring_edge[at(side)]);
  } else {
    setFeature(x, FeatureKind::kVertex, e.vertex[lower_from ? 0 : 1]);
  }
  return Outcome::kMoved;
}

/// The edge from p to q passes beside the prism over the face: the closest side of the face.
FeatureWalk::Outcome FeatureWalk::nearestSide(int x, const Vector3& p, const Vector3& q) {
  const int y = 1 - x;
  const Data::Face& f = face(y);
  const Vector3 along = q - p;
  const double square = dot(along, along);
  double best = std::numeric_limits<double>::infinity();
  std::int32_t chosen = f.ring_begin;
  for (std::int32_t i = f.ring_begin; i < f.ring_begin + f.ring_count; ++i) {
    const Data::Edge& e = body_[y]->edges[at(body_[y]->ring_edge[at(i)])];
    const Vector3 w = e.p - p;
    const Vector3 n = cross(along, e.direction);
    const double nn = dot(n, n);
    double s = nn > kParallelEdges * square ? dot(cross(w, e.direction), n) / nn : 0.0;
    s = std::min(std::max(s, 0.0), 1.0);
    double t = dot(Vector3(s * along - w), e.direction);
    if (t < 0.0 || t > e.length) {
      t = std::min(std::max(t, 0.0), e.length);
      s = dot(Vector3(w + t * e.direction), along) / square;
      s = std::min(std::max(s, 0.0), 1.0);
    }
    const Vector3 u = w + t * e.direction - s * along;
    const double distance = dot(u, u);
    if (distance < best) {
      best = distance;
      chosen = i;
    }
  }
  setFeature(y, FeatureKind::kEdge, body_[y]->ring_edge[at(chosen)]);
  return Outcome::kMoved;
}

}  // namespace hovercraft
