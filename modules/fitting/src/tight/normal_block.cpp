#include "tight/normal_block.hpp"

#include "base/vector_clones.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

constexpr std::size_t kLanes = 16;  // each lane has its own sum, so that vector code adds in a fixed order
constexpr int kUnknowns = 9, kEntries = 45;

struct Sums {
  float matrix[kEntries][kLanes];  ///< lower triangle by rows
  float vector[kUnknowns][kLanes];
};

}  // namespace

/// Adds the terms of the samples, in directions wx, wy, wz; their number is a multiple of kLanes.
BODICE_CLONES static void add_up(const FloatEllipsoid& ellipsoid, const BlockSamples& samples,
                                 Sums& __restrict sums) {
  const FloatEllipsoid e = ellipsoid;
  const std::size_t n = samples.count;
  const float *const wx = samples.wx.data(), *const wy = samples.wy.data(), *const wz = samples.wz.data();
  const float *const residual = samples.residual.data(), *const weight = samples.weight.data();
  const float r0 = e.r[0], r1 = e.r[1], r2 = e.r[2];
  float j[kUnknowns][kLanes], wj[kUnknowns][kLanes];
  for (std::size_t first = 0; first < n; first += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t i = first + lane;
      const float f0 = r0 * wx[i], f1 = r1 * wy[i], f2 = r2 * wz[i];
      float n0 = wx[i] / r0, n1 = wy[i] / r1, n2 = wz[i] / r2;
      const float scale = 1.0f / __builtin_sqrtf(n0 * n0 + n1 * n1 + n2 * n2 + 1e-18f);
      n0 *= scale, n1 *= scale, n2 *= scale;
      j[0][lane] = -(e.rt[0][0] * n0 + e.rt[1][0] * n1 + e.rt[2][0] * n2);
      j[1][lane] = -(e.rt[0][1] * n0 + e.rt[1][1] * n1 + e.rt[2][1] * n2);
      j[2][lane] = -(e.rt[0][2] * n0 + e.rt[1][2] * n1 + e.rt[2][2] * n2);
      j[3][lane] = -n0 * f0;
      j[4][lane] = -n1 * f1;
      j[5][lane] = -n2 * f2;
      j[6][lane] = -(f1 * n2 - f2 * n1);
      j[7][lane] = -(f2 * n0 - f0 * n2);
      j[8][lane] = -(f0 * n1 - f1 * n0);
    }
    for (int a = 0; a < kUnknowns; ++a)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        wj[a][lane] = weight[first + lane] * j[a][lane];
        sums.vector[a][lane] += residual[first + lane] * wj[a][lane];
      }
    int entry = 0;
    for (int a = 0; a < kUnknowns; ++a)
      for (int b = 0; b <= a; ++b, ++entry)
        for (std::size_t lane = 0; lane < kLanes; ++lane)
          sums.matrix[entry][lane] += wj[a][lane] * j[b][lane];
  }
}

namespace {

double total(const float (&lanes)[kLanes]) {
  double sum = 0.0;
  for (const float s : lanes) sum += static_cast<double>(s);
  return sum;
}

}  // namespace

void BlockSamples::start(std::size_t most) {
  count = 0;
  const std::size_t room = most + kLanes;
  if (x.size() >= room) return;
  for (auto* v : {&x, &y, &z, &target, &d, &residual, &weight, &wx, &wy, &wz}) v->resize(room);
}

NormalBlock normal_block(const geometry::Ellipsoid& ellipsoid, BlockSamples& samples) {
  NormalBlock block;
  if (samples.count == 0) return block;
  while (samples.count % kLanes != 0) {
    samples.residual[samples.count] = samples.weight[samples.count] = 0.0f;
    samples.add(samples.x.front(), samples.y.front(), samples.z.front(), 0.0f, 0.0f);
  }
  const FloatEllipsoid e(ellipsoid);
  batch_directions(e, {samples.count, samples.x.data(), samples.y.data(), samples.z.data()},
                   samples.wx.data(), samples.wy.data(), samples.wz.data());
  Sums sums{};
  add_up(e, samples, sums);
  int entry = 0;
  for (int a = 0; a < kUnknowns; ++a) {
    block.jtr[a] = total(sums.vector[a]);
    for (int b = 0; b <= a; ++b, ++entry) block.jtj(a, b) = block.jtj(b, a) = total(sums.matrix[entry]);
  }
  return block;
}

}  // namespace bodice::fitting
