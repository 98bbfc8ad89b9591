// Based on: Khronos Group. KHR_mesh_quantization. 2019. - morph targets of normalized integers
#include "morph_targets.hpp"

#include <algorithm>
#include <cmath>

namespace bodice::inline v0_1::io {

namespace {

std::vector<Vec3f> differences(const std::vector<Vec3f>& to, const std::vector<Vec3f>& from) {
  std::vector<Vec3f> result(to.size());
  for (std::size_t i = 0; i < to.size(); ++i) result[i] = to[i] - from[i];
  return result;
}

/// Frames from one that has normals to the next. With the normals of every frame 120 frames of 10,000
/// vertices would take 11 MB; with every third they take 8.4 MB.
constexpr std::size_t kFramesANormal = 3;

template <class T>
std::array<T, 3> quantized(const Vec3f& v) {
  constexpr float kLargest = static_cast<float>(std::numeric_limits<T>::max());
  std::array<T, 3> q;
  for (int k = 0; k < 3; ++k)
    q[static_cast<std::size_t>(k)] = static_cast<T>(std::lround(std::clamp(v[k], -1.0f, 1.0f) * kLargest));
  return q;
}

/// The displacement of the base's normal that makes the sum point along the normal. Coordinates over 1 cannot
/// be stored, therefore a normal that turns far becomes shorter; viewers restore its length.
Vec3f normal_displacement(const Vec3f& normal, const Vec3f& base) {
  constexpr float kShortest = 0.05f;
  float length = 1.0f;
  for (int k = 0; k < 3; ++k)
    if (std::abs(normal[k] - base[k]) > 1.0f)
      length = std::min(length, (1.0f - std::abs(base[k])) / std::abs(normal[k]));
  return std::max(length, kShortest) * normal - base;
}

}  // namespace

Json add_float_targets(const FrameShape& base, std::size_t count,
                       const std::function<FrameShape(std::size_t)>& frame, GlbBuilder& glb) {
  Json targets = Json::array();
  for (std::size_t f = 0; f < count; ++f) {
    const FrameShape shape = frame(f);
    targets.push_back({{"POSITION", glb.add_positions(differences(shape.positions, base.positions))},
                       {"NORMAL", glb.add_vectors(differences(shape.normals, base.normals))}});
  }
  return targets;
}

float displacement_scale(std::span<const Vec3f> base, std::size_t count,
                         const std::function<std::vector<Vec3f>(std::size_t)>& frame) {
  float most = 0.0f;
  for (std::size_t f = 0; f < count; ++f) {
    const std::vector<Vec3f> moved = frame(f);
    for (std::size_t i = 0; i < moved.size(); ++i)
      most = std::max(most, (moved[i] - base[i]).cwiseAbs().maxCoeff());
  }
  return most > 0.0f ? std::exp2(std::ceil(std::log2(most))) : 1.0f;
}

Json add_quantized_targets(const FrameShape& base, std::size_t count,
                           const std::function<FrameShape(std::size_t)>& frame, GlbBuilder& glb) {
  Json targets = Json::array();
  GlbSparseWriter sparse(base.positions.size(), glb);
  std::vector<std::array<std::int16_t, 3>> positions(base.positions.size());
  std::vector<std::array<std::int8_t, 3>> normals(base.positions.size());
  std::size_t normal_accessor = 0;
  for (std::size_t f = 0; f < count; ++f) {
    const FrameShape shape = frame(f);
    for (std::size_t i = 0; i < positions.size(); ++i)
      positions[i] = quantized<std::int16_t>(shape.positions[i] - base.positions[i]);
    if (f % kFramesANormal == 0 || f + 1 == count) {
      for (std::size_t i = 0; i < normals.size(); ++i)
        normals[i] = quantized<std::int8_t>(normal_displacement(shape.normals[i], base.normals[i]));
      normal_accessor = sparse.add(std::span<const std::array<std::int8_t, 3>>(normals));
    }
    targets.push_back({{"POSITION", sparse.add(std::span<const std::array<std::int16_t, 3>>(positions))},
                       {"NORMAL", normal_accessor}});
  }
  glb.require("KHR_mesh_quantization");
  return targets;
}

}  // namespace bodice::io
