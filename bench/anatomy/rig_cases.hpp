// The bodies of data/rigs and data/bodies in poses that are made by their bones.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <bodice/engine/random.hpp>

#include "rig.hpp"

namespace bench {

struct RiggedBody {
  std::string name;
  Rig rig;
  std::map<std::string, std::size_t> landmark_vertex;  ///< by LandmarkId's name
  double stature = 0.0;
};

/// Every body at rest, with the skeleton and the weights of the one of its sex. Sorted by name.
std::vector<RiggedBody> rigged_bodies(const std::filesystem::path& data);

/// Turns of bones by their names, against their parents.
using Turns = std::map<std::string, Eigen::Quaterniond>;

/// About the body's own axes: x to its left, y up, z forward.
Eigen::Quaterniond turn(double x_deg, double y_deg, double z_deg);
/// The right limb turns as the left one does, seen in a mirror.
Eigen::Quaterniond mirrored(const Eigen::Quaterniond& left);

struct PosedBody {
  bodice::geometry::TriMesh skin;
  std::map<std::string, bodice::geometry::Vec3> landmarks;  ///< by LandmarkId's name: 13 of them
  std::map<std::string, bodice::geometry::Vec3>
      joints;  ///< by JointId's name: those of trunk and limbs' roots
};
PosedBody pose(const RiggedBody& body, const Turns& turns);

}  // namespace bench
