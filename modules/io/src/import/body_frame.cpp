#include "body_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <bodice/engine/message.hpp>

namespace bodice::io {

namespace {

using geometry::Axis;
using geometry::Vec3;

// The skin's area does not change with the pose, so it is what tells the unit. Adults have 1.3 to 2.6 m2,
// a one-year-old .45 m2 (Mosteller: sqrt(height_cm mass_kg / 3600) m2); sculpted hands, ears and mouths add
// some. The decades of meter, decimeter, centimeter and millimeter lie a factor of 100 apart in area.
constexpr double kSmallestSkinM2 = 0.42, kLargestSkinM2 = 4.0;
constexpr double kSmallestAdultM2 = 1.15, kLargestAdultM2 = 2.7;
constexpr double kTypicalSkinM2 = 1.75;
// A file's own word on its unit, or the user's, is believed over a wider range: it may hold a stylised
// figure.
constexpr double kSmallestLengthM = 0.45, kLargestLengthM = 2.8, kLargestStylisedSkinM2 = 15.0;
/// An axis must be this much longer than y to be taken as up in its stead.
constexpr double kClearlyLonger = 1.25;
/// Thickness to length: standing bodies have .18 to .35, sitting and crouching ones .6.
constexpr double kSitting = 0.5;
/// The bottom of a body that rests on the ground: this far up, as a fraction of its length.
constexpr double kSoleHeight = 0.01;
/// A sitting body's ground shows as an area so many times that of any other side.
constexpr double kClearSole = 3.0;
/// Fraction of occupied cells whose mirror image is occupied too, for a symmetric body.
constexpr double kSymmetric = 0.8;

struct NamedUnit {
  Unit unit;
  const char* name;
  double meters;
};
constexpr std::array<NamedUnit, 6> kUnits = {{{Unit::kMeter, "m", 1.0},
                                              {Unit::kDecimeter, "dm", 0.1},
                                              {Unit::kCentimeter, "cm", 0.01},
                                              {Unit::kMillimeter, "mm", 0.001},
                                              {Unit::kInch, "inch", 0.0254},
                                              {Unit::kFoot, "ft", 0.3048}}};

std::optional<double> meters_from_area(double area) {
  for (const NamedUnit& unit : kUnits) {
    if (unit.unit == Unit::kInch || unit.unit == Unit::kFoot) continue;
    const double skin_m2 = area * unit.meters * unit.meters;
    if (skin_m2 >= kSmallestSkinM2 && skin_m2 <= kLargestSkinM2) return unit.meters;
  }
  constexpr double inch = 0.0254;  // an adult in inches would be an infant in centimeters
  const double skin_m2 = area * inch * inch;
  if (skin_m2 >= kSmallestAdultM2 && skin_m2 <= kLargestAdultM2) return inch;
  return std::nullopt;
}

void detect_unit(const geometry::TriMesh& body, const ImportOptions& options, std::optional<double> file_says,
                 DetectedFrame& out) {
  const double length = geometry::bounding_box(body.positions).size().maxCoeff();
  for (const NamedUnit& unit : kUnits) {
    if (unit.unit != options.unit) continue;
    out.frame.meters_per_unit = unit.meters;
    out.unit = unit.name;
    if (unit.meters * length < kSmallestLengthM || unit.meters * length > kLargestLengthM)
      out.warnings.push_back({"unit-unlikely", "",
                              engine::message("In ", out.unit, ", as was told, the body is ",
                                              unit.meters * length, " m long, which is no person's size."),
                              "Leave --unit out to have it found."});
    return;
  }
  const double area = surface_area(body);
  const bool believable = file_says && *file_says * length >= kSmallestLengthM &&
                          *file_says * length <= kLargestLengthM &&
                          *file_says * *file_says * area <= kLargestStylisedSkinM2;
  if (const auto meters = believable ? file_says : meters_from_area(area)) {
    out.frame.meters_per_unit = *meters;
    out.unit = unit_name(*meters);
    if (file_says && !believable)
      out.warnings.push_back(
          {"unit-contradicted", "",
           engine::message("The file says that a unit is ", *file_says, " m, which makes the body ",
                           *file_says * length, " m long; '", out.unit, "' fits its skin and was taken."),
           "Give --unit if that is wrong."});
    return;
  }
  out.frame.meters_per_unit = area > 0.0 ? std::sqrt(kTypicalSkinM2 / area) : 1.0;
  out.unit = "unknown";
  out.warnings.push_back({"unit-unknown", "",
                          engine::message("No common unit makes the body, ", length,
                                          " units long, a person's size; it was scaled to ",
                                          out.frame.meters_per_unit * length, " m."),
                          "Give --unit to set it."});
}

/// A body as a coarse grid of occupied cells, to compare it with its mirror images.
class Occupancy {
 public:
  explicit Occupancy(const geometry::TriMesh& body, const geometry::Box& box)
      : box_(box), cells_(kSide * kSide * kSide) {
    for (const geometry::Triangle& t : body.triangles)
      for (const geometry::Index v : t) cells_[index(body.positions[v])] = true;
  }

  /// Of the occupied cells, the fraction whose mirror image across the box's middle is occupied.
  double symmetry(int axis) const {
    std::size_t occupied = 0, mirrored = 0;
    std::array<std::size_t, 3> c;
    for (c[0] = 0; c[0] < kSide; ++c[0])
      for (c[1] = 0; c[1] < kSide; ++c[1])
        for (c[2] = 0; c[2] < kSide; ++c[2]) {
          if (!at(c)) continue;
          ++occupied;
          std::array<std::size_t, 3> m = c;
          m[static_cast<std::size_t>(axis)] = kSide - 1 - c[static_cast<std::size_t>(axis)];
          mirrored += at(m);
        }
    return occupied ? static_cast<double>(mirrored) / static_cast<double>(occupied) : 0.0;
  }

 private:
  static constexpr std::size_t kSide = 24;

  bool at(const std::array<std::size_t, 3>& c) const { return cells_[(c[0] * kSide + c[1]) * kSide + c[2]]; }

  std::size_t index(const Vec3& p) const {
    const double cell = std::max(box_.size().maxCoeff(), 1e-300) / static_cast<double>(kSide);
    std::size_t result = 0;
    for (int k = 0; k < 3; ++k) {
      const double along = (p[k] - box_.center()[k]) / cell + 0.5 * static_cast<double>(kSide);
      const double clamped = std::clamp(along, 0.0, static_cast<double>(kSide) - 1.0);
      result = result * kSide + static_cast<std::size_t>(clamped);
    }
    return result;
  }

  geometry::Box box_;
  std::vector<bool> cells_;
};

/// For a body as thick as it is long: the axis on whose ground it lies flattest, y unless another is clear.
Axis ground_axis(const geometry::TriMesh& body, const geometry::Box& box) {
  const Vec3 limit = box.low.array() + kSoleHeight * box.size().maxCoeff();
  Vec3 sole = Vec3::Zero();
  for (std::size_t t = 0; t < body.triangles.size(); ++t) {
    const Vec3 center = (body.corner(t, 0) + body.corner(t, 1) + body.corner(t, 2)) / 3.0;
    const Vec3 down = -area_vector(body, t);
    for (int axis = 0; axis < 3; ++axis)
      if (center[axis] < limit[axis]) sole[axis] += std::max(0.0, down[axis]);
  }
  int ground = 1;
  for (int axis = 0; axis < 3; ++axis)
    if (sole[axis] > kClearSole * std::max(sole[(axis + 1) % 3], sole[(axis + 2) % 3])) ground = axis;
  return static_cast<Axis>(ground);
}

}  // namespace

std::string unit_name(double meters) {
  for (const NamedUnit& unit : kUnits)
    if (std::abs(unit.meters / meters - 1.0) < 1e-3) return unit.name;
  return "unknown";
}

Axis up_axis_of(const geometry::TriMesh& body) {
  geometry::Box box;
  for (const geometry::Triangle& t : body.triangles)
    for (const geometry::Index v : t) box.extend(body.positions[v]);
  if (box.size().minCoeff() > kSitting * box.size().maxCoeff()) return ground_axis(body, box);

  const Vec3 size = box.size();
  const Occupancy occupancy(body, box);
  int mirror = -1;
  double best = kSymmetric;
  for (int axis = 0; axis < 3; ++axis)
    if (const double symmetry = occupancy.symmetry(axis); symmetry > best) best = symmetry, mirror = axis;
  int up = mirror == 1 ? 2 : 1;
  for (int axis = 0; axis < 3; ++axis)
    if (axis != mirror && size[axis] > kClearlyLonger * size[up]) up = axis;
  return static_cast<Axis>(up);
}

DetectedFrame detect_frame(const geometry::TriMesh& body, const ImportOptions& options,
                           std::optional<double> meters_per_unit, std::optional<Axis> up) {
  DetectedFrame detected;
  detect_unit(body, options, meters_per_unit, detected);
  const Axis by_shape = up_axis_of(body);
  detected.frame.up = options.up ? *options.up : up ? *up : by_shape;
  return detected;
}

}  // namespace bodice::io
