// Human bodies made from numbers, with known landmarks, joints and parts, for tests, benches and the built-in
// example.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <bodice/body/landmark.hpp>
#include <bodice/body/measurement.hpp>
#include <bodice/body/part.hpp>
#include <bodice/body/proportions.hpp>
#include <bodice/engine/context.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/rig/skeleton.hpp>
#include <bodice/rig/skinning.hpp>

namespace bodice::inline v0_1::synth {

/// The pose of a made body; kRandom depends on the seed.
enum class Pose {
  kA,
  kT,
  kArmsDown,
  kArmsUp,
  kStride,
  kSit,
  kSquat,
  kRun,
  kKick,
  kLying,
  kHandstand,
  kRandom
};

/// The numbers that a body is made from.
struct BodyOptions {
  body::Sex sex = body::Sex::kFemale;
  double stature_m = 1.68;
  double mass_kg = 62.0;  ///< kilograms; determines the girths
  Pose pose = Pose::kA;
  std::optional<body::ProportionProfile> profile;  ///< absent: "ansur2"
  int vertices = 8850;                             ///< requested number; the mesh has it within 10 %
  std::uint64_t seed = 0;  ///< 0: the average body; others vary within the spread of the survey
  double childhood = 0.0;  ///< from 0 (adult) to 1 (two years old, with a large head and short limbs)
  bool pregnant = false;   ///< as near term
};

/// A joint of a made body.
struct Joint {
  std::string name;         ///< "elbow_l", "knee_r", "neck", ...
  geometry::Vec3 position;  ///< meters
};

/// A made body: a closed surface of one component and genus 0, and the truth about it.
struct Body {
  geometry::TriMesh mesh;        ///< meters, y up, facing +z, the body's left at +x
  std::vector<body::Part> part;  ///< #V
  std::vector<Joint> joints;
  std::vector<body::Landmark> landmarks;  ///< all of LandmarkId, confidence 1
  body::Measurements measurements;        ///< of the standing body; arm_pose_angle as it is
  double stature_m = 0.0;                 ///< of the standing body, whatever the pose
  /// The joints of body::JointId but the middle of the spine, and those of fingers and thumbs, in their own
  /// frames (body/joint.hpp). The bind pose is the mesh as it is.
  rig::Skeleton skeleton;
  rig::SkinWeights weights;  ///< #V
};

/// Makes a body. The result is a function of the options. Fails with kInvalidArgument outside stature .4..2.6
/// m, BMI 10..70 and childhood 0..1, and with kCanceled. Cost: below a second for 8,850 vertices.
engine::Result<Body> make_body(const engine::Context& context, const BodyOptions& options);

}  // namespace bodice::synth
