// What a frame of a body that moves costs: posing, and queries on the posed proxy beside the proxy at rest.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <bodice/tryon/motion.hpp>
#include <bodice/tryon/prepare.hpp>

#include <bench_references/moving_peers.hpp>

namespace bench {

/// Cost of one method: medians over the frames, processor time of one thread.
struct PeerCost {
  double pose_ms = 0.0;   ///< includes skinning where the method needs the skin
  double query_ns = 0.0;  ///< a particle within 30 mm of the skin, in coherent order
};

/// Cost of the proxy alone.
struct ProxyCost {
  double ellipsoids_ms = 0.0;  ///< posing without tables
  double tables_ms = 0.0;      ///< posing with all tables
  double skirt_ms = 0.0;       ///< posing with the tables that a skirt can reach
  double collider_ms = 0.0;    ///< taking a pose
  /// A query on the posed proxy over one at rest, by turns on as many particles, median of the frames.
  double exact_over_static = 0.0, first_order_over_static = 0.0;
  double bind_pose_over_static = 0.0;  ///< exact, in the bind pose
};

/// Skinning matrices and posed skins of a clip's frames.
struct Frames {
  std::vector<double> time_s;
  std::vector<std::vector<bodice::rig::Affine>> world, skinning;
  std::vector<bodice::geometry::TriMesh> skin;

  std::size_t size() const { return time_s.size(); }
  MovingFrame at(std::size_t i) const { return {world[i], skinning[i], skin[i]}; }
};

Frames frames_of(const bodice::tryon::SegmentedSkin& body, const bodice::tryon::BodyMotion& motion,
                 int count);

PeerCost cost_of(MovingPeer& peer, const Frames& frames, const bodice::tryon::SegmentedSkin& body,
                 std::size_t particles, std::size_t query_frames);

ProxyCost proxy_cost(const bodice::tryon::PreparedBody& body, const Frames& frames, std::size_t particles);

}  // namespace bench
