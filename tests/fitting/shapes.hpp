// Skins with known truth for the fitting tests.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include <bodice/body/part.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/geometry/ellipsoid.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace fitting_test {

using bodice::body::Part;
using bodice::geometry::Ellipsoid;
using bodice::geometry::Vec3;

struct Skin {
  bodice::geometry::TriMesh mesh;
  std::vector<Part> part;
  double stature_m = 1.0;

  bodice::fitting::LabeledSkin view() const { return {mesh, part, stature_m}; }
};

/// Adds a closed latitude-longitude mesh of an ellipsoid, outward.
inline void add_ellipsoid(Skin& skin, const Ellipsoid& e, Part part, int rings = 24) {
  const auto first = static_cast<bodice::geometry::Index>(skin.mesh.positions.size());
  const int around = 2 * rings;
  const auto at = [&](double theta, double phi) {
    const Vec3 u(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi));
    return Vec3(e.center + e.axes * e.radii.cwiseProduct(u));
  };
  skin.mesh.positions.push_back(at(0.0, 0.0));
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < around; ++j)
      skin.mesh.positions.push_back(at(std::numbers::pi * i / rings, 2.0 * std::numbers::pi * j / around));
  skin.mesh.positions.push_back(at(std::numbers::pi, 0.0));
  const auto id = [&](int i, int j) {
    if (i == 0) return first;
    if (i == rings) return first + 1 + static_cast<bodice::geometry::Index>((rings - 1) * around);
    return first + 1 + static_cast<bodice::geometry::Index>((i - 1) * around + j % around);
  };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < around; ++j) {
      if (i > 0) skin.mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i, j + 1)});
      if (i + 1 < rings) skin.mesh.triangles.push_back({id(i, j + 1), id(i + 1, j), id(i + 1, j + 1)});
    }
  skin.part.resize(skin.mesh.positions.size(), part);
}

/// Three ellipsoids apart from each other, as head, torso and a thigh, about a meter tall.
inline Skin three_ellipsoids(double scale = 1.0, const Vec3& offset = Vec3::Zero()) {
  Skin skin;
  skin.stature_m = 1.0 * scale;
  const auto add = [&](const Vec3& c, const Vec3& r, Part part) {
    add_ellipsoid(skin, {offset + scale * c, bodice::geometry::Mat3::Identity(), scale * r}, part);
  };
  add({0.0, 0.88, 0.0}, {0.07, 0.11, 0.09}, Part::kHead);
  add({0.0, 0.50, 0.0}, {0.16, 0.24, 0.10}, Part::kTorsoUL);
  add({0.1, 0.12, 0.0}, {0.06, 0.12, 0.07}, Part::kThighL);
  return skin;
}

/// Three bent limbs with folds: no small number of ellipsoids follows them.
inline Skin bent_limbs() {
  Skin skin;
  skin.stature_m = 1.7;
  const auto add = [&](const Vec3& center, const Vec3& radii, double bend, Part part) {
    const std::size_t first = skin.mesh.positions.size();
    add_ellipsoid(skin, {center, bodice::geometry::Mat3::Identity(), radii}, part);
    for (std::size_t v = first; v < skin.mesh.positions.size(); ++v) {
      Vec3& p = skin.mesh.positions[v];
      const double along = (p.y() - center.y()) / radii.y();
      p.x() += bend * along * along;
      p.z() = center.z() + (p.z() - center.z()) * (1.0 + 0.12 * std::sin(7.0 * along));
    }
  };
  add({0.0, 1.2, 0.0}, {0.16, 0.35, 0.11}, 0.05, Part::kTorsoUL);
  add({-0.12, 0.45, 0.0}, {0.08, 0.42, 0.08}, -0.10, Part::kThighR);
  add({0.12, 0.45, 0.0}, {0.08, 0.42, 0.08}, 0.12, Part::kThighL);
  return skin;
}

}  // namespace fitting_test
