#include <bench_references/capsules.hpp>
#include <bench_references/moving_peers.hpp>

namespace bench {
namespace {

using bodice::geometry::Vec3;

class RigidCapsules final : public MovingPeer {
 public:
  RigidCapsules(std::vector<Capsule> rest, std::vector<std::size_t> joint)
      : rest_(std::move(rest)), joint_(std::move(joint)), posed_(rest_) {}

  std::string name() const override { return "rigid capsules, one a bone"; }
  bool needs_skin() const override { return false; }
  double bytes() const override { return static_cast<double>(2 * sizeof(Capsule) * rest_.size()); }

  void pose(const MovingFrame& frame) override {
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      const auto& map = frame.skinning[joint_[i]];
      const Capsule& c = rest_[i];
      const Vec3 start = map.leftCols<3>() * Vec3(c.start[0], c.start[1], c.start[2]) + map.col(3);
      const Vec3 along = map.leftCols<3>() * Vec3(c.along[0], c.along[1], c.along[2]);
      for (int k = 0; k < 3; ++k) {
        posed_[i].start[k] = static_cast<float>(start[k]);
        posed_[i].along[k] = static_cast<float>(along[k]);
      }
    }
  }

  void query(const Cloud& cloud, std::span<float> distance_m) override {
    capsule_distances(posed_, cloud, distance_m);
  }

 private:
  std::vector<Capsule> rest_;
  std::vector<std::size_t> joint_;
  std::vector<Capsule> posed_;
};

}  // namespace

std::unique_ptr<MovingPeer> rigid_capsules(const bodice::geometry::TriMesh& rest,
                                           std::span<const std::uint16_t> joint, std::size_t joints) {
  std::vector<std::vector<Vec3>> points(joints);
  for (std::size_t v = 0; v < joint.size(); ++v) points[joint[v]].push_back(rest.positions[v]);
  std::vector<Capsule> capsules;
  std::vector<std::size_t> joint_of_capsule;
  for (std::size_t j = 0; j < joints; ++j) {
    if (points[j].empty()) continue;
    capsules.push_back(capsule_around(points[j]));
    joint_of_capsule.push_back(j);
  }
  return std::make_unique<RigidCapsules>(std::move(capsules), std::move(joint_of_capsule));
}

}  // namespace bench
