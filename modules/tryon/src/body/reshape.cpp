#include <bodice/tryon/reshape.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/LU>

#include <bodice/binding/bind.hpp>
#include <bodice/engine/catch_canceled.hpp>
#include <bodice/engine/message.hpp>
#include <bodice/fitting/refit.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Vec3;

/// The deviation of the Gaussian by which skin near a joint moves it, in statures.
constexpr double kJointReach = 0.05;

engine::Error bad_shape(std::string what, std::string remedy) {
  return {engine::ErrorCode::kInvalidArgument, std::move(what), std::move(remedy)};
}

double height_of(std::span<const Vec3> positions) {
  geometry::Box box;
  for (const Vec3& p : positions) box.extend(p);
  return box.size().y();
}

/// The mean displacement of the skin around each joint. A joint without skin of its own nearby moves as its
/// parent.
std::vector<Vec3> joint_moves(const SegmentedSkin& skin, std::span<const Vec3> positions) {
  const auto& joints = skin.rig->skeleton.joints;
  const rig::SkinWeights& weights = skin.rig->weights;
  const double reach_m = kJointReach * skin.anatomy.stature_m;
  std::vector<Vec3> move(joints.size(), Vec3::Zero());
  std::vector<double> sum(joints.size(), 0.0);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const Vec3& at = skin.input.skin.positions[v];
    for (std::uint32_t e = weights.first[v]; e < weights.first[v + 1]; ++e) {
      const std::size_t j = weights.joint[e];
      const double far = (at - joints[j].bind.col(3)).norm() / reach_m;
      const double weight = double{weights.weight[e]} * std::exp(-0.5 * far * far);
      move[j] += weight * (positions[v] - at);
      sum[j] += weight;
    }
  }
  constexpr double kNoSkin = 1e-6;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (sum[j] > kNoSkin)
      move[j] /= sum[j];
    else
      move[j] = joints[j].parent < 0 ? Vec3(Vec3::Zero()) : move[static_cast<std::size_t>(joints[j].parent)];
  }
  return move;
}

/// The rig with its joints moved with the skin around them. The directions of joints do not change.
std::shared_ptr<const rig::Rig> reshaped_rig(const SegmentedSkin& skin, std::span<const Vec3> positions) {
  auto rig = std::make_shared<rig::Rig>(*skin.rig);
  const std::vector<Vec3> move = joint_moves(skin, positions);
  for (std::size_t j = 0; j < move.size(); ++j) {
    rig::Joint& joint = rig->skeleton.joints[j];
    joint.bind.col(3) += move[j];
    const auto parent = static_cast<std::size_t>(std::max(0, joint.parent));
    const Vec3 by = joint.parent < 0 ? move[j] : Vec3(move[j] - move[parent]);
    const rig::Affine& frame = skin.rig->skeleton.joints[parent].bind;
    joint.local.translation += joint.parent < 0 ? by : Vec3(frame.leftCols<3>().inverse() * by);
  }
  return rig;
}

std::shared_ptr<SegmentedSkin> reshaped_skin(const engine::Context& context, const SegmentedSkin& skin,
                                             std::span<const Vec3> positions) {
  auto shape = std::make_shared<SegmentedSkin>(skin);
  std::ranges::copy(positions, shape->input.skin.positions.begin());
  shape->distance = std::make_shared<const geometry::MeshDistance>(context, shape->input.skin);
  shape->anatomy.stature_m *= height_of(positions) / height_of(skin.input.skin.positions);
  for (body::Landmark& landmark : shape->anatomy.landmarks) {
    const auto nearest = skin.distance->closest_point(landmark.position);
    if (nearest.triangle == geometry::kNoIndex) continue;
    const geometry::Index v = skin.input.skin.triangles[nearest.triangle][0];
    landmark.position += positions[v] - skin.input.skin.positions[v];
  }
  if (skin.rig) shape->rig = reshaped_rig(skin, positions);
  return shape;
}

/// Tables that a refit reads without a change of direction.
class UnchangedTables final : public fitting::PosedTables {
 public:
  proxy::TableReading read(std::uint32_t, const Vec3& direction) const override {
    return {.direction = direction};
  }
  bool is_free(std::uint32_t) const override { return true; }
};

engine::Result<proxy::BodyProxy> reshaped_proxy(const engine::Context& context, const SegmentedSkin& before,
                                                const proxy::BodyProxy& proxy, const SegmentedSkin& shape) {
  const double scale = shape.anatomy.stature_m / before.anatomy.stature_m;
  proxy::BodyProxy::Data data = proxy.data();
  data.stature_m *= scale;
  data.margin_m *= scale;
  data.binding = nullptr;
  const std::vector<geometry::Ellipsoid> shapes =
      fitting::carry_ellipsoids(context, proxy.ellipsoids(), before.input.skin.positions, labeled(shape));
  for (std::size_t k = 0; k < shapes.size(); ++k) data.ellipsoids[k].shape = shapes[k];
  if (!proxy.relief().empty()) {
    auto tables = fitting::refit_tables(context, labeled(shape), {proxy, shapes, UnchangedTables(), scale});
    if (!tables) return std::move(tables).error();
    data.relief = std::move(tables->relief);
    data.texels = std::move(tables->texels);
  }
  auto made = proxy::BodyProxy::make(std::move(data));
  if (!made || !proxy.binding() || !shape.rig) return made;
  return binding::bind(context, *made,
                       {shape.input.skin, shape.rig->skeleton, shape.rig->weights, shape.anatomy.part});
}

}  // namespace

engine::Result<void> check_shape(const SegmentedSkin& skin, std::span<const Vec3> positions) {
  const std::size_t vertices = skin.input.skin.positions.size();
  if (positions.size() != vertices)
    return bad_shape(
        engine::message("The shape has ", positions.size(), " vertices, but the skin has ", vertices, "."),
        "Give the same vertices at other positions.");
  for (std::size_t v = 0; v < vertices; ++v)
    if (!positions[v].allFinite())
      return bad_shape(engine::message("Vertex ", v, " of the shape is not finite."),
                       "Give positions in meters.");
  return {};
}

engine::Result<ReshapedBody> reshape_body(const engine::Context& context, const SegmentedSkin& skin,
                                          const proxy::BodyProxy& proxy, std::span<const Vec3> positions) {
  if (auto good = check_shape(skin, positions); !good) return std::move(good).error();
  if (!(height_of(positions) > 0.0))
    return engine::Error{engine::ErrorCode::kUnusableGeometry, "The shape has no height.",
                         "Give the positions of a standing body, y up."};
  return engine::catch_canceled("The new shape", [&]() -> engine::Result<ReshapedBody> {
    std::shared_ptr<const SegmentedSkin> shape = reshaped_skin(context, skin, positions);
    auto carried = reshaped_proxy(context, skin, proxy, *shape);
    if (!carried) return std::move(carried).error();
    return ReshapedBody{std::move(shape), std::move(carried).value()};
  });
}

}  // namespace bodice::tryon
