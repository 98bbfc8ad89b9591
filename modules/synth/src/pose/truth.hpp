// The truth about a posed body, known because it was made: parts, landmarks, joints.
#pragma once

#include <bodice/synth/body.hpp>

#include "mesh/weights.hpp"
#include "pose/pose.hpp"

namespace bodice::inline v0_1::synth {

struct Posed {
  const Figure& figure;
  const PatchMesh& mesh;
  const std::vector<geometry::Triangle>& triangles;
  const std::vector<Vec3>& rest;            ///< #V
  const std::vector<BoneWeights>& weights;  ///< #V
  const std::vector<Vec3>& posed;           ///< #V
  const BoneTransforms& bones;
};

/// The vertex of a mesh that is nearest to a point; of equal ones the first.
geometry::Index nearest_vertex(const std::vector<Vec3>& positions, const Vec3& p);

/// The part with the greatest weight at each vertex; the trunk is cut at chest, waist and middle.
std::vector<body::Part> true_parts(const Posed& body);

/// All landmarks in the order of LandmarkId. Neck, elbows and knees are their joints.
std::vector<body::Landmark> true_landmarks(const Posed& body);

std::vector<Joint> true_joints(const Figure& figure, const BoneTransforms& bones);

}  // namespace bodice::synth
