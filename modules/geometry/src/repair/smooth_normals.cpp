#include "repair/smooth_normals.hpp"

#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::geometry {
namespace {

constexpr int kNormalRings = 2;
constexpr std::size_t kNormalGrain = 4096;

}  // namespace

std::vector<Vec3> smooth_normals(const engine::Context& context, const Neighbors& neighbors,
                                 std::vector<Vec3> normals) {
  std::vector<Vec3> next(normals.size());
  for (int pass = 0; pass < kNormalRings; ++pass) {
    engine::parallel_for(context, normals.size(), kNormalGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        Vec3 sum = normals[v];
        for (const Index other : neighbors.of(v)) sum += normals[other];
        next[v] = sum.normalized();
      }
    });
    normals.swap(next);
  }
  return normals;
}

}  // namespace bodice::geometry
