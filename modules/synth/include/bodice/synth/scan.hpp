// Scans and game files of made bodies, with what such files hold besides a body, for tests and benches.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <bodice/body/landmark.hpp>
#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/frame.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/synth/body.hpp>

namespace bodice::inline v0_1::synth {

/// How a file came about, and what is in it.
enum class ScanKind {
  kBooth,           ///< eight cameras, noise, holes where none sees, debris
  kFewCameras,      ///< three cameras: half of the skin is missing
  kPatches,         ///< a loose patch a camera, each a little displaced
  kClosed,          ///< closed by a smooth surface, with waves
  kFused,           ///< voxels of 10 mm
  kWebbed,          ///< voxels of 18 mm, arms hanging: webs at armpits and crotch
  kFloorJoined,     ///< the feet grown into a floor
  kFloorLoose,      ///< the floor a piece of its own
  kBunAndHem,       ///< a bun of hair and the hem of a shirt
  kLongHair,        ///< hair that hangs down, to the waist at most
  kPhotogrammetry,  ///< many vertices, bad triangles, millimeters, z up
  kPieces,          ///< head, trunk, hands, legs and feet with gaps between them
  kTucked,          ///< the same, each a little inside the next
  kClothes,         ///< head and hands of skin, the rest exists as clothes
  kSeated,          ///< sitting, nothing else
  kChairBeside,     ///< sitting on a chair that is a mesh of its own
  kChairInMesh,     ///< the same in one mesh, not joined
  kChairFused,      ///< body and chair in one skin
  kTwoApart,        ///< two people a meter and more apart
  kTwoClose,        ///< two people side by side
  kTwoFused,        ///< two people in one skin
  kLow,             ///< few vertices
  kNoise,           ///< 1.5 mm of noise along the normals
  kStrongNoise,     ///< 4 mm of it, waves, and a vertex in twenty 10 mm off
};
inline constexpr int kScanKindCount = 24;

/// "booth", "few cameras", ...
std::string_view name(ScanKind kind);

/// A mesh of the file, in the file's unit and axes.
struct ScanMesh {
  std::string name;
  geometry::TriMesh shape;
};

/// The truth about a person in a scan, in meters, y up.
struct ScanPerson {
  geometry::TriMesh body;                 ///< the clean skin in the scanned pose and position
  std::vector<body::Landmark> landmarks;  ///< landmarks of that skin
  double stature_m = 0.0;
};

/// A made scan and the truth about it: `frame` maps the file to it.
struct Scan {
  std::vector<ScanMesh> meshes;
  geometry::Frame frame;
  std::vector<ScanPerson> persons;  ///< one, or two
};

/// Makes a scan of a made body of random build. It is a function of kind and seed. Fails with kCanceled.
/// Cost: seconds.
engine::Result<Scan> make_scan(const engine::Context& context, ScanKind kind, std::uint64_t seed);

/// The bodies of a scan, where they come from elsewhere. They stand on y = 0 around the y axis, facing +z; of
/// each, `mesh`, `part`, `landmarks`, `stature_m` and the joint "pelvis" are used.
struct ScanSubjects {
  Body body;
  Body other;  ///< the second one of two people
};
/// Makes a scan of bodies that are given; their poses must suit the kind. Fails and costs as the other one.
engine::Result<Scan> make_scan(const engine::Context& context, ScanKind kind, std::uint64_t seed,
                               ScanSubjects subjects);

/// Whether people sit in scans of this kind.
bool sits(ScanKind kind);
/// Whether their arms hang.
bool hangs_arms(ScanKind kind);

}  // namespace bodice::synth
