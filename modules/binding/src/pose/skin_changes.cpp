#include "pose/skin_changes.hpp"

#include <algorithm>
#include <cmath>

#include "pose/lanes.hpp"
#include "pose/vector_clones.hpp"

namespace bodice::binding {
namespace {

/// An ellipsoid in units of its longest radius, in its own axes.
struct UnitEllipsoid {
  float radius[3], squared[3], inverse[3];
  float least_squared = 0.0f;
  float to_table[9];           ///< by rows
  float longest_m = 0.0f;      ///< what the unit is
  float height_unit_m = 0.0f;  ///< of a bundle's heights, carried
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
  Lanes blend[12] = {};
  for (std::size_t i = 0; i < entries; ++i) {
    const float* const map = maps + 12 * entry[i].term;
    Lanes weight;
    for (int l = 0; l < kLanes; ++l) weight[l] = static_cast<float>(entry[i].weight[l]) * (1.0f / 65535.0f);
    for (int c = 0; c < 12; ++c)
      for (int l = 0; l < kLanes; ++l) blend[c][l] += map[c] * weight[l];
  }
  Lanes p[3];
  for (int axis = 0; axis < 3; ++axis)
    for (int l = 0; l < kLanes; ++l) p[axis][l] = static_cast<float>(bundle.position[axis][l]);
  for (int row = 0; row < 3; ++row)
    for (int l = 0; l < kLanes; ++l)
      at[row][l] = blend[4 * row][l] * p[0][l] + blend[4 * row + 1][l] * p[1][l] +
                   blend[4 * row + 2][l] * p[2][l] + blend[4 * row + 3][l];
}

/// Unit directions of the closest points, and distances to them: the root t of |w(t)| = 1,
/// w_j = r_j y_j / (t + r_j^2), by three steps from below.
BODICE_CLONES
void find_feet(const UnitEllipsoid& e, const Lanes (&y)[3], Lanes (&w)[3], Lanes& distance) {
  constexpr int kSteps = 3;
  constexpr float kInside = -0.9999f, kTiny = 1e-12f;
  Lanes t;
  for (int l = 0; l < kLanes; ++l) {
    float start = kInside * e.least_squared;
    float squares = 0.0f;
    for (int j = 0; j < 3; ++j) {
      const float ry = e.radius[j] * std::abs(y[j][l]);
      start = std::max(start, ry - e.squared[j]);
      squares += ry * ry;
    }
    t[l] = std::max(start, std::sqrt(squares) - 1.0f);
  }
  for (int step = 0; step < kSteps; ++step)
    for (int l = 0; l < kLanes; ++l) {
      float length2 = 0.0f, slope = 0.0f;
      for (int j = 0; j < 3; ++j) {
        const float inverse = 1.0f / (t[l] + e.squared[j]);
        const float wj = e.radius[j] * y[j][l] * inverse;
        length2 += wj * wj;
        slope += wj * wj * inverse;
      }
      t[l] += (std::sqrt(length2) - 1.0f) * length2 / std::max(slope, kTiny);
    }
  for (int l = 0; l < kLanes; ++l) {
    float length2 = 0.0f;
    for (int j = 0; j < 3; ++j) {
      w[j][l] = e.radius[j] * y[j][l] / (t[l] + e.squared[j]);
      length2 += w[j][l] * w[j][l];
    }
    const float scale = 1.0f / std::sqrt(std::max(length2, kTiny));
    float normal2 = 0.0f, along = 0.0f;
    for (int j = 0; j < 3; ++j) {
      w[j][l] *= scale;
      const float n = w[j][l] * e.inverse[j];
      normal2 += n * n;
      along += n * (y[j][l] - e.radius[j] * w[j][l]);
    }
    distance[l] = along / std::sqrt(std::max(normal2, kTiny));
  }
}

/// Changes against the feet and heights at rest, by component.
BODICE_CLONES
void compare(const UnitEllipsoid& e, const proxy::SkinBundle& bundle, const Lanes (&w)[3],
             const Lanes& distance, Lanes (&change)[4]) {
  for (int l = 0; l < kLanes; ++l) {
    const float x = static_cast<float>(bundle.direction[0][l]) * (1.0f / 32767.0f);
    const float y = static_cast<float>(bundle.direction[1][l]) * (1.0f / 32767.0f);
    const float z = 1.0f - std::abs(x) - std::abs(y);
    const float fold = std::max(-z, 0.0f);
    const float px = x - std::copysign(fold, x), py = y - std::copysign(fold, y);
    const float scale = 1.0f / std::sqrt(px * px + py * py + z * z);
    const float rest[3] = {px * scale, py * scale, z * scale};
    for (int i = 0; i < 3; ++i)
      change[i][l] = e.to_table[3 * i] * w[0][l] + e.to_table[3 * i + 1] * w[1][l] +
                     e.to_table[3 * i + 2] * w[2][l] - rest[i];
    change[3][l] = distance[l] * e.longest_m - static_cast<float>(bundle.height[l]) * e.height_unit_m;
  }
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

void find_changes(const proxy::Binding& binding, std::size_t first, std::size_t last, double step_m,
                  const CarriedEllipsoid& carried, const float* maps, Change* changes) {
  const UnitEllipsoid unit = unit_ellipsoid(carried, step_m);
  for (std::size_t i = first; i < last; ++i) {
    const proxy::SkinBundle& bundle = binding.bundles[i];
    Lanes at[3], w[3], distance, change[4];
    skin_bundle(bundle, binding.entries.data() + binding.first_entry[i],
                binding.first_entry[i + 1] - binding.first_entry[i], maps, at);
    find_feet(unit, at, w, distance);
    compare(unit, bundle, w, distance, change);
    for (int l = 0; l < kLanes; ++l)
      changes[bundle.texel[l]] = Change{change[0][l], change[1][l], change[2][l], change[3][l]};
  }
}

}  // namespace bodice::binding
