// Bytes as a BVH file, for which the reader is our own: a skeleton with clips that can be posed at any time,
// or a sentence. Retargeting of the clip to its own skeleton must not fail but in a sentence either.
#include <bodice/io/rig.hpp>
#include <bodice/rig/retarget.hpp>

#include "harness.hpp"

using namespace bodice;

FUZZ_TARGET(rig) {
  const fuzz::TemporaryFile file(".bvh", {data, size});
  const auto motion = io::import_motion({}, file.path());
  fuzz::check_reported(motion);
  if (!motion.ok()) return 0;
  FUZZ_CHECK(validate(motion->skeleton).ok());
  std::vector<rig::Affine> world(motion->skeleton.joints.size());
  for (const rig::Clip& clip : motion->clips) {
    FUZZ_CHECK(validate(clip, motion->skeleton).ok());
    for (const double time : {-1.0, 0.0, 0.4 * clip.duration_s, clip.duration_s, 1e300}) {
      joint_matrices(motion->skeleton, clip, time, world);
      for (const rig::Affine& map : world) FUZZ_CHECK(map.allFinite());
    }
    fuzz::check_reported(retarget(motion->skeleton, clip, motion->skeleton));
  }
  return 0;
}
