#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <bodice/engine/random.hpp>
#include <bodice/geometry/similarity.hpp>

using namespace bodice;
using geometry::Mat3;
using geometry::Vec3;

TEST_CASE("the rotation of a matrix off by a thousandth is that of its singular value decomposition") {
  engine::Random random(4);
  for (int i = 0; i < 200; ++i) {
    const Vec3 axis(random.normal(), random.normal(), random.normal());
    const double scale = std::pow(10.0, random.uniform(-5.9, 5.9));
    Mat3 matrix = Eigen::AngleAxisd(random.uniform(0.0, 3.14), axis.normalized()).toRotationMatrix();
    for (double& entry : matrix.reshaped()) entry = scale * (entry + random.uniform(-1e-3, 1e-3));
    const geometry::Similarity found = geometry::similarity_of(matrix);
    REQUIRE(found.refusal.empty());
    CHECK(found.scale == doctest::Approx(std::cbrt(matrix.determinant())));
    const Eigen::JacobiSVD<Mat3> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
    CHECK((found.rotation - svd.matrixU() * svd.matrixV().transpose()).norm() < 1e-12);
  }
}

TEST_CASE("a matrix that is no similarity is refused with the reason") {
  const auto refusal = [](const Mat3& matrix) { return geometry::similarity_of(matrix).refusal; };
  Mat3 bad = Mat3::Identity();
  bad(1, 2) = std::numeric_limits<double>::infinity();
  CHECK(refusal(bad) == "is not finite");
  CHECK(refusal(Mat3::Zero()) == "has no extent");
  CHECK(refusal(Vec3(1.0, 1.0, -1.0).asDiagonal()) == "mirrors");
  CHECK(refusal(Vec3(1.0, 1.0, 1e-30).asDiagonal()) == "is flat");
  CHECK(refusal(1e-7 * Mat3::Identity()) == "has nearly no extent");
  CHECK(refusal(1e7 * Mat3::Identity()) == "is larger than a million");
  CHECK(refusal(Vec3(1.0, 1.1, 1.0).asDiagonal()) == "shears, or scales its axes unlike");
  CHECK(refusal(1e-6 * Mat3::Identity()).empty());
  CHECK(refusal(1e6 * Mat3::Identity()).empty());
}
