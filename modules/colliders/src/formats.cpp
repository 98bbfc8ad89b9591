#include <bodice/colliders/formats.hpp>

#include <array>

#include <bodice/engine/message.hpp>

#include "bone_frame.hpp"

namespace bodice::inline v0_1::colliders {
namespace {

constexpr std::array<FormatFacts, kFormatCount> kFacts = {{
    {"unity", ".json", ShapeKind::kTaperedCapsule, false, false},
    {"unreal", ".json", ShapeKind::kTaperedCapsule, false, false},
    {"godot", ".tscn", ShapeKind::kCapsule, false, false},
    {"vrm", ".gltf", ShapeKind::kCapsule, false, true},
    {"mujoco", ".xml", ShapeKind::kCapsule, true, false},
    {"sdformat", ".sdf", ShapeKind::kCapsule, true, false},
    {"convex", ".gltf", ShapeKind::kTaperedCapsule, false, false, ".obj"},
}};

}  // namespace

const FormatFacts& facts(Format format) {
  return kFacts[static_cast<std::size_t>(format)];
}

std::optional<Format> format_from_name(std::string_view text) {
  for (std::size_t i = 0; i < kFacts.size(); ++i)
    if (kFacts[i].name == text) return static_cast<Format>(i);
  return std::nullopt;
}

engine::Result<std::string> text_of(Format format, const proxy::BodyProxy& proxy,
                                    std::span<const PlainShape> shapes) {
  const FormatFacts& known = facts(format);
  if (known.needs_rig && !proxy.binding())
    return engine::Error{
        engine::ErrorCode::kInvalidArgument,
        engine::message("Colliders for ", known.name, " hang on joints, and the proxy is bound to none."),
        "Fit a body that has a rig, or make one first: bodice rig BODY -o rigged.glb."};
  for (const PlainShape& shape : shapes)
    if (known.richest != ShapeKind::kTaperedCapsule && shape.radius_a != shape.radius_b)
      return engine::Error{engine::ErrorCode::kInvalidArgument,
                           engine::message("There are no tapered capsules in ", known.name, "."),
                           "Ask for --shapes capsules or spheres."};
  switch (format) {
    case Format::kUnity:
      return unity_text(proxy, shapes);
    case Format::kUnreal:
      return unreal_text(proxy, shapes);
    case Format::kGodot:
      return godot_text(proxy, shapes);
    case Format::kVrm:
      return vrm_text(proxy, shapes);
    case Format::kMujoco:
      return mujoco_text(proxy);
    case Format::kSdformat:
      return sdformat_text(proxy);
    case Format::kConvex:
      return std::string();
  }
  return engine::Error{engine::ErrorCode::kInternal, "An export format has no writer.", ""};
}

}  // namespace bodice::colliders
