// What all fits of signatures share.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include <bodice/geometry/mesh_distance.hpp>

#include "fit.hpp"

namespace calibrate {

/// One landmark of one body: the measures of the body, with a one before them, and the features.
struct SignatureRow {
  Eigen::VectorXd body, features;
};

/// A signature as matrices; its file has the same numbers in lists.
struct FittedSignature {
  Eigen::MatrixXd by_body;  ///< (1 + measures) x features: what is expected
  Eigen::MatrixXd upper;    ///< features x features: makes the differences from that ones of deviation one

  Eigen::VectorXd deviations(const SignatureRow& row) const {
    return upper * (row.features - by_body.transpose() * row.body);
  }
};

template <std::size_t N>
Eigen::VectorXd as_vector(const std::array<float, N>& x) {
  return Eigen::Map<const Eigen::VectorXf>(x.data(), N).template cast<double>();
}

/// Features at any point of the skin, between those of the corners of its triangle. `features` (vertex).
template <class Features>
Eigen::VectorXd features_at(const Sample& sample, const bodice::geometry::MeshDistance& distance,
                            const Vec3& point, Features&& features) {
  const auto at = distance.closest_point_within(point, std::numeric_limits<double>::infinity()).value();
  const auto& t = sample.skin().mesh.triangles[at.triangle];
  const auto& p = sample.skin().mesh.positions;
  const Vec3 a = p[t[1]] - p[t[0]], b = p[t[2]] - p[t[0]], c = at.point - p[t[0]];
  const double aa = a.dot(a), ab = a.dot(b), bb = b.dot(b), ca = c.dot(a), cb = c.dot(b);
  const double det = std::max(aa * bb - ab * ab, 1e-30);
  const double v = (bb * ca - ab * cb) / det, w = (aa * cb - ab * ca) / det;
  return (1.0 - v - w) * as_vector(features(t[0])) + v * as_vector(features(t[1])) +
         w * as_vector(features(t[2]));
}

/// Adds a row unless a number of it is not finite.
void add_row(const Eigen::VectorXd& measures, const Eigen::VectorXd& features,
             std::vector<SignatureRow>& rows);

/// Mean and covariance of the features, after what the measures of the body explain.
FittedSignature gaussian_signature(const std::vector<SignatureRow>& rows);

/// The members of the signature's file.
ordered_json members_of(const FittedSignature& signature);

}  // namespace calibrate
