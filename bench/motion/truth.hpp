// What is true of a frame: the posed skin, and points near it with their exact signed distance. Nothing here
// goes through proxies, bindings or colliders.
#pragma once

#include <vector>

#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/rig/rig.hpp>

#include <bench_references/subject.hpp>

namespace bench {

inline constexpr double kNear_m = 0.030;

/// Linear blend skinning by its definition, in double precision, #V.
std::vector<bodice::geometry::Vec3> pose_by_definition(const bodice::rig::Rig& rig,
                                                       std::span<const bodice::geometry::Vec3> rest,
                                                       std::span<const bodice::rig::Affine> world);

/// Points of one frame. Points inside skin that overlaps itself, and under such skin, have no meaningful
/// distance and are left out.
struct Truth {
  Cloud particles;
  std::vector<double> distance_m;  ///< #particles: exact, negative inside
  std::size_t near_skin = 0;       ///< the first ones: within kNear_m, on both sides alike
  std::size_t on_skin = 0;  ///< the next ones: on the skin; the others are inside, evenly over the volume
};

/// Points at the same points of the skin in every frame, and points spread over its inside.
class TruePoints {
 public:
  TruePoints(const bodice::geometry::TriMesh& rest, std::size_t count);
  Truth in_pose(const bodice::engine::Context& context, const bodice::geometry::TriMesh& posed) const;

 private:
  struct Sample {
    bodice::geometry::Index triangle = 0;
    bodice::geometry::Vec3 weight =
        bodice::geometry::Vec3::Zero();  ///< barycentric weights of the triangle's corners
    double offset_m = 0.0;
  };
  std::vector<Sample> samples_;
};

}  // namespace bench
