#include "fit.hpp"

#include <cmath>

#include <bodice/geometry/mesh_distance.hpp>

#include "landmarks/kinds/armpit_signature.hpp"
#include "least_squares.hpp"

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
/// The least deviation of a feature that counts: some millimeters, by which landmarks of made bodies are
/// uncertain.
constexpr double kLeastDeviation = 0.008;
/// Skin this near to a level takes part in its fit; a fraction of the stature.
constexpr double kNearLevel = 0.06;
/// The two features of the perineum, from this one on, that a mirror turns around: the mean over both is
/// zero.
constexpr int kLeftOfPerineum = 1;
constexpr double kAnywhere = std::numeric_limits<double>::infinity();

template <std::size_t N>
Eigen::VectorXd as_vector(const std::array<float, N>& x) {
  return Eigen::Map<const Eigen::VectorXf>(x.data(), N).template cast<double>();
}

Eigen::VectorXd with_build(const Eigen::VectorXd& x, const Build& build) {
  Eigen::VectorXd all(x.size() + 1 + kBuildCount);
  all << x, 1.0, Eigen::Map<const Eigen::VectorXf>(build.data(), kBuildCount).cast<double>();
  return all;
}

/// Features at any point of the skin, between those of the corners of its triangle. `features` (vertex).
template <class Features>
Eigen::VectorXd features_at(const Sample& sample, const bodice::geometry::MeshDistance& distance,
                            const Vec3& point, Features&& features) {
  const auto at = distance.closest_point_within(point, kAnywhere).value();
  const auto& t = sample.skin().mesh.triangles[at.triangle];
  const auto& p = sample.skin().mesh.positions;
  const Vec3 a = p[t[1]] - p[t[0]], b = p[t[2]] - p[t[0]], c = at.point - p[t[0]];
  const double aa = a.dot(a), ab = a.dot(b), bb = b.dot(b), ca = c.dot(a), cb = c.dot(b);
  const double det = std::max(aa * bb - ab * ab, 1e-30);
  const double v = (bb * ca - ab * cb) / det, w = (aa * cb - ab * ca) / det;
  return (1.0 - v - w) * as_vector(features(t[0])) + v * as_vector(features(t[1])) +
         w * as_vector(features(t[2]));
}

/// One landmark of one body: the measures of the body, with a one before them, and the features.
struct SignatureRow {
  Eigen::VectorXd body, features;
};

void add_row(const Eigen::VectorXd& measures, const Eigen::VectorXd& features,
             std::vector<SignatureRow>& rows) {
  Eigen::VectorXd body(measures.size() + 1);
  body << 1.0, measures;
  if (body.allFinite() && features.allFinite()) rows.push_back({body, features});
}

/// Mean and covariance of the features, after what the measures of the body explain.
ordered_json signature_of(const std::vector<SignatureRow>& rows) {
  const auto measures = rows.front().body.size() - 1, count = rows.front().features.size();
  LeastSquares follow(static_cast<int>(measures) + 1, static_cast<int>(count));
  for (const SignatureRow& row : rows) follow.add(row.body, row.features);
  const Eigen::MatrixXd by_body = follow.solve(kRidge);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count, count);
  for (const SignatureRow& row : rows) {
    const Eigen::VectorXd off = row.features - by_body.transpose() * row.body;
    covariance += off * off.transpose() / static_cast<double>(rows.size());
  }
  covariance.diagonal().array() += kLeastDeviation * kLeastDeviation;
  const Eigen::MatrixXd upper = covariance.inverse().llt().matrixU();
  Eigen::VectorXd of_body(count * measures), whiten(count * (count + 1) / 2);
  for (Eigen::Index i = 0, k = 0; i < count; ++i) {
    of_body.segment(i * measures, measures) = by_body.col(i).tail(measures);
    for (Eigen::Index j = i; j < count; ++j) whiten[k++] = upper(i, j);
  }
  return {{"mean", rounded(by_body.row(0).transpose())},
          {"of_body", rounded(of_body)},
          {"whiten", rounded(whiten)}};
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
  return signature_of(rows);
}

ordered_json fit_armpit_signature(const Samples& samples) {
  std::vector<SignatureRow> rows;
  for (const auto& sample : samples) {
    const bodice::geometry::MeshDistance distance({}, sample->skin().mesh);
    const auto& coordinates = sample->coordinates();
    for (int side = 0; side < 2; ++side) {
      if (!sample->knows(bodice::body::of_side(LandmarkId::kArmpitL, side))) continue;
      const float half = bodice::anatomy::half_chest(coordinates, side);
      add_row(
          as_vector(bodice::anatomy::armpit_measures(coordinates, half)),
          features_at(*sample, distance, sample->landmark(bodice::body::of_side(LandmarkId::kArmpitL, side)),
                      [&](Index v) { return bodice::anatomy::armpit_features(coordinates, v, side, half); }),
          rows);
    }
  }
  return signature_of(rows);
}

ordered_json fit_perineum_signature(const Samples& samples) {
  std::vector<SignatureRow> rows;
  for (const auto& sample : samples) {
    const bodice::geometry::MeshDistance distance({}, sample->skin().mesh);
    const auto& coordinates = sample->coordinates();
    if (!sample->knows(LandmarkId::kPerineum)) continue;
    Eigen::VectorXd features = features_at(*sample, distance, sample->landmark(LandmarkId::kPerineum),
                                           [&](Index v) { return coordinates.perineum_features(v); });
    for (int mirrored = 0; mirrored < 2; ++mirrored) {
      add_row(as_vector(coordinates.perineum_measures()), features, rows);
      features.segment(kLeftOfPerineum, 2) *= -1.0;
    }
  }
  return signature_of(rows);
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
