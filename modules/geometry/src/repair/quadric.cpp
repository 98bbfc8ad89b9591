#include "repair/quadric.hpp"

#include <algorithm>

namespace bodice::inline v0_1::geometry {
namespace {

/// The least pivot of the equations, a mean over the points in their scale: below it they lie on a conic.
constexpr double kLeastPivot = 1e-6;

}  // namespace

Quadric::Quadric(const Vec3& origin, const Vec3& normal, double scale)
    : origin_(origin),
      normal_(normal / scale),
      u_(normal.unitOrthogonal() / scale),
      v_(normal.cross(u_)),
      scale_(scale) {}

void Quadric::add(std::span<const Index> points, std::span<const Vec3> positions) {
  Moments s = sum_;  // in registers
  for (const Index i : points) {
    const Vec3 d = positions[i] - origin_;
    const double u = d.dot(u_), v = d.dot(v_), h = d.dot(normal_);
    const double uu = u * u, uv = u * v, vv = v * v;
    s.u += u, s.v += v;
    s.uu += uu, s.uv += uv, s.vv += vv;
    s.uuu += u * uu, s.uuv += u * uv, s.uvv += u * vv, s.vvv += v * vv;
    s.uuuu += uu * uu, s.uuuv += uu * uv, s.uuvv += uu * vv, s.uvvv += uv * vv, s.vvvv += vv * vv;
    s.h += h, s.hu += h * u, s.hv += h * v;
    s.huu += h * uu, s.huv += h * uv, s.hvv += h * vv, s.hh += h * h;
  }
  sum_ = s;
  count_ += static_cast<int>(points.size());
}

Quadric::Matrix Quadric::squares() const {
  const Moments& s = sum_;
  Matrix squares;
  squares << count_, s.u, s.v, s.uu, s.uv, s.vv,   //
      s.u, s.uu, s.uv, s.uuu, s.uuv, s.uvv,        //
      s.v, s.uv, s.vv, s.uuv, s.uvv, s.vvv,        //
      s.uu, s.uuu, s.uuv, s.uuuu, s.uuuv, s.uuvv,  //
      s.uv, s.uuv, s.uvv, s.uuuv, s.uuvv, s.uvvv,  //
      s.vv, s.uvv, s.vvv, s.uuvv, s.uvvv, s.vvvv;
  return squares;
}

Quadric::Vector Quadric::heights() const {
  return Vector{{sum_.h, sum_.hu, sum_.hv, sum_.huu, sum_.huv, sum_.hvv}};
}

std::optional<Quadric::Value> Quadric::solve(const Sums& sums, double scale) {
  const Eigen::LDLT<Matrix> factors(sums.squares);
  if (factors.info() != Eigen::Success || !(factors.vectorD().minCoeff() > kLeastPivot * sums.squares(0, 0)))
    return std::nullopt;
  const Vector solution = factors.solve(sums.heights);
  const double rest = sums.squared_heights - solution.dot(sums.heights);
  return Value{.height = scale * solution[0],
               .variance = factors.solve(Vector(Vector::Unit(0)))[0],
               .residual = scale * scale * std::max(rest, 0.0) / (sums.count - 6)};
}

std::optional<Quadric::Value> Quadric::value() const {
  if (count_ < kFewest) return std::nullopt;
  return solve({squares(), heights(), sum_.hh, count_}, scale_);
}

QuadricPatch Quadric::patch() const {
  QuadricPatch patch;
  const Eigen::LDLT<Matrix> factors(squares());
  patch.origin_ = origin_;
  patch.normal_ = scale_ * normal_;
  patch.u_ = u_;
  patch.v_ = v_;
  patch.heights_ = scale_ * factors.solve(heights());
  patch.covariance_ = factors.solve(Matrix::Identity());
  return patch;
}

QuadricPatch::Offset QuadricPatch::offset(const Vec3& p) const {
  const Vec3 d = p - origin_;
  const double u = d.dot(u_), v = d.dot(v_);
  Eigen::Matrix<double, 6, 1> terms;
  terms << 1.0, u, v, u * u, u * v, v * v;
  return {heights_.dot(terms) - d.dot(normal_), terms.dot(covariance_ * terms)};
}

}  // namespace bodice::geometry
