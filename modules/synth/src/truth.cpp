#include "truth.hpp"

#include <algorithm>
#include <functional>

namespace bodice::synth {
namespace {

using body::LandmarkId;
using body::Part;
using geometry::Index;

/// Positive where the part has more of the vertex than any other part; the trunk counts as one.
std::vector<double> lead_of(const Posed& b, std::initializer_list<Part> parts) {
  std::vector<double> lead(b.rest.size());
  for (std::size_t v = 0; v < lead.size(); ++v) {
    const auto shares = part_shares(b.weights[v]);
    float own = 0.0f, other = 0.0f;
    for (int p = 0; p < body::kPartCount; ++p) {
      const bool mine = std::find(parts.begin(), parts.end(), static_cast<Part>(p)) != parts.end();
      float& most = mine ? own : other;
      most = std::max(most, shares[p]);
    }
    lead[v] = static_cast<double>(own) - static_cast<double>(other);
  }
  return lead;
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

/// Centroid of the border line, by length.
Vec3 girth_centre(const Posed& b, const std::vector<double>& field) {
  Vec3 sum = Vec3::Zero();
  double length = 0.0;
  walk_border(b, field, [&](const Crossing& one, const Crossing& other) {
    const double piece = (one.posed - other.posed).norm();
    sum += 0.5 * piece * (one.posed + other.posed);
    length += piece;
  });
  return length > 0.0 ? Vec3(sum / length) : sum;
}

/// The border point that lies lowest in the rest pose.
Vec3 lowest_on_border(const Posed& b, const std::vector<double>& field) {
  double lowest = 1e9;
  Vec3 place = Vec3::Zero();
  walk_border(b, field, [&](const Crossing& one, const Crossing& other) {
    for (const Crossing* end : {&one, &other})
      if (end->rest.y() < lowest) {
        lowest = end->rest.y();
        place = end->posed;
      }
  });
  return place;
}

/// The vertex of the regions that reaches furthest in the rest pose.
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

Index nearest_vertex(const std::vector<Vec3>& positions, const Vec3& p) {
  Index best = 0;
  for (Index v = 1; v < positions.size(); ++v)
    if ((positions[v] - p).squaredNorm() < (positions[best] - p).squaredNorm()) best = v;
  return best;
}

Part trunk_part(const Figure& f, const Vec3& rest) {
  const bool left = rest.x() >= -1e-9;
  if (rest.y() > f.p.chest_height) return left ? Part::kTorsoUL : Part::kTorsoUR;
  if (rest.y() > f.p.waist_height) return left ? Part::kTorsoML : Part::kTorsoMR;
  return left ? Part::kTorsoLL : Part::kTorsoLR;
}

}  // namespace

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
  const auto sided = [](auto left, int side) {
    return static_cast<decltype(left)>(static_cast<int>(left) + side);
  };
  put_vertex(LandmarkId::kCrown, furthest(b, Region::kHead, Vec3::UnitY()));
  put(LandmarkId::kNeck, girth_centre(b, lead_of(b, {Part::kHead})));
  put_vertex(LandmarkId::kPerineum, furthest(b, Region::kCrotch, -Vec3::UnitY()));
  for (int side = 0; side < 2; ++side) {
    constexpr int kMiddleFinger = 1;
    put_vertex(sided(LandmarkId::kFingertipL, side),
               furthest(b, digit_region(side, kMiddleFinger), b.figure.arm[side].along));
    put_vertex(sided(LandmarkId::kToeL, side),
               furthest(b, region_of_side(Region::kLegL, side), Vec3::UnitZ()));
    const Part forearm = sided(Part::kForearmL, side), calf = sided(Part::kCalfL, side);
    put(sided(LandmarkId::kElbowL, side), girth_centre(b, lead_of(b, {forearm})));
    put(sided(LandmarkId::kKneeL, side), girth_centre(b, lead_of(b, {calf})));
    put(sided(LandmarkId::kArmpitL, side),
        lowest_on_border(b, lead_of(b, {forearm, sided(Part::kUpperArmL, side)})));
  }
  return landmarks;
}

std::vector<Joint> true_joints(const Figure& figure, const BoneTransforms& bones) {
  std::vector<Joint> joints;
  for (int b = 0; b < kBoneCount; ++b)
    joints.push_back({std::string(joint_name(static_cast<Bone>(b))), bones[b] * figure.joint[b]});
  return joints;
}

}  // namespace bodice::synth
