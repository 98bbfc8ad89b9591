#include "fit.hpp"

#include <cmath>

#include "least_squares.hpp"
#include "signature.hpp"

namespace calibrate {
namespace {

using bodice::anatomy::Build;
using bodice::anatomy::kCoordinateCount;
using bodice::anatomy::LandmarkKind;
using bodice::body::LandmarkId;
using bodice::body::Part;
using bodice::geometry::Index;

/// What a squared weight costs: as little as keeps coordinates that nearly depend on each other from growing
/// large opposite weights.
constexpr double kRidge = 1e-7;
/// Skin this near to a level takes part in its fit; a fraction of the stature.
constexpr double kNearLevel = 0.06;

Eigen::VectorXd with_build(const Eigen::VectorXd& x, const Build& build) {
  Eigen::VectorXd all(x.size() + 1 + kBuildCount);
  all << x, 1.0, Eigen::Map<const Eigen::VectorXf>(build.data(), kBuildCount).cast<double>();
  return all;
}

bool on_trunk(Part part) {
  return bodice::body::is_torso(part) || part == Part::kThighL || part == Part::kThighR;
}

}  // namespace

ordered_json rounded(const Eigen::VectorXd& values) {
  ordered_json list = ordered_json::array();
  for (const double v : values) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", v);
    list.push_back(std::strtod(text, nullptr));
  }
  return list;
}

ordered_json fit_signature(const LandmarkKind& kind, const Samples& samples) {
  std::vector<SignatureRow> rows;
  for (const auto& sample : samples) {
    const bodice::geometry::MeshDistance distance({}, sample->skin().mesh);
    for (int side = 0; side < (kind.paired ? 2 : 1); ++side)
      add_row(as_vector(build_of(sample->coordinates())),
              features_at(*sample, distance, sample->landmark(bodice::body::of_side(kind.id, side)),
                          [&](Index v) { return sample->coordinates().at(v, side); }),
              rows);
  }
  return members_of(gaussian_signature(rows));
}

ordered_json fit_trunk_level(const LandmarkKind& kind, const Samples& samples) {
  LeastSquares level(kCoordinateCount + 1 + kBuildCount);
  for (const auto& sample : samples) {
    const Build build = build_of(sample->coordinates());
    const double height = sample->landmark(kind.id).y(), stature = sample->truth().stature_m;
    for (Index v = 0; v < sample->truth().part.size(); ++v) {
      const double above = (sample->skin().mesh.positions[v].y() - height) / stature;
      if (std::abs(above) > kNearLevel || !on_trunk(sample->truth().part[v])) continue;
      const Eigen::VectorXd x =
          0.5 * (as_vector(sample->coordinates().at(v, 0)) + as_vector(sample->coordinates().at(v, 1)));
      if (x.allFinite()) level.add(with_build(x, build), above);
    }
  }
  return {{"level", rounded(level.solve(kRidge).col(0))}};
}

ordered_json fit_limb_level(const LandmarkKind& kind, const Samples& samples) {
  const bool arm = kind.part == Part::kForearmL;
  LeastSquares level(kCoordinateCount + 1 + kBuildCount);
  for (const auto& sample : samples) {
    const Build build = build_of(sample->coordinates());
    const double stature = sample->truth().stature_m;
    for (int side = 0; side < 2; ++side) {
      const std::string name = side == 0 ? "_l" : "_r";
      const Vec3 joint = sample->landmark(bodice::body::of_side(kind.id, side));
      const Vec3 along = (joint - sample->joint((arm ? "elbow" : "knee") + name)).normalized();
      const Part part = side == 0 ? kind.part : bodice::body::mirrored(kind.part);
      for (Index v = 0; v < sample->truth().part.size(); ++v) {
        const Vec3 off = (sample->skin().mesh.positions[v] - joint) / stature;
        if (sample->truth().part[v] != part || off.norm() > kNearLevel) continue;
        const Eigen::VectorXd x = as_vector(sample->coordinates().at(v, side));
        if (x.allFinite()) level.add(with_build(x, build), off.dot(along));
      }
    }
  }
  return {{"level", rounded(level.solve(kRidge).col(0))}};
}

}  // namespace calibrate
