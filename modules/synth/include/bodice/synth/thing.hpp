// Things that are no person, with their exact distances, for tests of what is fitted without an anatomy.
#pragma once

#include <string_view>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/contour.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/synth/body.hpp>

namespace bodice::inline v0_1::synth {

/// The kind of a made thing.
enum class ThingKind {
  kCube,    ///< half a meter wide
  kChair,   ///< seat, back and four legs, each a closed piece of its own
  kJoined,  ///< the same chair as one skin
  kTorso,   ///< a mannequin's: no head, arms or legs
  kDog,     ///< on four legs, with head and tail
  kHand,    ///< a palm and five fingers
};
/// The number of kinds.
inline constexpr int kThingKindCount = 6;

/// "cube", "chair", ...
std::string_view name(ThingKind kind);

/// A closed thing that stands on y = 0, in meters.
struct Thing {
  geometry::TriMesh mesh;
  /// Signed distance to what the mesh approximates: exact outside, and no deeper than exact inside.
  geometry::DistanceField distance;
};

/// Makes a thing with triangles of about `edge_m`. O(area / edge_m squared).
Thing make_thing(const engine::Context& context, ThingKind kind, double edge_m);

/// The chair for a body that sits at this point, facing +z: ThingKind::kChair, moved there.
geometry::TriMesh make_chair(const geometry::Vec3& seat, double edge_m);

/// The point under the seat of a sitting body: the lowest skin around its pelvis, a little to the front.
geometry::Vec3 seat_of(const Body& body);

}  // namespace bodice::synth
