#include "scan/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::synth {
namespace {

using geometry::Vec3;

/// Cosine between normal and line of sight below which scanners see nothing.
constexpr double kSteepest = 0.2;
/// Pixels along each side of a camera's picture, which covers this multiple of its distance.
constexpr int kPixels = 700;
constexpr double kWidth = 1.6;
/// A triangle this far behind the first surface on its ray is hidden.
constexpr double kBehind_m = 0.012;

/// The depth at which each ray of a camera first meets the mesh.
class DepthMap {
 public:
  DepthMap(const geometry::TriMesh& mesh, const Camera& camera)
      : origin_(camera.position), depth_(kPixels * kPixels, std::numeric_limits<float>::infinity()) {
    forward_ = (camera.target - camera.position).normalized();
    right_ = forward_.cross(Vec3::UnitY()).normalized();
    up_ = right_.cross(forward_);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      draw(seen(mesh.corner(t, 0)), seen(mesh.corner(t, 1)), seen(mesh.corner(t, 2)));
  }

  bool shows(const Vec3& point) const {
    const Vec3 p = seen(point);
    const int x = static_cast<int>(p.x()), y = static_cast<int>(p.y());
    if (x < 0 || y < 0 || x >= kPixels || y >= kPixels || p.z() <= 0.0) return false;
    return p.z() < static_cast<double>(depth_[static_cast<std::size_t>(y * kPixels + x)]) + kBehind_m;
  }

 private:
  /// Pixel coordinates and depth.
  Vec3 seen(const Vec3& point) const {
    const Vec3 d = point - origin_;
    const double depth = d.dot(forward_), scale = kPixels / (kWidth * std::max(depth, 1e-3));
    return {0.5 * kPixels + scale * d.dot(right_), 0.5 * kPixels + scale * d.dot(up_), depth};
  }

  void draw(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    if (std::abs(area) < 1e-12) return;
    const auto range = [](double u, double v, double w) {
      return std::pair(std::max(0, static_cast<int>(std::floor(std::min({u, v, w}) - 0.5))),
                       std::min(kPixels - 1, static_cast<int>(std::ceil(std::max({u, v, w})))));
    };
    const auto [x0, x1] = range(a.x(), b.x(), c.x());
    const auto [y0, y1] = range(a.y(), b.y(), c.y());
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const double px = x + 0.5, py = y + 0.5;
        const double u = ((c.x() - b.x()) * (py - b.y()) - (c.y() - b.y()) * (px - b.x())) / area;
        const double v = ((a.x() - c.x()) * (py - c.y()) - (a.y() - c.y()) * (px - c.x())) / area;
        if (u < 0.0 || v < 0.0 || u + v > 1.0) continue;
        const auto depth = static_cast<float>(u * a.z() + v * b.z() + (1.0 - u - v) * c.z());
        float& first = depth_[static_cast<std::size_t>(y * kPixels + x)];
        first = std::min(first, depth);
      }
  }

  Vec3 origin_, forward_, right_, up_;
  std::vector<float> depth_;
};

}  // namespace

std::vector<int> best_cameras(const engine::Context& context, const geometry::TriMesh& mesh,
                              std::span<const Camera> cameras) {
  std::vector<int> best(mesh.triangles.size(), -1);
  std::vector<double> cosine(mesh.triangles.size(), kSteepest);
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    const DepthMap map(mesh, cameras[c]);
    engine::parallel_for(context, mesh.triangles.size(), 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        const Vec3 middle = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0;
        const double facing =
            area_vector(mesh, t).normalized().dot((cameras[c].position - middle).normalized());
        if (facing <= cosine[t] || !map.shows(middle)) continue;
        cosine[t] = facing;
        best[t] = static_cast<int>(c);
      }
    });
  }
  return best;
}

std::vector<Camera> ring_of_cameras(int count, double radius_m, double turn_rad, double target_m) {
  std::vector<Camera> cameras;
  for (int i = 0; i < count; ++i) {
    const double angle = turn_rad + 2.0 * std::numbers::pi * i / count;
    const double height = i % 2 == 0 ? 0.6 : 1.9;
    cameras.push_back(
        {{radius_m * std::sin(angle), height, radius_m * std::cos(angle)}, {0.0, target_m, 0.0}});
  }
  return cameras;
}

}  // namespace bodice::synth
