#include "still.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <bodice/engine/message.hpp>
#include <bodice/geometry/decompositions.hpp>
#include <bodice/io/scene.hpp>

namespace bodice::inline v0_1::page {
namespace {

/// One ellipsoid's shadow along z: its covariance is the upper left of A diag(r^2) A^T.
std::string ellipse(const proxy::ProxyEllipsoid& e) {
  geometry::Mat3 shape = e.shape.axes * e.shape.radii.cwiseAbs2().asDiagonal() * e.shape.axes.transpose();
  shape.row(2).setZero(), shape.col(2).setZero();  // adds an eigenvalue of 0, which is the least
  const geometry::SymmetricEigen eigen = geometry::eigen_of_symmetric(shape);
  const geometry::Vec3 radii = eigen.values.cwiseMax(0.0).cwiseSqrt();
  const geometry::Vec3 axis = eigen.vectors.col(2);
  const double turn_deg = -std::atan2(axis.y(), axis.x()) * 180.0 / std::numbers::pi;
  const auto color = io::part_color(e.part);
  const auto channel = [&](std::size_t k) { return static_cast<int>(255.0f * color[k]); };
  return engine::message("<ellipse rx='", 1e3 * radii[2], "' ry='", 1e3 * radii[1], "' transform='translate(",
                         std::lround(1e3 * e.shape.center.x()), ",", -std::lround(1e3 * e.shape.center.y()),
                         ") rotate(", turn_deg, ")' fill='rgb(", channel(0), ",", channel(1), ",", channel(2),
                         ")'/>");
}

}  // namespace

std::string still_svg(std::span<const proxy::ProxyEllipsoid> ellipsoids) {
  std::vector<const proxy::ProxyEllipsoid*> order;
  geometry::Box box;
  for (const proxy::ProxyEllipsoid& e : ellipsoids) {
    order.push_back(&e);
    const geometry::Box own = geometry::bounding_box(e.shape);
    box.extend(own.low), box.extend(own.high);
  }
  if (box.empty()) return "<svg></svg>";
  std::ranges::stable_sort(order, {},
                           [](const auto* e) { return e->shape.center.z() + e->shape.radii.minCoeff(); });
  const auto mm = [](double meters) { return std::lround(1e3 * meters); };
  std::string svg = engine::message("<svg viewBox='", mm(box.low.x()), " ", -mm(box.high.y()), " ",
                                    mm(box.size().x()), " ", mm(box.size().y()), "' role='img'>");
  for (const auto* e : order) svg += ellipse(*e);
  return svg + "</svg>";
}

}  // namespace bodice::page
