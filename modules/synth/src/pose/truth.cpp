#include "pose/truth.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "pose/tailor_points.hpp"

namespace bodice::inline v0_1::synth {
namespace {

using body::LandmarkId;
using body::Part;
using geometry::Index;

/// The margin of the parts' weight over that of any other part, for each vertex; the trunk is one part.
std::vector<double> margin_of(const Posed& b, std::initializer_list<Part> parts) {
  std::vector<double> margin(b.rest.size());
  for (std::size_t v = 0; v < margin.size(); ++v) {
    const auto shares = part_shares(b.weights[v]);
    float own = 0.0f, other = 0.0f;
    for (int p = 0; p < body::kPartCount; ++p) {
      const bool mine = std::find(parts.begin(), parts.end(), static_cast<Part>(p)) != parts.end();
      float& most = mine ? own : other;
      most = std::max(most, shares[p]);
    }
    margin[v] = static_cast<double>(own) - static_cast<double>(other);
  }
  return margin;
}

struct Crossing {
  Vec3 rest, posed;
};

Crossing cross(const Posed& b, const std::vector<double>& field, Index i, Index k) {
  const double t = field[i] / (field[i] - field[k]);
  return {b.rest[i] + t * (b.rest[k] - b.rest[i]), b.posed[i] + t * (b.posed[k] - b.posed[i])};
}

/// Calls visit(one, other) for the segment of the field's zero line in each triangle.
void walk_border(const Posed& b, const std::vector<double>& field,
                 const std::function<void(const Crossing&, const Crossing&)>& visit) {
  for (const geometry::Triangle& t : b.triangles) {
    std::array<Crossing, 2> ends;
    int found = 0;
    for (int k = 0; k < 3 && found < 2; ++k) {
      const Index i = t[k], n = t[(k + 1) % 3];
      if ((field[i] > 0.0) != (field[n] > 0.0))
        ends[found++] = cross(b, field, std::min(i, n), std::max(i, n));
    }
    if (found == 2) visit(ends[0], ends[1]);
  }
}

/// The border point that is farthest in a direction of the rest pose.
Vec3 furthest_on_border(const Posed& b, const std::vector<double>& field, const Vec3& direction) {
  double most = -1e9;
  Vec3 posed = Vec3::Zero();
  walk_border(b, field, [&](const Crossing& one, const Crossing& other) {
    for (const Crossing* end : {&one, &other})
      if (end->rest.dot(direction) > most) {
        most = end->rest.dot(direction);
        posed = end->posed;
      }
  });
  return posed;
}

/// The rise of the floor of the trunk at which the perineum of rigged scans lies, in statures: there it
/// begins to rise to the front. The lowest point varies on a floor that is nearly level, and lies far behind
/// on heavy seats.
constexpr double kLevelFloor = 0.004;

/// The point where the midline of the crotch, followed forward, leaves the floor.
Vec3 front_of_floor(const Posed& b) {
  constexpr double kMiddle = 1e-6;
  std::vector<Index> line;
  for (Index v = 0; v < b.rest.size(); ++v)
    if (b.mesh.region[v] == Region::kCrotch && std::abs(b.rest[v].x()) < kMiddle) line.push_back(v);
  std::sort(line.begin(), line.end(), [&](Index i, Index k) { return b.rest[i].z() < b.rest[k].z(); });
  const double middle = b.figure.joint[index(Bone::kPelvis)].z();
  double low = 1e9;
  for (const Index v : line)
    if (b.rest[v].z() > middle) low = std::min(low, b.rest[v].y());
  const double level = low + kLevelFloor;
  for (std::size_t i = line.size(); i-- > 0;) {
    if (b.rest[line[i]].y() > level) continue;
    if (i + 1 == line.size()) return b.posed[line[i]];
    const Index inner = line[i], outer = line[i + 1];
    const double t = (level - b.rest[inner].y()) / (b.rest[outer].y() - b.rest[inner].y());
    return b.posed[inner] + t * (b.posed[outer] - b.posed[inner]);
  }
  return Vec3::Zero();
}

/// The vertex of the region that is farthest in a direction of the rest pose.
Index furthest(const Posed& b, Region region, const Vec3& direction) {
  Index best = 0;
  double reach = -1e9;
  for (Index v = 0; v < b.rest.size(); ++v)
    if (b.mesh.region[v] == region && b.rest[v].dot(direction) > reach) {
      reach = b.rest[v].dot(direction);
      best = v;
    }
  return best;
}

/// The depth and half width of a foot's blunt front, in statures.
constexpr double kBluntFront = 0.016, kFootWidth = 0.06;

/// The farthest vertex below the knee, since a heavy thigh may reach further.
Index front_of_foot(const Posed& b, int side) {
  const Region region = region_of_side(Region::kLegL, side);
  const double knee = b.figure.joint[index(of_side(Bone::kCalfL, side))].y();
  Index best = furthest(b, region, -Vec3::UnitY());
  for (Index v = 0; v < b.rest.size(); ++v)
    if (b.mesh.region[v] == region && b.rest[v].y() < knee && b.rest[v].z() > b.rest[best].z()) best = v;
  return best;
}

/// The tip of a foot, a little inside. Its front is blunt, so that the farthest vertex lies anywhere on it.
/// The tip is the middle of all vertices nearly as far, weighted by how far they reach.
Vec3 tip_of_foot(const Posed& b, int side) {
  const Region region = region_of_side(Region::kLegL, side);
  const Index farthest = front_of_foot(b, side);
  Vec3 moment = Vec3::Zero();
  double all = 0.0;
  for (const geometry::Triangle& t : b.triangles) {
    const Vec3 across = (b.rest[t[1]] - b.rest[t[0]]).cross(b.rest[t[2]] - b.rest[t[0]]);
    for (const Index v : t) {
      const double reach = kBluntFront - (b.rest[farthest].z() - b.rest[v].z());
      const bool near = (b.rest[v] - b.rest[farthest]).norm() < kFootWidth;
      if (b.mesh.region[v] != region || !near || !(reach > 0.0)) continue;
      moment += across.norm() * reach * b.posed[v];
      all += across.norm() * reach;
    }
  }
  return all > 0.0 ? Vec3(moment / all) : b.posed[farthest];
}

/// The height of the border of upper and lower trunk in rigged scans over the survey's waist, in statures.
constexpr double kWaistAboveNavel = 0.016;

Part trunk_part(const Figure& f, const Vec3& rest) {
  const bool left = rest.x() >= -1e-9;
  if (rest.y() > f.p.chest_height) return left ? Part::kTorsoUL : Part::kTorsoUR;
  if (rest.y() > f.p.waist_height + kWaistAboveNavel) return left ? Part::kTorsoML : Part::kTorsoMR;
  return left ? Part::kTorsoLL : Part::kTorsoLR;
}

}  // namespace

Index nearest_vertex(const std::vector<Vec3>& positions, const Vec3& p) {
  Index best = 0;
  for (Index v = 1; v < positions.size(); ++v)
    if ((positions[v] - p).squaredNorm() < (positions[best] - p).squaredNorm()) best = v;
  return best;
}

std::vector<Part> true_parts(const Posed& b) {
  std::vector<Part> parts(b.rest.size());
  for (std::size_t v = 0; v < parts.size(); ++v) {
    const auto shares = part_shares(b.weights[v]);
    const auto most = std::max_element(shares.begin(), shares.end());
    const auto part = static_cast<Part>(most - shares.begin());
    parts[v] = part == Part::kTorsoLL ? trunk_part(b.figure, b.rest[v]) : part;
  }
  return parts;
}

std::vector<body::Landmark> true_landmarks(const Posed& b) {
  std::vector<body::Landmark> landmarks(body::kLandmarkCount);
  const auto put = [&](LandmarkId id, const Vec3& p) {
    landmarks[static_cast<int>(id)] = {id, p, nearest_vertex(b.posed, p), 1.0};
  };
  const auto put_vertex = [&](LandmarkId id, Index v) {
    landmarks[static_cast<int>(id)] = {id, b.posed[v], v, 1.0};
  };
  const auto joint = [&](Bone bone) { return Vec3(b.bones[index(bone)] * b.figure.joint[index(bone)]); };
  const auto sided = [](auto left, int side) {
    return static_cast<decltype(left)>(static_cast<int>(left) + side);
  };
  put_vertex(LandmarkId::kCrown, furthest(b, Region::kHead, Vec3::UnitY()));
  put(LandmarkId::kNeck, joint(Bone::kNeck));
  put(LandmarkId::kPerineum, front_of_floor(b));
  // The armpit is that of the fold behind: halfway between down and back.
  const Vec3 to_fold = Vec3(0.0, -1.0, -1.0).normalized();
  for (int side = 0; side < 2; ++side) {
    constexpr int kMiddleFinger = 1;
    put_vertex(sided(LandmarkId::kFingertipL, side),
               furthest(b, digit_region(side, kMiddleFinger), b.figure.arm[side].along));
    put_vertex(sided(LandmarkId::kToeL, side), nearest_vertex(b.posed, tip_of_foot(b, side)));
    put(sided(LandmarkId::kElbowL, side), joint(of_side(Bone::kForearmL, side)));
    put(sided(LandmarkId::kKneeL, side), joint(of_side(Bone::kCalfL, side)));
    put(sided(LandmarkId::kArmpitL, side),
        furthest_on_border(b, margin_of(b, {sided(Part::kForearmL, side), sided(Part::kUpperArmL, side)}),
                           to_fold));
  }
  add_tailor_landmarks(b, landmarks);
  return landmarks;
}

std::vector<Joint> true_joints(const Figure& figure, const BoneTransforms& bones) {
  std::vector<Joint> joints;
  for (int b = 0; b < kBoneCount; ++b)
    joints.push_back({std::string(joint_name(static_cast<Bone>(b))), bones[b] * figure.joint[b]});
  return joints;
}

}  // namespace bodice::synth
