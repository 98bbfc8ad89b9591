#include <bodice/tryon/place_garment.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <bodice/engine/message.hpp>
#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Mat3;
using geometry::Vec3;

constexpr std::size_t kFittedPoints = 300;
constexpr std::size_t kFittedGrain = 32;
// A sample counts as on the body up to this depth in the skin and up to this gap, in statures. A garment that
// starts inside the body is as deep, and a skirt's hem is as far off.
constexpr double kMostDepth = 0.015, kMostGap = 0.15;
// Shares of samples on the body: kWornShare leaves a garment where it is, kFoundShare accepts another unit or
// position, and kSecondShare of a second candidate makes the first ambiguous.
constexpr double kWornShare = 0.5, kFoundShare = 0.9, kSecondShare = 0.75;
// A garment counts as beside the body in two cases. More than kDeepShare of its samples are deep inside it.
// Or the vectors from the skin to its samples add up to more than kOneSidedShare of their lengths, which
// exceed kOffBody on average, in statures. Garments that fit have a deep share of 0 and a one-sided share of
// at most 0.25; moved by 6 cm they have at least 0.12 and 0.6.
constexpr double kDeepShare = 0.08, kOneSidedShare = 0.35, kOffBody = 0.02;
// The range of a garment's diagonal, in statures, from a wristband to a dress with a train. In another unit,
// a garment must be at least as large as a sock.
constexpr double kLeastSize = 0.03, kLeastSizeInUnit = 0.1, kMostSize = 4.0;
// A garment of plausible size within this distance of the body, in statures, may be meant to fall on it.
constexpr double kMayFall = 0.25;
constexpr double kLongestShift = 0.34;
constexpr int kShiftSteps = 20;
// A garment with samples of a smaller median distance from the skin, in statures, keeps its unit.
constexpr double kClose = 0.02;
constexpr double kMostOff = 0.02;  // the largest gap of a shifted garment to the skin, in statures

struct Unit {
  const char* name;
  double meters;
};
constexpr std::array kUnits = {Unit{"millimeters", 1e-3}, Unit{"centimeters", 1e-2}, Unit{"inches", 0.0254},
                               Unit{"decimeters", 0.1},   Unit{"feet", 0.3048},      Unit{"meters", 1.0}};

/// A rotation that a file may need, and its name.
struct Turn {
  const char* name;
  Mat3 matrix;
};

std::vector<Turn> turns() {
  const Mat3 z_up = (Mat3() << 1, 0, 0, 0, 0, 1, 0, -1, 0).finished();
  const Mat3 y_up = z_up.transpose();
  return {{"", Mat3::Identity()}, {"z up", z_up}, {"y up", y_up}};
}

/// One position of the garment: scale times turn, plus shift.
struct Candidate {
  double scale = 1.0;
  Mat3 turn = Mat3::Identity();
  Vec3 shift = Vec3::Zero();
  double on_body = 0.0;  // share of the samples
  std::string name;

  Vec3 operator()(const Vec3& p) const { return scale * (turn * p) + shift; }
};

class PlacementTest {
 public:
  PlacementTest(const engine::Context& context, const PlacedOn& body, const geometry::TriMesh& garment)
      : context_(context), body_(body) {
    const std::vector<Vec3>& all = garment.positions;
    const std::size_t step = std::max<std::size_t>(1, all.size() / kFittedPoints);
    for (std::size_t v = 0; v < all.size(); v += step)
      if (all[v].allFinite()) samples_.push_back(all[v]);
    for (const Vec3& p : all)
      if (p.allFinite()) box_.extend(p);
  }

  bool empty() const { return samples_.empty(); }
  double size_m() const { return box_.size().norm(); }
  double in_statures(double length_m) const { return length_m / body_.stature_m; }
  bool has_size(double scale, double least) const {
    const double size = in_statures(scale * size_m());
    return size > least && size < kMostSize;
  }

  /// The share of the samples that lie on the body.
  double on_body(const Candidate& c) const {
    std::size_t count = 0;
    for (const double d : distances(c))
      count += d > -kMostDepth * body_.stature_m && d < kMostGap * body_.stature_m;
    return static_cast<double>(count) / static_cast<double>(samples_.size());
  }
  /// Whether the garment lies beside the body: it cuts deep into it, or is off it on one side.
  bool is_beside(const Candidate& c) const {
    Vec3 sum = Vec3::Zero();
    double length = 0.0, deep = 0.0;
    const auto count = static_cast<double>(samples_.size());
    for (const Vec3& sample : samples_) {
      const Vec3 p = c(sample);
      const geometry::SurfacePoint at = body_.skin.closest_point(p);
      deep += at.signed_distance < -kMostDepth * body_.stature_m ? 1.0 : 0.0;
      sum += p - at.point, length += (p - at.point).norm();
    }
    return deep > kDeepShare * count ||
           (sum.norm() > kOneSidedShare * length && length > kOffBody * body_.stature_m * count);
  }
  double nearest_m(const Candidate& c) const { return std::ranges::min(distances(c)); }
  /// The median distance of the samples from the skin, in statures.
  double median_off(const Candidate& c) const {
    std::vector<double> off = distances(c);
    for (double& d : off) d = std::abs(d);
    return in_statures(median(std::move(off)));
  }
  /// The factor from the unit that the garment was read in to one of `unit_m` meters.
  double scale_of(double unit_m) const { return unit_m / body_.meters_per_unit; }

  /// Shifts the candidate along the axes for which `free` is 1, until its samples lie evenly off the skin.
  /// Each step is the mean of the samples' own shifts.
  void shift(Candidate& c, const Vec3& free) const {
    for (int step = 0; step < kShiftSteps; ++step) {
      std::vector<Vec3> by(samples_.size(), Vec3::Zero());
      const double off_m = std::clamp(median(distances(c)), 0.0, kMostOff * body_.stature_m);
      engine::parallel_for(context_, by.size(), kFittedGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const Vec3 p = c(samples_[i]);
          const geometry::SurfacePoint at = body_.skin.closest_point(p);
          const Vec3 out = at.signed_distance < 0.0 ? Vec3(at.point - p) : Vec3(p - at.point);
          if (out.norm() > 0.0) by[i] = at.point + off_m * out.normalized() - p;
        }
      });
      Vec3 mean = Vec3::Zero();
      for (const Vec3& b : by) mean += b / static_cast<double>(by.size());
      c.shift += 1.5 * mean.cwiseProduct(
                           free);  // closest points slide along the skin, so that the mean alone falls short
    }
  }

 private:
  std::vector<double> distances(const Candidate& c) const {
    std::vector<double> d(samples_.size());
    engine::parallel_for(context_, d.size(), kFittedGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) d[i] = body_.skin.signed_distance(c(samples_[i]));
    });
    return d;
  }
  static double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
  }

  const engine::Context& context_;
  const PlacedOn& body_;
  std::vector<Vec3> samples_;
  geometry::Box box_;
};

bool is_same(double a, double b) {
  return std::abs(a - b) < 1e-9 * b;
}

/// All units and axes in which the garment has a garment's size, the most likely first.
std::vector<Candidate> candidates(const PlacementTest& test) {
  std::vector<Candidate> all;
  for (const Unit& from : kUnits)
    for (const Turn& turn : turns()) {
      Candidate c{.scale = test.scale_of(from.meters), .turn = turn.matrix};
      c.name = is_same(c.scale, 1.0) ? "" : std::string("in ") + from.name;
      if (*turn.name) c.name += (c.name.empty() ? "" : ", ") + std::string(turn.name);
      if (!test.has_size(c.scale, kLeastSizeInUnit)) continue;
      c.on_body = test.is_beside(c) ? 0.0 : test.on_body(c);
      all.push_back(std::move(c));
    }
  // A smaller unit shrinks a garment toward the origin, where it may surround the feet. So the largest of the
  // candidates that are on the body comes first.
  const auto rank = [](const Candidate& c) {
    return std::pair(c.on_body >= kFoundShare ? c.scale : 0.0, c.on_body);
  };
  std::ranges::stable_sort(all, std::greater<>(), rank);
  return all;
}

/// The garment in its own unit and axes, moved onto the body. Heights are mostly right, and a skirt, which is
/// a cone, would slide up, so that shifts along the floor come first.
std::optional<Candidate> moved_onto_body(const PlacementTest& test) {
  if (!test.has_size(1.0, kLeastSize)) return std::nullopt;
  for (const Vec3& free : {Vec3(1.0, 0.0, 1.0), Vec3(1.0, 1.0, 1.0)}) {
    Candidate moved;
    test.shift(moved, free);
    moved.on_body = test.on_body(moved);
    if (moved.on_body >= kFoundShare && !test.is_beside(moved) &&
        test.in_statures(moved.shift.norm()) < kLongestShift)
      return moved;
  }
  return std::nullopt;
}

engine::Error not_placed(const PlacementTest& test, const std::string& name, double stature_m,
                         double nearest_m, bool ambiguous) {
  return {engine::ErrorCode::kUnusableGeometry,
          engine::message("The garment '", name, "' is ", test.size_m(), " m from corner to corner and ",
                          std::max(0.0, nearest_m), " m from a body of ", stature_m, " m, and ",
                          ambiguous ? "more than one unit or axis would put it on the body."
                                    : "no unit, axes or shift put it on the body."),
          "Give it in the body's unit and axes, where the body wears it."};
}

engine::Warning placed_by(const Candidate& taken, const std::string& name) {
  std::string how = taken.name.empty() ? std::string("beside the body") : taken.name;
  if (!taken.shift.isZero())
    how += engine::message(", and was moved by ", std::lround(1e3 * taken.shift.x()), ", ",
                           std::lround(1e3 * taken.shift.y()), ", ", std::lround(1e3 * taken.shift.z()),
                           " mm (left, up, front)");
  return {"garment-placed", name, "The garment is " + how + "; it was put on where it fits the body.",
          "Check the picture; --position as-is leaves it where its file has it."};
}

}  // namespace

engine::Result<std::optional<engine::Warning>> place_garment(const engine::Context& context,
                                                             const PlacedOn& body, const std::string& name,
                                                             geometry::TriMesh& garment) {
  const std::optional<engine::Warning> nothing;
  const PlacementTest test(context, body, garment);
  if (test.empty()) return nothing;
  const Candidate as_is;
  const double nearest_m = test.nearest_m(as_is);
  const bool is_near = test.has_size(1.0, kLeastSize) && test.on_body(as_is) >= kWornShare;
  const bool is_worn = is_near && !test.is_beside(as_is);
  if (is_worn && test.median_off(as_is) < kClose) return nothing;

  std::vector<Candidate> all;
  if (is_worn || !is_near) all = candidates(test);
  const bool found = !all.empty() && all.front().on_body >= kFoundShare;
  // A garment that was read in too small a unit stands between the calves, so that only a larger candidate
  // replaces one that is worn.
  if (is_worn && !(found && all.front().scale > 1.0)) return nothing;
  const bool clear =
      found && (all.size() < 2 || all[1].on_body < kSecondShare || all[1].scale < all[0].scale);
  std::optional<Candidate> taken;
  if (clear) taken = all.front();
  if (!found) taken = moved_onto_body(test);
  if (!taken) {
    if (test.has_size(1.0, kLeastSize) && test.in_statures(nearest_m) < kMayFall) return nothing;
    return not_placed(test, name, body.stature_m, nearest_m, found);
  }
  for (Vec3& p : garment.positions)
    if (p.allFinite()) p = (*taken)(p);
  return std::optional(placed_by(*taken, name));
}

}  // namespace bodice::tryon
