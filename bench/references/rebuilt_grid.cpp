#include <algorithm>
#include <array>
#include <cmath>

#include <bench_references/moving_peers.hpp>
#include <bench_references/skin_signs.hpp>

namespace bench {
namespace {

using bodice::geometry::Index;
using bodice::geometry::kNoIndex;
using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;

constexpr double kBand_m = 0.05;

/// Distances near the skin: nodes beside a triangle first, then from node to node the neighbors' triangles,
/// as far as the band. The sign of all other nodes follows from the last one in the band along each row.
class RebuiltGrid final : public MovingPeer {
 public:
  RebuiltGrid(const TriMesh& rest, double cell_m) : signs_(rest), cell_m_(cell_m) {}

  std::string name() const override {
    return "distance grid, " + std::to_string(std::lround(1e3 * cell_m_)) + " mm, rebuilt";
  }
  bool needs_skin() const override { return true; }
  double bytes() const override {
    return static_cast<double>(value_.capacity() * sizeof(float) + nearest_.capacity() * sizeof(Index)) +
           signs_.bytes();
  }

  void pose(const MovingFrame& frame) override {
    skin_ = &frame.skin;
    signs_.update(frame.skin);
    resize();
    for (std::size_t t = 0; t < frame.skin.triangles.size(); ++t) seed(static_cast<Index>(t));
    for (std::size_t i = 0; i < front_.size(); ++i) spread(front_[i]);  // the front grows meanwhile
    for (const std::size_t at : front_) give_sign(at);
    fill_rows();
  }

  void query(const Cloud& cloud, std::span<float> distance_m) override {
    for (std::size_t i = 0; i < cloud.size(); ++i) distance_m[i] = sample(cloud.x[i], cloud.y[i], cloud.z[i]);
  }

 private:
  void resize() {
    const bodice::geometry::Box box = bodice::geometry::bounding_box(skin_->positions);
    low_ = box.low - Vec3::Constant(kBand_m);
    for (int axis = 0; axis < 3; ++axis)
      n_[static_cast<std::size_t>(axis)] = static_cast<int>((box.size()[axis] + 2.0 * kBand_m) / cell_m_) + 2;
    const std::size_t total =
        static_cast<std::size_t>(n_[0]) * static_cast<std::size_t>(n_[1]) * static_cast<std::size_t>(n_[2]);
    value_.assign(total, static_cast<float>(kBand_m));
    nearest_.assign(total, kNoIndex);
    front_.clear();
  }
  std::size_t at(int i, int j, int k) const { return static_cast<std::size_t>((k * n_[1] + j) * n_[0] + i); }
  std::array<int, 3> node(std::size_t at) const {
    const int row = static_cast<int>(at) / n_[0];
    return {static_cast<int>(at) % n_[0], row % n_[1], row / n_[1]};
  }
  Vec3 point(const std::array<int, 3>& n) const { return low_ + cell_m_ * Vec3(n[0], n[1], n[2]); }
  bodice::geometry::TrianglePoint closest(Index t, const Vec3& p) const {
    return bodice::geometry::closest_point(skin_->corner(t, 0), skin_->corner(t, 1), skin_->corner(t, 2), p);
  }

  void offer(std::size_t node_at, const Vec3& p, Index t) {
    const auto d = static_cast<float>((closest(t, p).point - p).norm());
    if (d >= value_[node_at]) return;
    if (nearest_[node_at] == kNoIndex) front_.push_back(node_at);
    value_[node_at] = d;
    nearest_[node_at] = t;
  }

  /// Offers a triangle to the nodes of the cells that its box touches.
  void seed(Index t) {
    const Vec3 a = skin_->corner(t, 0), b = skin_->corner(t, 1), c = skin_->corner(t, 2);
    const Vec3 low = (a.cwiseMin(b).cwiseMin(c) - low_) / cell_m_,
               high = (a.cwiseMax(b).cwiseMax(c) - low_) / cell_m_;
    for (int k = static_cast<int>(low.z()); k <= static_cast<int>(high.z()) + 1; ++k)
      for (int j = static_cast<int>(low.y()); j <= static_cast<int>(high.y()) + 1; ++j)
        for (int i = static_cast<int>(low.x()); i <= static_cast<int>(high.x()) + 1; ++i)
          offer(at(i, j, k), point({i, j, k}), t);
  }

  void spread(std::size_t from) {
    const Index t = nearest_[from];
    const std::array<int, 3> n = node(from);
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        std::array<int, 3> next = n;
        next[axis] += step;
        if (next[axis] < 0 || next[axis] >= n_[axis]) continue;
        const std::size_t to = at(next[0], next[1], next[2]);
        if (nearest_[to] != t) offer(to, point(next), t);
      }
  }

  void give_sign(std::size_t node_at) {
    const Vec3 p = point(node(node_at));
    const Index t = nearest_[node_at];
    if (signs_.is_inside(*skin_, t, closest(t, p), p)) value_[node_at] = -value_[node_at];
  }

  void fill_rows() {
    for (std::size_t row = 0; row < value_.size(); row += static_cast<std::size_t>(n_[0])) {
      float side = 1.0f;
      for (std::size_t i = row; i < row + static_cast<std::size_t>(n_[0]); ++i)
        if (nearest_[i] != kNoIndex)
          side = value_[i] < 0.0f ? -1.0f : 1.0f;
        else
          value_[i] = side * static_cast<float>(kBand_m);
    }
  }

  float sample(float x, float y, float z) const {
    std::array<int, 3> n;
    std::array<float, 3> share;
    const std::array<float, 3> p = {x, y, z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto from = static_cast<float>(low_[static_cast<int>(axis)]);
      const float u = std::clamp((p[axis] - from) / static_cast<float>(cell_m_), 0.0f,
                                 static_cast<float>(n_[axis]) - 1.001f);
      n[axis] = static_cast<int>(u);
      share[axis] = u - static_cast<float>(n[axis]);
    }
    const auto row = [&](int dj, int dk) {
      const float* left = &value_[at(n[0], n[1] + dj, n[2] + dk)];
      return left[0] + share[0] * (left[1] - left[0]);
    };
    const float front = row(0, 0) + share[1] * (row(1, 0) - row(0, 0));
    const float back = row(0, 1) + share[1] * (row(1, 1) - row(0, 1));
    return front + share[2] * (back - front);
  }

  SkinSigns signs_;
  double cell_m_;
  const TriMesh* skin_ = nullptr;
  Vec3 low_ = Vec3::Zero();
  std::array<int, 3> n_ = {};
  std::vector<float> value_;
  std::vector<Index> nearest_;      // kNoIndex beyond the band
  std::vector<std::size_t> front_;  // nodes in the band, in the order in which they were reached
};

}  // namespace

std::unique_ptr<MovingPeer> rebuilt_grid(const TriMesh& rest, double cell_m) {
  return std::make_unique<RebuiltGrid>(rest, cell_m);
}

}  // namespace bench
