#include <bodice/binding/table_warp.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <bodice/engine/parallel.hpp>
#include <bodice/proxy/posed_proxy.hpp>

#include "bind/texel_directions.hpp"
#include "pose/carried_ellipsoid.hpp"
#include "pose/followed_table.hpp"
#include "pose/joint_motion.hpp"
#include "pose/refusal.hpp"
#include "pose/skin_changes.hpp"
#include "pose/yield.hpp"

namespace bodice::inline v0_1::binding {
namespace {

/// A value of a table's nodes at a direction.
template <class Value, class Of>
Value bilinear(const proxy::TableStencil& at, const Value& zero, Of of) {
  Value sum = zero;
  for (std::size_t i = 0; i < 4; ++i) sum += at.weight[i] * of(at.node[i]);
  return sum;
}

}  // namespace

struct TableWarp::Impl {
  explicit Impl(const proxy::BodyProxy& proxy) : bound(proxy), joints(*bound.binding()) {}

  void carry_one(std::size_t k);
  /// shift(w) = change(V w - change(V w)) at the directions of a table half as fine.
  void find_shifts(std::size_t k);
  Eigen::Vector4d change(std::size_t k, const proxy::TableStencil& at) const {
    return bilinear(at, Eigen::Vector4d(Eigen::Vector4d::Zero()), [&](std::uint32_t node) {
      const Change& c = changes[k][node];
      return Eigen::Vector4d(c[0], c[1], c[2], c[3]);
    });
  }

  proxy::BodyProxy bound;
  JointMotion joints;
  std::vector<CarriedEllipsoid> carried;            // #E
  std::vector<geometry::Ellipsoid> shapes;          // #E
  std::vector<std::vector<Change>> changes;         // #E: a table's texels; empty where it does not follow
  std::vector<std::vector<geometry::Vec3>> shifts;  // #E: of a table half as fine
};

void TableWarp::Impl::carry_one(std::size_t k) {
  const proxy::Binding& binding = *bound.binding();
  const geometry::Ellipsoid& rest = bound.ellipsoids()[k].shape;
  const std::size_t first = binding.first_term[k];
  const auto terms = std::span(binding.terms).subspan(first, binding.first_term[k + 1] - first);
  const proxy::JointMatrix map = unfolded(affine_map(terms, joints.skinning()), rest.center, joints.scale());
  const bool follows = binding.first_bundle[k] < binding.first_bundle[k + 1];
  carried[k] = follows ? carry(rest, map) : carry_stiffly(rest, map);
  shapes[k] = carried[k].shape;
  if (!follows) return;
  const std::size_t n = bound.relief()[k].nodes_per_side;
  changes[k].resize(n * n);
  std::vector<float> maps(12 * terms.size());
  posed_maps(rest.center, double{binding.step_m[k]}, terms, joints.skinning(), carried[k], maps);
  find_changes(binding, k, carried[k], maps.data(), changes[k].data());
  const std::uint16_t* const followers = binding.followers.data() + binding.first_follower[k];
  for (std::size_t i = 0; i < n * n; ++i) changes[k][i] = changes[k][followers[i]];
  find_shifts(k);
}

void TableWarp::Impl::find_shifts(std::size_t k) {
  const int n = bound.relief()[k].nodes_per_side, m = shift_nodes(n);
  for (int i = 0; i < m * m; ++i) {
    const geometry::Vec3 target = carried[k].to_table * texel_direction(i, m);
    const geometry::Vec3 first = target - change(k, proxy::table_stencil(target, n)).head<3>();
    shifts[k].push_back(change(k, proxy::table_stencil(first, n)).head<3>());
  }
}

TableWarp::TableWarp(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TableWarp::~TableWarp() = default;
TableWarp::TableWarp(TableWarp&&) noexcept = default;
TableWarp& TableWarp::operator=(TableWarp&&) noexcept = default;

engine::Result<TableWarp> TableWarp::make(const engine::Context& context, const proxy::BodyProxy& bound,
                                          std::span<const proxy::JointMatrix> world) {
  if (auto fit = check_bound(bound); !fit) return std::move(fit).error();
  if (auto fit = check_joints(bound, world.size()); !fit) return std::move(fit).error();
  auto impl = std::make_unique<Impl>(bound);
  if (const auto refusal = impl->joints.take(world))
    return refused_joint(bound.binding()->joint_names[refusal->joint], refusal->reason);
  impl->carried.resize(bound.ellipsoids().size());
  impl->shapes.resize(impl->carried.size());
  impl->changes.resize(impl->carried.size());
  impl->shifts.resize(impl->carried.size());
  engine::parallel_for(context, impl->carried.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) impl->carry_one(k);
  });
  return TableWarp(std::move(impl));
}

std::span<const geometry::Ellipsoid> TableWarp::shapes() const noexcept {
  return impl_->shapes;
}

double TableWarp::scale() const noexcept {
  return impl_->joints.scale();
}

bool TableWarp::follows(std::uint32_t ellipsoid) const noexcept {
  return !impl_->changes[ellipsoid].empty();
}

proxy::TableReading TableWarp::read(std::uint32_t ellipsoid, const geometry::Vec3& direction) const {
  const proxy::Binding& binding = *impl_->bound.binding();
  const CarriedEllipsoid& carried = impl_->carried[ellipsoid];
  const proxy::ReliefTable& table = impl_->bound.relief()[ellipsoid];
  const int n = table.nodes_per_side;
  proxy::TableReading reading;
  reading.scale = carried.scale;
  const bool moves = follows(ellipsoid);
  const geometry::Vec3 target = moves ? geometry::Vec3(carried.to_table * direction) : direction;
  reading.direction = target;
  const geometry::Vec3 zero = geometry::Vec3::Zero();
  if (moves)
    reading.direction -= bilinear(proxy::table_stencil(direction, shift_nodes(n)), zero,
                                  [&](std::uint32_t node) { return impl_->shifts[ellipsoid][node]; });
  const proxy::TableStencil at = proxy::table_stencil(reading.direction, n);
  if (moves) reading.growth_m = impl_->change(ellipsoid, at)[3];
  const double depth = bilinear(
      at, 0.0, [&](std::uint32_t node) { return double{1.0} * binding.burial[table.first_texel + node]; });
  const double step_m = proxy::kBurialWeight * double{binding.burial_step_m} * impl_->joints.scale();
  reading.burial_m = step_m * depth;
  if (moves) {
    const YieldRule rule = yield_rule(proxy::relief_reach(impl_->bound.stature_m()).out_m, carried.scale);
    const double yield = double{yield_m(rule, static_cast<float>(reading.growth_m))};
    reading.burial_m = std::min(reading.burial_m + yield, 255.0 * step_m);
  }
  return reading;
}

}  // namespace bodice::binding
