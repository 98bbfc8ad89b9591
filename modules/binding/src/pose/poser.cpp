#include <bodice/binding/poser.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <bodice/engine/parallel.hpp>

#include "pose/base_mix.hpp"
#include "pose/carried_ellipsoid.hpp"
#include "pose/followed_table.hpp"
#include "pose/joint_motion.hpp"
#include "pose/refusal.hpp"
#include "pose/skin_changes.hpp"
#include "tolerances.hpp"

namespace bodice::inline v0_1::binding {
namespace {

using proxy::JointMatrix;

/// Ellipsoids of one task: few, since their tables differ in size.
constexpr std::size_t kEllipsoidGrain = 4;

bool overlap(const geometry::Box& a, const geometry::Box& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

/// Whether the joints of some terms move an ellipsoid as one, so that its table is that of rest.
bool move_alike(const geometry::Ellipsoid& rest, std::span<const proxy::CarryTerm> terms,
                std::span<const JointMatrix> skinning) {
  const JointMatrix& main = skinning[terms.front().joint];
  const double longest_m = rest.radii.maxCoeff();
  double most_m = 0.0;
  for (const proxy::CarryTerm& term : terms.subspan(1)) {
    const JointMatrix other = skinning[term.joint] - main;
    const geometry::Vec3 at_center = other.leftCols<3>() * rest.center + other.col(3);
    most_m = std::max(most_m, at_center.norm() + longest_m * other.leftCols<3>().norm());
  }
  return most_m < kAlike_m * main.col(0).norm();
}

bool reached(const geometry::Ellipsoid& shape, const PoseOptions& options) {
  if (!options.within) return true;
  const geometry::Box box = geometry::bounding_box(shape);
  return std::ranges::any_of(*options.within,
                             [&](const geometry::Box& other) { return overlap(box, other); });
}

}  // namespace

struct Poser::Impl {
  explicit Impl(proxy::BodyProxy proxy);

  bool follows(std::size_t k) const { return binding.first_bundle[k] < binding.first_bundle[k + 1]; }
  std::span<const proxy::CarryTerm> terms_of(std::size_t k) const {
    return std::span(binding.terms)
        .subspan(binding.first_term[k], binding.first_term[k + 1] - binding.first_term[k]);
  }
  bool find_all_follow_nodes(std::size_t k) const;
  void pose_ellipsoid(std::size_t k, const PoseOptions& options, TableScratch& scratch,
                      proxy::PosedProxy& posed);
  void write_table(std::size_t k, const CarriedEllipsoid& carried, TableScratch& scratch,
                   proxy::PosedProxy& posed);
  engine::Result<void> add(std::shared_ptr<const proxy::BasePose> base, int blended, bool stays);
  void pose_all(const engine::Context& context, const PoseOptions& options);

  proxy::BodyProxy bound;
  const proxy::Binding& binding;
  JointMotion joints;
  BaseMix bases;
  std::array<proxy::PosedProxy, 2> pose;
  /// Whether a pose's table differs from the one at rest in more than scale, #E each.
  std::array<std::vector<std::uint8_t>, 2> changed;
  std::size_t current = 0;
  std::uint64_t poses = 0;
  std::vector<std::uint8_t> all_follow_nodes;  ///< #E: whether every texel follows a skin node
  std::vector<float> maps;                     ///< 12 for each term
  std::vector<TableScratch> scratch;           ///< one a task
  std::vector<JointMatrix> from_floats;
};

Poser::Impl::Impl(proxy::BodyProxy proxy)
    : bound(std::move(proxy)), binding(*bound.binding()), joints(binding), bases(bound) {
  maps.resize(12 * binding.terms.size());
  from_floats.resize(binding.bind.size());
  proxy::PosedProxy rest;
  int most = 0;
  for (std::size_t k = 0; k < bound.ellipsoids().size(); ++k) {
    rest.shapes.push_back(bound.ellipsoids()[k].shape);
    rest.material.push_back(rest.shapes[k].axes * rest.shapes[k].radii.asDiagonal());
    if (bound.relief().empty()) continue;
    if (follows(k)) most = std::max(most, int{bound.relief()[k].nodes_per_side});
  }
  rest.relief.assign(bound.relief().begin(), bound.relief().end());
  rest.texels.assign(bound.texels().begin(), bound.texels().end());
  rest.burial = binding.burial;
  rest.burial_step_m = binding.burial_step_m;
  pose.fill(rest);
  for (std::size_t k = 0; k < pose[0].shapes.size(); ++k)
    all_follow_nodes.push_back(find_all_follow_nodes(k));
  for (auto& flags : changed) flags.assign(bound.ellipsoids().size(), 0);
  TableScratch one;
  one.reserve(most);
  one.values.resize(1);
  scratch.assign((bound.ellipsoids().size() + kEllipsoidGrain - 1) / kEllipsoidGrain, one);
}

bool Poser::Impl::find_all_follow_nodes(std::size_t k) const {
  if (!follows(k)) return false;
  const std::size_t n = bound.relief()[k].nodes_per_side;
  std::vector<std::uint8_t> is_node(n * n, 0);
  for (std::size_t b = binding.first_bundle[k]; b < binding.first_bundle[k + 1]; ++b)
    for (const std::uint16_t texel : binding.bundles[b].texel) is_node[texel] = 1;
  const auto followers = std::span(binding.followers).subspan(binding.first_follower[k], n * n);
  return std::ranges::all_of(followers, [&](std::uint16_t texel) { return is_node[texel] != 0; });
}

void Poser::Impl::write_table(std::size_t k, const CarriedEllipsoid& carried, TableScratch& room,
                              proxy::PosedProxy& posed) {
  const proxy::ReliefTable& table = bound.relief()[k];
  room.values.clear();
  room.values.push_back({&table, bound.texels().data() + table.first_texel, 1.0f});
  for (std::size_t b = 0; b < bases.size(); ++b) {
    room.values.front().share = bases.share_of_rest(k);
    const proxy::BasePose& base = bases.base(b);
    if (bases.share(k, b) > 0.0f)
      room.values.push_back({&base.relief[k], base.texels.data() + table.first_texel, bases.share(k, b)});
  }
  const RestTable rest{table, room.values, binding.burial.data() + table.first_texel,
                       binding.followers.data() + binding.first_follower[k]};
  const std::size_t count = std::size_t{table.nodes_per_side} * table.nodes_per_side;
  if (!all_follow_nodes[k]) std::fill_n(room.changes.begin(), count, Change{});
  const auto terms = terms_of(k);
  const std::span own = std::span(maps).subspan(12 * std::size_t{binding.first_term[k]}, 12 * terms.size());
  posed_maps(bound.ellipsoids()[k].shape.center, double{binding.step_m[k]}, terms, joints.skinning(), carried,
             own);
  find_changes(binding, k, carried, own.data(), room.changes.data());
  follow(rest, carried, {proxy::relief_reach(bound.stature_m()).out_m, double{posed.burial_step_m}}, room,
         {posed.relief[k], posed.texels.data() + table.first_texel, posed.burial.data() + table.first_texel});
}

engine::Result<void> Poser::Impl::add(std::shared_ptr<const proxy::BasePose> base, int blended, bool stays) {
  if (auto fit = proxy::check_base(bound, *base); !fit) return fit;
  bases.add(std::move(base), blended, stays);
  for (TableScratch& room : scratch) room.values.reserve(bases.size() + 1);  // frames allocate nothing
  return {};
}

void Poser::Impl::pose_ellipsoid(std::size_t k, const PoseOptions& options, TableScratch& room,
                                 proxy::PosedProxy& posed) {
  const geometry::Ellipsoid& rest = bound.ellipsoids()[k].shape;
  const auto terms = terms_of(k);
  const JointMatrix map = unfolded(affine_map(terms, joints.skinning()), rest.center, joints.scale());
  bool tables = options.tables && follows(k) && !move_alike(rest, terms, joints.skinning());
  CarriedEllipsoid carried = tables ? carry(rest, map) : carry_stiffly(rest, map);
  if (tables && !reached(carried.shape, options)) {
    tables = false;
    carried = carry_stiffly(rest, map);
  }
  posed.shapes[k] = carried.shape;
  posed.material[k] = carried.shape.axes * carried.shape.radii.asDiagonal() * carried.to_table.transpose();
  if (k < options.offsets.size())
    displace(options.offsets[k], options.offset_share, posed.shapes[k], posed.material[k]);
  if (bound.relief().empty()) return;
  const proxy::ReliefTable& table = bound.relief()[k];
  const std::size_t back = 1 - current;
  if (tables) {
    write_table(k, carried, room, posed);
    changed[back][k] = 1;
    return;
  }
  const std::size_t count = std::size_t{table.nodes_per_side} * table.nodes_per_side;
  if (changed[back][k]) {
    std::copy_n(bound.texels().begin() + table.first_texel, count, posed.texels.begin() + table.first_texel);
    std::copy_n(binding.burial.begin() + table.first_texel, count, posed.burial.begin() + table.first_texel);
    changed[back][k] = 0;
  }
  const auto scale = static_cast<float>(carried.scale);
  posed.relief[k] = table;
  for (float* length : {&posed.relief[k].h_scale_m, &posed.relief[k].h_offset_m, &posed.relief[k].a_scale,
                        &posed.relief[k].a_offset})
    *length *= scale;
}

void Poser::Impl::pose_all(const engine::Context& context, const PoseOptions& options) {
  proxy::PosedProxy& posed = pose[1 - current];
  posed.scale = joints.scale();
  posed.burial_step_m = static_cast<float>(double{binding.burial_step_m} * posed.scale);
  engine::parallel_for(context, posed.shapes.size(), kEllipsoidGrain,
                       [&](std::size_t begin, std::size_t end) {
                         for (std::size_t k = begin; k < end; ++k)
                           pose_ellipsoid(k, options, scratch[begin / kEllipsoidGrain], posed);
                       });
  current = 1 - current;
  ++poses;
}

Poser::Poser(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Poser::~Poser() = default;
Poser::Poser(Poser&&) noexcept = default;
Poser& Poser::operator=(Poser&&) noexcept = default;

engine::Result<Poser> Poser::make(const proxy::BodyProxy& bound) {
  if (auto fit = check_bound(bound); !fit) return std::move(fit).error();
  return Poser(std::make_unique<Impl>(bound));
}

std::size_t Poser::joints() const noexcept {
  return impl_->binding.bind.size();
}

engine::Result<void> Poser::pose(const engine::Context& context, std::span<const JointMatrix> world,
                                 const PoseOptions& options) {
  if (auto fit = check_joints(impl_->bound, world.size()); !fit) return fit;
  if (const std::optional<Refusal> refusal = impl_->joints.take(world))
    return refused_joint(impl_->binding.joint_names[refusal->joint], refusal->reason);
  impl_->bases.find(impl_->joints.skinning());
  impl_->pose_all(context, options);
  return {};
}

engine::Result<void> Poser::pose(const engine::Context& context, std::span<const float> world,
                                 std::size_t stride, const PoseOptions& options) {
  const std::size_t count = joints();
  if (stride < 12 || (count > 0 && world.size() < (count - 1) * stride + 12))
    return engine::Error{engine::ErrorCode::kInvalidArgument,
                         "Pose: the floats do not hold " + std::to_string(count) + " matrices of 3 x 4.",
                         "Give 12 floats a joint, and a stride of at least 12."};
  for (std::size_t j = 0; j < count; ++j)
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column)
        impl_->from_floats[j](row, column) =
            double{world[j * stride + static_cast<std::size_t>(4 * row + column)]};
  return pose(context, impl_->from_floats, options);
}

engine::Result<void> Poser::add_base(std::shared_ptr<const proxy::BasePose> base, int poses) {
  return impl_->add(std::move(base), poses, false);
}

engine::Result<void> Poser::keep_base(std::shared_ptr<const proxy::BasePose> base) {
  return impl_->add(std::move(base), 0, true);
}

double Poser::departure_rad(std::span<const JointMatrix> world) noexcept {
  return world.size() == joints() ? impl_->bases.departure(world) : 0.0;
}

const proxy::PosedProxy& Poser::posed() const noexcept {
  return impl_->pose[impl_->current];
}

const proxy::PosedProxy& Poser::previous() const noexcept {
  return impl_->pose[1 - impl_->current];
}

const proxy::BodyProxy& Poser::bound() const noexcept {
  return impl_->bound;
}

std::uint64_t Poser::poses() const noexcept {
  return impl_->poses;
}

}  // namespace bodice::binding
