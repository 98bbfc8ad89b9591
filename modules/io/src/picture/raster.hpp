// Rasterizes triangles orthographically.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Core>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::io {

using Vec3f = Eigen::Vector3f;

/// Maps the world to pixels: x right, y down, z away from the eye, all in pixels.
struct View {
  Vec3f right, up, toward_eye;  ///< orthonormal, in the world
  Vec3f center;                 ///< world point in the middle of the picture
  float pixels_per_meter = 1.0f;
  int width = 0, height = 0;

  Vec3f project(const Vec3f& p) const {
    const Vec3f d = (p - center) * pixels_per_meter;
    return {0.5f * static_cast<float>(width) + d.dot(right), 0.5f * static_cast<float>(height) - d.dot(up),
            -d.dot(toward_eye)};
  }
};

struct DepthBuffer {
  explicit DepthBuffer(const View& view)
      : width(view.width),
        height(view.height),
        depth(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
              std::numeric_limits<float>::infinity()) {}

  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }

  int width, height;
  std::vector<float> depth;
};

/// A triangle projected to the picture, for barycentric weights of a pixel.
struct FlatTriangle {
  Vec3f a, b, c;
  float area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());  ///< twice, signed

  Vec3f weights(float x, float y) const {
    const float wb = ((x - a.x()) * (c.y() - a.y()) - (y - a.y()) * (c.x() - a.x())) / area;
    const float wc = ((b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x())) / area;
    return {1.0f - wb - wc, wb, wc};
  }

  /// Distance in the picture from the point with weights `w` to the nearest edge, in pixels.
  float distance_to_edges(const Vec3f& w) const {
    const auto length = [](const Vec3f& p, const Vec3f& q) {
      return std::hypot(q.x() - p.x(), q.y() - p.y());
    };
    const float heights[] = {w[0] / length(b, c), w[1] / length(c, a), w[2] / length(a, b)};
    return std::abs(area) * std::min({heights[0], heights[1], heights[2]});
  }
};

/// Calls visit(pixel) for each pixel center in the triangle that is nearer than the stored depth, and stores
/// its depth. Both sides are drawn.
template <class Visit>
void draw_triangle(DepthBuffer& buffer, const FlatTriangle& triangle, Visit&& visit) {
  const auto& [a, b, c, area] = triangle;
  if (!(std::abs(area) > 1e-12f)) return;
  auto first = [](float low) { return static_cast<int>(std::ceil(std::max(low - 0.5f, 0.0f))); };
  auto last = [](float high, int size) {
    return static_cast<int>(std::floor(std::clamp(high - 0.5f, -1.0f, static_cast<float>(size - 1))));
  };
  const auto [x_low, x_high] = std::minmax({a.x(), b.x(), c.x()});
  const auto [y_low, y_high] = std::minmax({a.y(), b.y(), c.y()});
  if (!(x_low < static_cast<float>(buffer.width) && y_low < static_cast<float>(buffer.height))) return;
  const int x_end = last(x_high, buffer.width), y_end = last(y_high, buffer.height);
  for (int y = first(y_low); y <= y_end; ++y) {
    const float py = static_cast<float>(y) + 0.5f;
    for (int x = first(x_low); x <= x_end; ++x) {
      const Vec3f w = triangle.weights(static_cast<float>(x) + 0.5f, py);
      if (w.minCoeff() < 0.0f) continue;
      const float depth = w.dot(Vec3f(a.z(), b.z(), c.z()));
      const std::size_t pixel = buffer.at(x, y);
      if (depth >= buffer.depth[pixel]) continue;
      buffer.depth[pixel] = depth;
      visit(pixel);
    }
  }
}

}  // namespace bodice::io
