#include "signature.hpp"

#include "least_squares.hpp"

namespace calibrate {
namespace {

/// What a squared weight costs: as little as keeps measures that nearly depend on each other from growing
/// large opposite weights.
constexpr double kFollowRidge = 1e-7;
/// The least deviation of a feature that counts: some millimeters, by which landmarks of made bodies are
/// uncertain.
constexpr double kLeastDeviation = 0.008;

}  // namespace

void add_row(const Eigen::VectorXd& measures, const Eigen::VectorXd& features,
             std::vector<SignatureRow>& rows) {
  Eigen::VectorXd body(measures.size() + 1);
  body << 1.0, measures;
  if (body.allFinite() && features.allFinite()) rows.push_back({body, features});
}

FittedSignature gaussian_signature(const std::vector<SignatureRow>& rows) {
  const auto measures = rows.front().body.size() - 1, count = rows.front().features.size();
  LeastSquares follow(static_cast<int>(measures) + 1, static_cast<int>(count));
  for (const SignatureRow& row : rows) follow.add(row.body, row.features);
  const Eigen::MatrixXd by_body = follow.solve(kFollowRidge);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count, count);
  for (const SignatureRow& row : rows) {
    const Eigen::VectorXd off = row.features - by_body.transpose() * row.body;
    covariance += off * off.transpose() / static_cast<double>(rows.size());
  }
  covariance.diagonal().array() += kLeastDeviation * kLeastDeviation;
  return {by_body, covariance.inverse().llt().matrixU()};
}

ordered_json members_of(const FittedSignature& signature) {
  const Eigen::Index measures = signature.by_body.rows() - 1, count = signature.by_body.cols();
  Eigen::VectorXd of_body(count * measures), whiten(count * (count + 1) / 2);
  for (Eigen::Index i = 0, k = 0; i < count; ++i) {
    of_body.segment(i * measures, measures) = signature.by_body.col(i).tail(measures);
    for (Eigen::Index j = i; j < count; ++j) whiten[k++] = signature.upper(i, j);
  }
  return {{"mean", rounded(signature.by_body.row(0).transpose())},
          {"of_body", rounded(of_body)},
          {"whiten", rounded(whiten)}};
}

}  // namespace calibrate
