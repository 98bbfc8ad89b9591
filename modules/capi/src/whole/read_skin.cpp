// What is known of a skin, copied into memory of the host.
#include <algorithm>
#include <span>

#include <bodice/anatomy/measure.hpp>
#include <bodice/body/measurement.hpp>

#include "base/handles.hpp"
#include "base/structures.hpp"
#include "whole/skin.hpp"

using namespace bodice;
using capi::invalid;
using capi::Outcome;

namespace {

/// Copies the first `capacity` elements of `from`, each by `as_c`.
template <class From, class To, class Convert>
Outcome copy(std::span<const From> from, To* to, std::size_t capacity, const char* what, Convert as_c) {
  if (!to && capacity > 0)
    return invalid(std::string("The array of ") + what + " is null.", "Pass one, or a capacity of 0.");
  for (std::size_t i = 0; i < std::min(capacity, from.size()); ++i) to[i] = as_c(from[i]);
  return {};
}

bodice_landmark landmark_as_c(const body::Landmark& landmark) {
  return {{landmark.position.x(), landmark.position.y(), landmark.position.z()},
          landmark.confidence,
          landmark.vertex,
          0};
}

/// Null if the skin has no such joint.
const rig::Joint* joint_of(const bodice_skin* skin, uint32_t joint) {
  if (!skin || !skin->skin.rig || joint >= skin->skin.rig->skeleton.joints.size()) return nullptr;
  return &skin->skin.rig->skeleton.joints[joint];
}

}  // namespace

bodice_status bodice_skin_get_info(const bodice_skin* skin, bodice_skin_info* info) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(skin, "The skin"));
    auto value = capi::with_defaults<bodice_skin_info>();
    const tryon::SegmentedSkin& known = skin->skin;
    value.stature_m = known.anatomy.stature_m;
    for (int axis = 0; axis < 3; ++axis) value.up[axis] = known.anatomy.up[axis];
    value.vertices = static_cast<std::uint32_t>(known.input.skin.positions.size());
    value.triangles = static_cast<std::uint32_t>(known.input.skin.triangles.size());
    value.input_vertices = static_cast<std::uint32_t>(known.input.vertex_of_input.size());
    value.joints = known.rig ? static_cast<std::uint32_t>(known.rig->skeleton.joints.size()) : 0;
    value.warnings = static_cast<std::uint32_t>(skin->warnings.size());
    return capi::write(value, info);
  });
}

const char* bodice_skin_warning(const bodice_skin* skin, uint32_t warning) {
  return skin && warning < skin->warnings.size() ? skin->warnings[warning].c_str() : nullptr;
}

const char* bodice_skin_joint_name(const bodice_skin* skin, uint32_t joint) {
  const rig::Joint* found = joint_of(skin, joint);
  return found ? found->name.c_str() : nullptr;
}

int32_t bodice_skin_joint_parent(const bodice_skin* skin, uint32_t joint) {
  const rig::Joint* found = joint_of(skin, joint);
  return found ? found->parent : -1;
}

bodice_status bodice_skin_get_mesh(const bodice_skin* skin, double* positions, size_t vertices,
                                   uint32_t* triangle, size_t triangles) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(skin, "The skin"));
    const geometry::TriMesh& mesh = skin->skin.input.skin;
    for (std::size_t v = 0; positions && v < std::min(vertices, mesh.positions.size()); ++v)
      for (int axis = 0; axis < 3; ++axis) positions[3 * v + axis] = mesh.positions[v][axis];
    for (std::size_t t = 0; triangle && t < std::min(triangles, mesh.triangles.size()); ++t)
      std::ranges::copy(mesh.triangles[t], triangle + 3 * t);
    return {};
  });
}

bodice_status bodice_skin_get_vertex_of_input(const bodice_skin* skin, uint32_t* vertex, size_t capacity) {
  static_assert(geometry::kNoIndex == BODICE_NO_VERTEX);
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(skin, "The skin"));
    return copy(std::span<const geometry::Index>(skin->skin.input.vertex_of_input), vertex, capacity,
                "vertices", [](geometry::Index v) { return v; });
  });
}

bodice_status bodice_skin_get_parts(const bodice_skin* skin, uint8_t* part, size_t capacity) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(skin, "The skin"));
    return copy(std::span<const body::Part>(skin->skin.anatomy.part), part, capacity, "parts",
                [](body::Part p) { return static_cast<std::uint8_t>(p); });
  });
}

const char* bodice_landmark_name(int32_t landmark) {
  static_assert(BODICE_LANDMARKS == body::kLandmarkCount,
                "c/skin.h counts the landmarks of body/landmark.hpp");
  // The names of the engine are string literals, which end with a zero.
  return landmark >= 0 && landmark < BODICE_LANDMARKS
             ? body::kLandmarkNames[static_cast<std::size_t>(landmark)].data()
             : nullptr;
}

bodice_status bodice_skin_get_landmarks(const bodice_skin* skin, bodice_landmark* landmarks,
                                        size_t capacity) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(skin, "The skin"));
    return copy(std::span<const body::Landmark>(skin->skin.anatomy.landmarks), landmarks, capacity,
                "landmarks", landmark_as_c);
  });
}

const char* bodice_measurement_name(int32_t measurement) {
  static_assert(BODICE_MEASUREMENTS == body::kMeasurementCount);
  return measurement >= 0 && measurement < BODICE_MEASUREMENTS
             ? body::kMeasurementNames[static_cast<std::size_t>(measurement)].data()
             : nullptr;
}

bodice_status bodice_skin_get_measurements(const bodice_skin* skin, double* values, size_t capacity) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(skin, "The skin"));
    if (skin->skin.input.shape == io::Shape::kAny)
      return capi::invalid("The skin was made with BODICE_SHAPE_ANY, which has no measurements.",
                           "Make it with BODICE_SHAPE_PERSON to measure a person.");
    const body::Measurements taken = anatomy::measure(skin->skin.input.skin, skin->skin.anatomy);
    return copy(std::span<const double>(taken.value), values, capacity, "measurements",
                [](double value) { return value; });
  });
}
