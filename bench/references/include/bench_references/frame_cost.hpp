// Cost of a frame in which the body moves: moved structures are refitted, and the contacts of a garment that
// lies 4 mm over the skin are found and resolved. One thread, processor time, median of a few frames.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <bodice/collision/collider.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/proxy/body_proxy.hpp>

#include <bench_references/subject.hpp>

namespace bench {

/// Contact distance.
inline constexpr double kFrameThickness_m = 0.005;
/// Rotation of everything from frame to frame, there and back.
bodice::geometry::Mat3 frame_turn(int frame);

/// Time of a frame and the number of its contacts.
struct FrameCost {
  double ms = 0.0;
  std::size_t contacts = 0;
};

/// The skin, moved 4 mm along its normals.
bodice::geometry::TriMesh garment_over(const bodice::geometry::TriMesh& skin);

/// Moves the proxy and resolves every particle with a thickness of 5 mm, a frame at a time. Several proxies
/// can take turns, so that a slow second of the machine affects all alike.
class ProxyFrames {
 public:
  ProxyFrames(const bodice::proxy::BodyProxy& proxy, const Cloud& cloud,
              bodice::collision::Response response = bodice::collision::Response::kClosestPoint);

  void run();
  /// Processor times of all frames but the first two, which sort the particles; rising.
  std::vector<double> sorted_ms() const;
  std::size_t contacts() const { return contacts_; }
  std::size_t judged_exactly() const { return judged_exactly_; }
  std::size_t ellipsoids() const { return shapes_.size(); }
  std::size_t particles() const { return start_.size(); }

 private:
  bodice::collision::Collider collider_;
  bodice::collision::Workspace order_;
  bodice::collision::Response response_;
  std::vector<bodice::geometry::Ellipsoid> shapes_;
  Cloud start_, now_;
  std::vector<double> ms_;
  std::size_t contacts_ = 0, judged_exactly_ = 0;
  int frame_ = 0;
};

/// Median of a few frames.
FrameCost proxy_frame(const bodice::proxy::BodyProxy& proxy, const Cloud& cloud,
                      bodice::collision::Response response = bodice::collision::Response::kClosestPoint);

/// Refits two trees of boxes and finds contacts within 5 mm, without a response.
FrameCost tree_frame(bodice::geometry::TriMesh body, bodice::geometry::TriMesh garment);

/// One frame of FCL, which has no thickness for meshes: its tree of oriented boxes over the skin is refitted,
/// and a ball of 5 mm at each vertex of the garment is tested against it. Nothing if FCL is not installed.
std::optional<FrameCost> fcl_frame(bodice::geometry::TriMesh body, const bodice::geometry::TriMesh& garment);

}  // namespace bench
