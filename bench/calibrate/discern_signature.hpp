// A signature that discerns a landmark from the skin that it is searched among.
#pragma once

#include "signature.hpp"

namespace calibrate {

/// A vertex that a search may find.
struct Candidate {
  Eigen::VectorXd features;
  Vec3 off;               ///< from the true landmark; fractions of the body size
  double area = 0.0;      ///< area of the skin around it; a fraction of the squared body size
  double handicap = 0.0;  ///< how many deviations the search counts it nearer to the signature than it is
};

/// One landmark of one body, and all that it could be mistaken for.
struct Search {
  std::size_t person;
  Group group;
  SignatureRow truth;
  std::vector<Candidate> candidates;
};

/// What a descent is to reach.
struct Goal {
  std::vector<bool> odd;    ///< features that a mirror turns around, which do not depend on the others
  double likelihood = 0.0;  ///< what the likelihood of the true landmark's own features counts
  /// How much of its error makes a wrong vertex likelier than it is, so that it has to lose clearly.
  double margin = 0.0;
  /// What deviations are multiplied by in the end, because features that discern come to deviate much: with
  /// this, as many landmarks deviate as much as confidences expect (landmarks/kinds).
  double deviation = 1.0;
};

/// Starts from mean and covariance of the true landmarks, and descends to what finds them among the
/// candidates. Prints the errors of both, and those of people that were left out.
FittedSignature discern_signature(const std::vector<Search>& searches, const Goal& goal);

}  // namespace calibrate
