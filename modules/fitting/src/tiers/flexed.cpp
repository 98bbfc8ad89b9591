#include "tiers/flexed.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <Eigen/LU>
#include <Eigen/SVD>

#include <bodice/engine/parallel.hpp>
#include <bodice/fitting/refit.hpp>

namespace bodice::inline v0_1::fitting {
namespace {

using geometry::Ellipsoid;
using geometry::Mat3;
using Mat4 = Eigen::Matrix4d;
using Vec4 = Eigen::Vector4d;

/// Skin within this share of the stature of its nearest ellipsoid's distance counts for an ellipsoid's map.
constexpr double kBand = 0.020 / 1.7;
/// Weight of the rigid part of a map, of the weight of its skin: flat skin leaves a direction open.
constexpr double kRigid = 0.02;
constexpr std::size_t kMostVertices = 16384;
/// Ellipsoids that lie farther from the skin in the mean, as a share of the stature, have not been carried
/// back well: skirts do not bend as limbs do. Eleven bodies have .0010 to .0016, a dress in a body's file
/// .0026.
constexpr double kFarOff = 0.0021;
constexpr std::size_t kMostChecked = 4096;

/// The skin near an ellipsoid in both poses, as moments about its center.
struct Moments {
  Mat4 flexed = Mat4::Zero();    ///< sum of weight * s s^T, s = (flexed - center, 1)
  Mat4 as_it_is = Mat4::Zero();  ///< sum of weight * t s^T, t = (as it is, 1)
  double weight = 0.0;
};

double outside_sphere(const Ellipsoid& e, const Vec3& point) {
  return (point - e.center).norm() - e.radii.maxCoeff();
}

/// The rotation that takes the flexed skin to the skin as it is, best in the mean square.
Mat3 rotation_of(const Moments& m) {
  const Vec3 mean_s = m.flexed.col(3).head<3>() / m.weight, mean_t = m.as_it_is.col(3).head<3>() / m.weight;
  const Mat3 covariance = m.as_it_is.topLeftCorner<3, 3>() - m.weight * mean_t * mean_s.transpose();
  const Eigen::JacobiSVD<Mat3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0.0) u.col(2) *= -1.0;
  return u * svd.matrixV().transpose();
}

/// The affine map of an ellipsoid's skin, of (point - center, 1).
Mat4 map_of(const Ellipsoid& e, const Moments& m) {
  Mat4 rigid = Mat4::Zero();
  rigid.topLeftCorner<3, 3>() = e.axes * e.radii.cwiseAbs2().asDiagonal() * e.axes.transpose();
  rigid *= kRigid * m.weight;
  Mat4 rotation = Mat4::Zero();
  rotation.topLeftCorner<3, 3>() = rotation_of(m);
  return (m.as_it_is + rotation * rigid) * (m.flexed + rigid).inverse();
}

/// The ellipsoid's image under the affine map of its skin.
Ellipsoid carried(const Ellipsoid& e, const Moments& m) {
  if (!(m.weight > 0.0)) return e;
  const Mat4 map = map_of(e, m);
  const Eigen::JacobiSVD<Mat3> svd(map.topLeftCorner<3, 3>() * e.axes * e.radii.asDiagonal(),
                                   Eigen::ComputeFullU | Eigen::ComputeFullV);
  Ellipsoid image{map.topRightCorner<3, 1>(), svd.matrixU(), svd.singularValues()};
  image.radii = image.radii.cwiseMax(0.1 * e.radii.minCoeff());
  if (image.axes.determinant() < 0.0) image.axes.col(2) *= -1.0;
  return image;
}

/// The image without its shear; its axes are those of the ellipsoid, turned.
Ellipsoid carried_stiffly(const Ellipsoid& e, const Moments& m) {
  if (!(m.weight > 0.0)) return e;
  const Mat4 map = map_of(e, m);
  const Mat3 axes = map.topLeftCorner<3, 3>() * e.axes;
  const Eigen::JacobiSVD<Mat3> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Ellipsoid image{map.topRightCorner<3, 1>(), svd.matrixU() * svd.matrixV().transpose(), e.radii};
  if (image.axes.determinant() < 0.0) image.axes.col(2) *= -1.0;
  const Vec3 stretch = (image.axes.transpose() * axes).diagonal().cwiseAbs();
  image.radii = e.radii.cwiseProduct(stretch).cwiseMax(0.1 * e.radii.minCoeff());
  return image;
}

/// Which ellipsoids a flexed vertex counts for, and how much.
std::vector<std::pair<std::uint32_t, double>> near_ellipsoids(
    const std::vector<proxy::ProxyEllipsoid>& ellipsoids, const Vec3& point, double band_m) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& e : ellipsoids)
    if (outside_sphere(e.shape, point) < least)
      least = std::min(least, geometry::closest_point(e.shape, point).signed_distance);
  std::vector<std::pair<std::uint32_t, double>> near;
  for (std::uint32_t k = 0; k < ellipsoids.size(); ++k) {
    if (outside_sphere(ellipsoids[k].shape, point) >= least + band_m) continue;
    const double excess = geometry::closest_point(ellipsoids[k].shape, point).signed_distance - least;
    if (excess < band_m) near.emplace_back(k, (1.0 - excess / band_m) * (1.0 - excess / band_m));
  }
  return near;
}

/// #E: the skin near each ellipsoid, as it was found on `flexed` and as it is.
std::vector<Moments> moments_of(const engine::Context& context, const LabeledSkin& skin,
                                std::span<const Vec3> flexed,
                                const std::vector<proxy::ProxyEllipsoid>& ellipsoids) {
  const std::size_t step = std::max<std::size_t>(1, flexed.size() / kMostVertices);
  std::vector<std::vector<std::pair<std::uint32_t, double>>> near((flexed.size() + step - 1) / step);
  engine::parallel_for(context, near.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      near[i] = near_ellipsoids(ellipsoids, flexed[i * step], kBand * skin.stature_m);
  });
  std::vector<Moments> moments(ellipsoids.size());
  for (std::size_t i = 0; i < near.size(); ++i)
    for (const auto& [k, weight] : near[i]) {
      const Vec4 s = (flexed[i * step] - ellipsoids[k].shape.center).homogeneous();
      const Vec4 t = skin.mesh.positions[i * step].homogeneous();
      moments[k].flexed += weight * s * s.transpose();
      moments[k].as_it_is += weight * t * s.transpose();
      moments[k].weight += weight;
    }
  return moments;
}

void carry_back(const engine::Context& context, const LabeledSkin& skin, std::span<const Vec3> flexed,
                std::vector<proxy::ProxyEllipsoid>& ellipsoids) {
  const std::vector<Moments> moments = moments_of(context, skin, flexed, ellipsoids);
  for (std::size_t k = 0; k < ellipsoids.size(); ++k)
    ellipsoids[k].shape = carried(ellipsoids[k].shape, moments[k]);
}

/// The mean distance between the skin and the surface of the ellipsoids, at some of the vertices.
double mean_error_m(const engine::Context& context, const LabeledSkin& skin, const Draft& draft) {
  const std::vector<Vec3>& positions = skin.mesh.positions;
  const std::size_t step = std::max<std::size_t>(1, positions.size() / kMostChecked);
  const std::size_t count = (positions.size() + step - 1) / step;
  const double sum = engine::ordered_reduce(
      context, count, 64, 0.0,
      [&](std::size_t begin, std::size_t end) {
        double some = 0.0;
        for (std::size_t i = begin; i < end; ++i) {
          double least = std::numeric_limits<double>::infinity();
          for (const auto& e : draft.data.ellipsoids)
            if (outside_sphere(e.shape, positions[i * step]) < least)
              least = std::min(least, geometry::closest_point(e.shape, positions[i * step]).signed_distance);
          some += std::abs(least);
        }
        return some;
      },
      std::plus<>());
  return sum / static_cast<double>(std::max<std::size_t>(1, count));
}

}  // namespace

std::vector<Ellipsoid> carry_ellipsoids(const engine::Context& context,
                                        std::span<const proxy::ProxyEllipsoid> ellipsoids,
                                        std::span<const Vec3> from, const LabeledSkin& to) {
  const std::vector<proxy::ProxyEllipsoid> all(ellipsoids.begin(), ellipsoids.end());
  const std::vector<Moments> moments = moments_of(context, to, from, all);
  std::vector<Ellipsoid> shapes;
  for (std::size_t k = 0; k < all.size(); ++k) shapes.push_back(carried_stiffly(all[k].shape, moments[k]));
  return shapes;
}

Draft fit_tight_flexed(const engine::Context& context, const SkinSource& source, const FitOptions& options,
                       int count, double time_budget_s) {
  const LabeledSkin& skin = source.skin;
  const geometry::TriMesh mesh{{options.flexed.begin(), options.flexed.end()}, skin.mesh.triangles};
  const geometry::MeshDistance distance(context, mesh);
  const LabeledSkin flexed{mesh, skin.part, skin.stature_m, skin.frame, &distance};
  FitOptions there = options;
  there.on_improved = nullptr;  // proxies found meanwhile stand in another pose
  there.covering = false;
  const SkinSource flexed_source = make_skin_source(context, flexed, options.parts);
  Draft draft = fit_tight(context, flexed_source, there, count, time_budget_s);
  carry_back(context, skin, options.flexed, draft.data.ellipsoids);
  const double error_m = mean_error_m(context, skin, draft);
  if (error_m <= kFarOff * skin.stature_m) return draft;
  Draft as_it_is = fit_tight(context, source, options, count, time_budget_s);
  return mean_error_m(context, skin, as_it_is) < error_m ? as_it_is : draft;
}

}  // namespace bodice::fitting
