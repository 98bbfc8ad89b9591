#include "import/body/body_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <bodice/engine/message.hpp>

namespace bodice::inline v0_1::io {

namespace {

using geometry::Axis;
using geometry::Vec3;

// The unit is found by the skin's area, since it does not change with the pose. Adults have 1.3 to 2.6 m2, a
// one-year-old .45 m2 (Mosteller: sqrt(height_cm mass_kg / 3600) m2); sculpted hands, ears and mouths add
// some. Between meter, decimeter, centimeter and millimeter the area changes by a factor of 100 each.
constexpr double kSmallestSkin_m2 = 0.42, kLargestSkin_m2 = 4.0;
constexpr double kSmallestAdult_m2 = 1.15, kLargestAdult_m2 = 2.7;
constexpr double kTypicalSkin_m2 = 1.75;
// The range for units that the file or the user gives is wider, since the file may hold a stylized figure.
constexpr double kSmallestLength_m = 0.45, kLargestLength_m = 2.8, kLargestStylizedSkin_m2 = 15.0;
/// The factor by which an axis must exceed y to be chosen as up instead.
constexpr double kClearlyLonger = 1.25;
/// Thickness over length above which a body sits or crouches. It is .18 to .35 in standing bodies, .6 in
/// sitting ones.
constexpr double kSitting = 0.5;
/// The height of the sole of a body that rests on the ground, as a fraction of its length.
constexpr double kSoleHeight = 0.01;
/// The factor by which a sitting body's area at the ground exceeds that at its other sides.
constexpr double kClearSole = 3.0;
/// The least share of occupied cells with an occupied mirror image in a symmetric body.
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
    if (skin_m2 >= kSmallestSkin_m2 && skin_m2 <= kLargestSkin_m2) return unit.meters;
  }
  constexpr double inch = 0.0254;  // an adult in inches would be an infant in centimeters
  const double skin_m2 = area * inch * inch;
  if (skin_m2 >= kSmallestAdult_m2 && skin_m2 <= kLargestAdult_m2) return inch;
  return std::nullopt;
}

void detect_unit(const geometry::TriMesh& body, const ImportOptions& options, std::optional<double> stated,
                 DetectedFrame& out) {
  const double length = geometry::bounding_box(body.positions).size().maxCoeff();
  for (const NamedUnit& unit : kUnits) {
    if (unit.unit != options.unit) continue;
    out.frame.meters_per_unit = unit.meters;
    out.unit = unit.name;
    if (unit.meters * length < kSmallestLength_m || unit.meters * length > kLargestLength_m)
      out.warnings.push_back({"unit-unlikely", "",
                              engine::message("In ", out.unit, ", the given unit, the body is ",
                                              unit.meters * length, " m long, which is no person's size."),
                              "Leave the unit out (program: --unit) to have it found."});
    return;
  }
  const double area = surface_area(body);
  const bool believable = stated && *stated * length >= kSmallestLength_m &&
                          *stated * length <= kLargestLength_m &&
                          *stated * *stated * area <= kLargestStylizedSkin_m2;
  if (const auto meters = believable ? stated : meters_from_area(area)) {
    out.frame.meters_per_unit = *meters;
    out.unit = unit_name(*meters);
    if (stated && !believable)
      out.warnings.push_back(
          {"unit-contradicted", "",
           engine::message("The file gives its unit as ", *stated, " m, which makes the body ",
                           *stated * length, " m long; '", out.unit, "' fits its skin and was taken."),
           "If that is wrong, give the unit (program: --unit) or scale the body to meters."});
    return;
  }
  out.frame.meters_per_unit = area > 0.0 ? std::sqrt(kTypicalSkin_m2 / area) : 1.0;
  out.unit = "unknown";
  out.warnings.push_back({"unit-unknown", "",
                          engine::message("No common unit makes the body, ", length,
                                          " units long, a person's size; it was scaled to ",
                                          out.frame.meters_per_unit * length, " m."),
                          "Give the unit (program: --unit), or scale the body to meters."});
}

/// A body as a coarse grid of occupied cells, which is compared with its mirror images.
class Occupancy {
 public:
  explicit Occupancy(const geometry::TriMesh& body, const geometry::Box& box)
      : box_(box), cells_(kSide * kSide * kSide) {
    for (const geometry::Triangle& t : body.triangles)
      for (const geometry::Index v : t) cells_[index(body.positions[v])] = true;
  }

  /// The share of occupied cells with an occupied mirror image across the box's middle.
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

/// The up axis of a body that is as thick as it is long: the axis with the largest flat area at its low end
/// if that is clear, else y.
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
  detected.up_found_by_extents = !options.up && !up;
  return detected;
}

DetectedFrame frame_of_thing(const geometry::TriMesh& thing, const ImportOptions& options,
                             std::optional<double> meters_per_unit, std::optional<Axis> up) {
  DetectedFrame detected;
  if (options.frame) {
    detected.frame = *options.frame;
    detected.unit = unit_name(detected.frame.meters_per_unit);
    return detected;
  }
  detected.frame.up = options.up ? *options.up : up.value_or(Axis::kY);
  detected.frame.meters_per_unit = meters_per_unit.value_or(1.0);
  for (const NamedUnit& unit : kUnits)
    if (unit.unit == options.unit) detected.frame.meters_per_unit = unit.meters;
  detected.unit = unit_name(detected.frame.meters_per_unit);
  if (options.unit == Unit::kAuto && !meters_per_unit) {
    const double longest_m = geometry::bounding_box(thing.positions).size().maxCoeff();
    detected.warnings.push_back(
        {"unit-assumed", "",
         engine::message("The file states no unit; it was read in meters, in which it "
                         "is ",
                         longest_m, " m long."),
         "If that is wrong, give the unit (program: --unit)."});
  }
  return detected;
}

}  // namespace bodice::io
