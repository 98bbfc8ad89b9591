#include "fit.hpp"

#include <cmath>

#include <bodice/geometry/mesh_distance.hpp>

#include "least_squares.hpp"

namespace calibrate {
namespace {

using bodice::anatomy::Build;
using bodice::anatomy::CoordinateArray;
using bodice::anatomy::kCoordinateCount;
using bodice::anatomy::LandmarkKind;
using bodice::body::LandmarkId;
using bodice::body::Part;
using bodice::geometry::Index;

constexpr int kBuildCount = static_cast<int>(std::tuple_size_v<Build>);
/// What a squared weight costs: as little as keeps coordinates that nearly depend on each other from growing
/// large opposite weights.
constexpr double kRidge = 1e-7;
/// The least deviation of a feature that counts: some millimeters, by which landmarks of made bodies are
/// uncertain.
constexpr double kLeastDeviation = 0.008;
/// Skin this near to a level takes part in its fit; a fraction of the stature.
constexpr double kNearLevel = 0.06;
constexpr double kAnywhere = std::numeric_limits<double>::infinity();

/// Numbers with the digits that single precision holds.
ordered_json rounded(const Eigen::VectorXd& values) {
  ordered_json list = ordered_json::array();
  for (const double v : values) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", v);
    list.push_back(std::strtod(text, nullptr));
  }
  return list;
}

Eigen::VectorXd as_vector(const CoordinateArray& x) {
  return Eigen::Map<const Eigen::VectorXf>(x.data(), kCoordinateCount).cast<double>();
}

Eigen::VectorXd with_build(const Eigen::VectorXd& x, const Build& build) {
  Eigen::VectorXd all(x.size() + 1 + kBuildCount);
  all << x, 1.0, Eigen::Map<const Eigen::VectorXf>(build.data(), kBuildCount).cast<double>();
  return all;
}

/// The coordinates at any point of the skin, between those of the corners of its triangle.
Eigen::VectorXd coordinates_at(const Sample& sample, const bodice::geometry::MeshDistance& distance,
                               const Vec3& point, int side) {
  const auto at = distance.closest_point_within(point, kAnywhere).value();
  const auto& t = sample.skin().mesh.triangles[at.triangle];
  const auto& p = sample.skin().mesh.positions;
  const Vec3 a = p[t[1]] - p[t[0]], b = p[t[2]] - p[t[0]], c = at.point - p[t[0]];
  const double aa = a.dot(a), ab = a.dot(b), bb = b.dot(b), ca = c.dot(a), cb = c.dot(b);
  const double det = std::max(aa * bb - ab * ab, 1e-30);
  const double v = (bb * ca - ab * cb) / det, w = (aa * cb - ab * ca) / det;
  const auto x = [&](int k) { return as_vector(sample.coordinates().at(t[k], side)); };
  return (1.0 - v - w) * x(0) + v * x(1) + w * x(2);
}

bool on_trunk(Part part) {
  return bodice::body::is_torso(part) || part == Part::kThighL || part == Part::kThighR;
}

}  // namespace

ordered_json fit_signature(const LandmarkKind& kind, const Samples& samples) {
  LeastSquares follow(kBuildCount + 1, kCoordinateCount);
  std::vector<std::pair<Eigen::VectorXd, Eigen::VectorXd>> rows;  // build with its one, features
  for (const auto& sample : samples) {
    const bodice::geometry::MeshDistance distance({}, sample->skin().mesh);
    for (int side = 0; side < 2; ++side) {
      const LandmarkId id = kind.paired ? bodice::body::of_side(kind.id, side) : kind.id;
      const Eigen::VectorXd x = coordinates_at(*sample, distance, sample->landmark(id), side);
      const Eigen::VectorXd z = with_build(Eigen::VectorXd(), build_of(sample->coordinates()));
      if (!x.allFinite() || !z.allFinite()) continue;
      follow.add(z, x);
      rows.emplace_back(z, x);
    }
  }
  const Eigen::MatrixXd by_build = follow.solve(kRidge);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(kCoordinateCount, kCoordinateCount);
  for (const auto& [z, x] : rows) {
    const Eigen::VectorXd off = x - by_build.transpose() * z;
    covariance += off * off.transpose() / static_cast<double>(rows.size());
  }
  covariance.diagonal().array() += kLeastDeviation * kLeastDeviation;
  const Eigen::MatrixXd upper = covariance.inverse().llt().matrixU();
  Eigen::VectorXd of_body(kCoordinateCount * kBuildCount),
      whiten(kCoordinateCount * (kCoordinateCount + 1) / 2);
  for (int i = 0, k = 0; i < kCoordinateCount; ++i) {
    for (int j = 0; j < kBuildCount; ++j) of_body[i * kBuildCount + j] = by_build(1 + j, i);
    for (int j = i; j < kCoordinateCount; ++j) whiten[k++] = upper(i, j);
  }
  return {{"mean", rounded(by_build.row(0).transpose())},
          {"of_body", rounded(of_body)},
          {"whiten", rounded(whiten)}};
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
