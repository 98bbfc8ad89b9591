#include <bodice/synth/garment.hpp>

#include <algorithm>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include <bodice/engine/catch_canceled.hpp>
#include <bodice/engine/message.hpp>

#include "garment/keep_ease.hpp"

namespace bodice::inline v0_1::synth {
namespace {

engine::Result<Cut> cut_garment(const Fitting& fitting) {
  switch (fitting.options.kind) {
    case GarmentKind::kSkirt:
      return cut_skirt(fitting);
    case GarmentKind::kTube:
      return cut_tube(fitting);
    case GarmentKind::kTunic:
      return cut_tunic(fitting);
    case GarmentKind::kPoncho:
      return cut_poncho(fitting);
  }
  return engine::Error{engine::ErrorCode::kInvalidArgument,
                       "The kind of the garment is no value of GarmentKind.", "Give one of its values."};
}

constexpr double kGreatestStretch = 10.0;  // in edge lengths: longer edges go around a limb

bool is_torn(const Cut& cut, double edge_length_m) {
  const auto& p = cut.mesh.positions;
  const double most = kGreatestStretch * edge_length_m;
  return std::any_of(cut.mesh.triangles.begin(), cut.mesh.triangles.end(), [&](const geometry::Triangle& t) {
    return std::max({(p[t[0]] - p[t[1]]).norm(), (p[t[1]] - p[t[2]]).norm(), (p[t[2]] - p[t[0]]).norm()}) >
           most;
  });
}

/// Winds the cut away from the trunk's axis, or upward for a flat sheet.
void face_outward(Cut& cut) {
  double facing = 0.0;
  for (const geometry::Triangle& t : cut.mesh.triangles) {
    const Vec3 n = (cut.mesh.positions[t[1]] - cut.mesh.positions[t[0]])
                       .cross(cut.mesh.positions[t[2]] - cut.mesh.positions[t[0]]);
    const Vec3 out = cut.outward[t[0]];
    facing += n.dot(out) != 0.0 ? n.dot(out) : n.y();
  }
  if (facing < 0.0)
    for (geometry::Triangle& t : cut.mesh.triangles) std::swap(t[1], t[2]);
}

std::optional<engine::Error> check(const SegmentedBody& body, const GarmentOptions& o) {
  const double edge = o.edge_length_m / body.stature_m, ease = o.ease_m / body.stature_m;
  if (edge >= 1e-3 && edge <= 0.1 && ease >= 0.0 && ease <= 0.05) return std::nullopt;
  return engine::Error{engine::ErrorCode::kInvalidArgument,
                       engine::message("An edge of ", o.edge_length_m, " m with an ease of ", o.ease_m,
                                       " m does not suit a body of ", body.stature_m, " m."),
                       "Use edges of 0.001 to 0.1 and an ease of 0 to 0.05 of the stature."};
}

engine::Result<Garment> make(const engine::Context& context, const SegmentedBody& body,
                             const GarmentOptions& options) {
  const auto leaning = trunk_frame(body);
  if (!leaning) return leaning.error();
  if (const auto error = check(body, options)) return *error;
  const TrunkFrame frame = upright(body, leaning.value());
  const Fitting fitting{body, options, frame, LocalSkin(body, frame),
                        geometry::MeshDistance(context, body.mesh)};
  auto cut = cut_garment(fitting);
  if (!cut) return cut.error();
  if (!keep_ease(context, fitting, cut.value()))
    return engine::Error{engine::ErrorCode::kUnusableGeometry,
                         "The garment cannot keep its ease from this body.",
                         "Choose a smaller ease, or a pose with the arms away from the trunk."};
  if (is_torn(cut.value(), options.edge_length_m))
    return engine::Error{engine::ErrorCode::kUnusableGeometry,
                         "The garment would be torn between limbs that it would have to cross.",
                         "Choose a pose with the limbs away from the trunk, or another garment."};
  face_outward(cut.value());
  Garment garment{std::move(cut.value().mesh), std::move(cut.value().pinned)};
  for (Vec3& p : garment.mesh.positions) p = fitting.frame.to_world(p);
  return garment;
}

}  // namespace

engine::Result<Garment> make_garment(const engine::Context& context, const SegmentedBody& body,
                                     const GarmentOptions& options) {
  return engine::catch_canceled("The making of the garment", [&] { return make(context, body, options); });
}

}  // namespace bodice::synth
