#include <bodice/synth/garment.hpp>

#include <algorithm>
#include <optional>
#include <sstream>
#include <utility>

#include <Eigen/Geometry>

#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/mesh_distance.hpp>

#include "tailor.hpp"

namespace bodice::synth {
namespace {

constexpr int kPushes = 24;          // each gains what is missing; slanted skin needs several
constexpr double kLeastPush = 2e-4;  // of stature: ends a slow approach along slanted skin
constexpr double kGenerous = 1.3;    // a push of just the missing distance would end a little short

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
  return engine::Error{engine::ErrorCode::kInvalidArgument, "There is no such garment.",
                       "Use a GarmentKind."};
}

/// Moves vertices outward until all keep the ease; false if some cannot.
bool clear_skin(const engine::Context& context, const Fitting& fitting, Cut& cut) {
  const geometry::MeshDistance skin(context, fitting.body.mesh);
  std::vector<char> clear(cut.mesh.positions.size(), 0);
  engine::parallel_for(context, clear.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      for (int push = 0; push < kPushes && !clear[v]; ++push) {
        Vec3& p = cut.mesh.positions[v];
        const double missing = fitting.options.ease_m - skin.signed_distance(fitting.frame.to_world(p));
        clear[v] = missing <= 0.0;
        if (!clear[v]) p += (kGenerous * missing + kLeastPush * fitting.body.stature_m) * cut.outward[v];
      }
  });
  const auto& t = cut.mesh.triangles;
  std::vector<char> outside(t.size(), 0);  // a triangle may still cut what its corners avoid
  engine::parallel_for(context, t.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 middle = (cut.mesh.corner(i, 0) + cut.mesh.corner(i, 1) + cut.mesh.corner(i, 2)) / 3.0;
      outside[i] = skin.signed_distance(fitting.frame.to_world(middle)) > 0.0;
    }
  });
  const auto holds = [](char c) { return c != 0; };
  return std::all_of(clear.begin(), clear.end(), holds) && std::all_of(outside.begin(), outside.end(), holds);
}

/// Winding that faces away from the trunk's axis, or up for a flat sheet.
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
  std::ostringstream sentence;
  sentence << "An edge of " << o.edge_length_m << " m with an ease of " << o.ease_m
           << " m does not suit a body of " << body.stature_m << " m.";
  return engine::Error{engine::ErrorCode::kInvalidArgument, sentence.str(),
                       "Use edges of 0.001 to 0.1 and an ease of 0 to 0.05 of the stature."};
}

}  // namespace

engine::Result<Garment> make_garment(const engine::Context& context, const SegmentedBody& body,
                                     const GarmentOptions& options) {
  try {
    const auto frame = trunk_frame(body);
    if (!frame) return frame.error();
    if (const auto error = check(body, options)) return *error;
    const Fitting fitting{body, options, frame.value(), LocalSkin(body, frame.value())};
    auto cut = cut_garment(fitting);
    if (!cut) return cut.error();
    if (!clear_skin(context, fitting, cut.value()))
      return engine::Error{engine::ErrorCode::kUnusableGeometry,
                           "The garment cannot keep its ease from this body.",
                           "Choose a smaller ease, or a pose with the arms away from the trunk."};
    face_outward(cut.value());
    Garment garment{std::move(cut.value().mesh), std::move(cut.value().pinned)};
    for (Vec3& p : garment.mesh.positions) p = fitting.frame.to_world(p);
    return garment;
  } catch (const engine::Cancelled&) {
    return engine::Error{engine::ErrorCode::kCancelled, "The making of the garment was cancelled.", ""};
  }
}

}  // namespace bodice::synth
