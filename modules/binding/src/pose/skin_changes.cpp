#include "pose/skin_changes.hpp"

#include <algorithm>
#include <cmath>

#include "pose/lanes.hpp"
#include "pose/vector_clones.hpp"

namespace bodice::inline v0_1::binding {
namespace {

/// An ellipsoid in units of its longest radius, in its own axes.
struct UnitEllipsoid {
  float radius[3], squared[3], inverse[3];
  float least_squared = 0.0f;
  float to_table[9];           ///< by rows
  float longest_m = 0.0f;      ///< what the unit is
  float height_unit_m = 0.0f;  ///< unit of a bundle's heights after carrying
};

UnitEllipsoid unit_ellipsoid(const CarriedEllipsoid& carried, double step_m) {
  UnitEllipsoid unit;
  const double longest = carried.shape.radii.maxCoeff();
  for (int i = 0; i < 3; ++i) {
    const double r = carried.shape.radii[i] / longest;
    unit.radius[i] = static_cast<float>(r);
    unit.squared[i] = static_cast<float>(r * r);
    unit.inverse[i] = static_cast<float>(1.0 / r);
    for (int j = 0; j < 3; ++j) unit.to_table[3 * i + j] = static_cast<float>(carried.to_table(i, j));
  }
  unit.least_squared = std::min({unit.squared[0], unit.squared[1], unit.squared[2]});
  unit.longest_m = static_cast<float>(longest);
  unit.height_unit_m = static_cast<float>(step_m * carried.scale);
  return unit;
}

/// Linear blend skinning of a bundle into the ellipsoid's frame.
BODICE_CLONES
void skin_bundle(const proxy::SkinBundle& bundle, const proxy::SkinEntry* entry, std::size_t entries,
                 const float* maps, Lanes (&at)[3]) {
  Vector blend[12] = {};
  for (std::size_t i = 0; i < entries; ++i) {
    const float* const map = maps + 12 * entry[i].term;
    Vector weight;
    load(entry[i].weight.data(), weight);
    weight *= 1.0f / 65535.0f;
    for (int c = 0; c < 12; ++c) blend[c] += map[c] * weight;
  }
  Vector p[3];
  for (int axis = 0; axis < 3; ++axis) load(bundle.position[axis].data(), p[axis]);
  for (int row = 0; row < 3; ++row) {
    const Vector* const b = blend + 4 * row;
    store(b[0] * p[0] + b[1] * p[1] + b[2] * p[2] + b[3], at[row]);
  }
}

/// Unit directions of the closest points, and distances to them: the root t of |w(t)| = 1,
/// w_j = r_j y_j / (t + r_j^2), by three steps from below. The axes are written out, since loops over them
/// inside of the loop over lanes keep the latter from becoming vector code.
BODICE_CLONES
void find_closest_points(const UnitEllipsoid& e, const Lanes (&y)[3], Lanes (&w)[3], Lanes& distance) {
  constexpr int kSteps = 3;
  constexpr float kInside = -0.9999f, kTiny = 1e-12f;
  const float r0 = e.radius[0], r1 = e.radius[1], r2 = e.radius[2];
  const float s0 = e.squared[0], s1 = e.squared[1], s2 = e.squared[2];
  Lanes t, ry[3];
  for (int l = 0; l < kLanes; ++l) {
    const float a = r0 * std::abs(y[0][l]), b = r1 * std::abs(y[1][l]), c = r2 * std::abs(y[2][l]);
    const float start = greater(greater(a - s0, b - s1), greater(c - s2, kInside * e.least_squared));
    t[l] = greater(start, std::sqrt(a * a + b * b + c * c) - 1.0f);
    ry[0][l] = r0 * y[0][l];
    ry[1][l] = r1 * y[1][l];
    ry[2][l] = r2 * y[2][l];
  }
  for (int step = 0; step < kSteps; ++step)
    for (int l = 0; l < kLanes; ++l) {
      // One division gives the reciprocals of all three.
      const float a = t[l] + s0, b = t[l] + s1, c = t[l] + s2, ab = a * b, inverse = 1.0f / (ab * c);
      const float i0 = b * c * inverse, i1 = a * c * inverse, i2 = ab * inverse;
      const float w0 = ry[0][l] * i0, w1 = ry[1][l] * i1, w2 = ry[2][l] * i2;
      const float q0 = w0 * w0, q1 = w1 * w1, q2 = w2 * w2;
      const float length2 = q0 + q1 + q2, slope = q0 * i0 + q1 * i1 + q2 * i2;
      t[l] += (std::sqrt(length2) - 1.0f) * length2 / greater(slope, kTiny);
    }
  const float i0 = e.inverse[0], i1 = e.inverse[1], i2 = e.inverse[2];
  for (int l = 0; l < kLanes; ++l) {
    const float a = t[l] + s0, b = t[l] + s1, c = t[l] + s2, unit = 1.0f / (a * b * c);
    const float x0 = ry[0][l] * (b * c * unit), x1 = ry[1][l] * (a * c * unit),
                x2 = ry[2][l] * (a * b * unit);
    const float scale = 1.0f / std::sqrt(greater(x0 * x0 + x1 * x1 + x2 * x2, kTiny));
    const float w0 = x0 * scale, w1 = x1 * scale, w2 = x2 * scale;
    const float n0 = w0 * i0, n1 = w1 * i1, n2 = w2 * i2;
    const float normal2 = n0 * n0 + n1 * n1 + n2 * n2;
    const float along = n0 * (y[0][l] - r0 * w0) + n1 * (y[1][l] - r1 * w1) + n2 * (y[2][l] - r2 * w2);
    distance[l] = along / std::sqrt(greater(normal2, kTiny));
    w[0][l] = w0;
    w[1][l] = w1;
    w[2][l] = w2;
  }
}

/// Changes against the closest points and heights at rest, by component.
BODICE_CLONES
void compare(const UnitEllipsoid& e, const proxy::SkinBundle& bundle, const Lanes (&w)[3],
             const Lanes& distance, Lanes (&change)[4]) {
  Lanes rest[3], height;
  for (int l = 0; l < kLanes; ++l) {
    const float x = static_cast<float>(bundle.direction[0][l]) * (1.0f / 32767.0f);
    const float y = static_cast<float>(bundle.direction[1][l]) * (1.0f / 32767.0f);
    const float z = 1.0f - std::abs(x) - std::abs(y);
    const float fold = greater(-z, 0.0f);
    const float px = x - std::copysign(fold, x), py = y - std::copysign(fold, y);
    const float scale = 1.0f / std::sqrt(px * px + py * py + z * z);
    rest[0][l] = px * scale;
    rest[1][l] = py * scale;
    rest[2][l] = z * scale;
    height[l] = static_cast<float>(bundle.height[l]);
  }
  Vector to[3], from, length;
  for (int i = 0; i < 3; ++i) load(w[i], to[i]);
  for (int i = 0; i < 3; ++i) {
    const float* const row = e.to_table + 3 * i;
    load(rest[i], from);
    store(row[0] * to[0] + row[1] * to[1] + row[2] * to[2] - from, change[i]);
  }
  load(distance, length);
  load(height, from);
  store(length * e.longest_m - from * e.height_unit_m, change[3]);
}

}  // namespace

void posed_maps(const geometry::Vec3& rest_center, double step_m, std::span<const proxy::CarryTerm> terms,
                std::span<const proxy::JointMatrix> skinning, const CarriedEllipsoid& carried,
                std::span<float> maps) {
  const double longest = carried.shape.radii.maxCoeff();
  const geometry::Mat3 to_frame = carried.shape.axes.transpose() / longest;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const proxy::JointMatrix& t = skinning[terms[i].joint];
    const geometry::Mat3 linear = to_frame * t.leftCols<3>();
    const geometry::Vec3 shift = linear * rest_center + to_frame * (t.col(3) - carried.shape.center);
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column)
        maps[12 * i + static_cast<std::size_t>(4 * row + column)] =
            static_cast<float>(linear(row, column) * step_m);
      maps[12 * i + static_cast<std::size_t>(4 * row + 3)] = static_cast<float>(shift[row]);
    }
  }
}

void find_changes(const proxy::Binding& binding, std::size_t ellipsoid, const CarriedEllipsoid& carried,
                  const float* maps, Change* changes) {
  const UnitEllipsoid unit = unit_ellipsoid(carried, double{binding.step_m[ellipsoid]});
  const std::size_t last = binding.first_bundle[ellipsoid + 1];
  for (std::size_t i = binding.first_bundle[ellipsoid]; i < last; ++i) {
    const proxy::SkinBundle& bundle = binding.bundles[i];
    Lanes at[3], w[3], distance, change[4];
    skin_bundle(bundle, binding.entries.data() + binding.first_entry[i],
                binding.first_entry[i + 1] - binding.first_entry[i], maps, at);
    find_closest_points(unit, at, w, distance);
    compare(unit, bundle, w, distance, change);
    for (int l = 0; l < kLanes; ++l)
      changes[bundle.texel[l]] = Change{change[0][l], change[1][l], change[2][l], change[3][l]};
  }
}

}  // namespace bodice::binding
