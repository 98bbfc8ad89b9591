#include <array>

#include <bodice/io/scene.hpp>

namespace bodice::inline v0_1::io {

namespace {

// The left part of a pair is warm or light and the right one darker, so that lightness distinguishes what
// hue may not.
constexpr std::array<std::array<float, 3>, body::kPartCount> kColors = {{
    {0.94f, 0.78f, 0.60f},  // head
    {0.99f, 0.75f, 0.44f},  // torso_ul
    {0.80f, 0.47f, 0.13f},  // torso_ur
    {0.60f, 0.82f, 0.53f},  // torso_ml
    {0.23f, 0.55f, 0.26f},  // torso_mr
    {0.72f, 0.68f, 0.87f},  // torso_ll
    {0.43f, 0.34f, 0.66f},  // torso_lr
    {0.65f, 0.81f, 0.93f},  // upper_arm_l
    {0.13f, 0.44f, 0.71f},  // upper_arm_r
    {0.98f, 0.62f, 0.60f},  // forearm_l
    {0.77f, 0.16f, 0.18f},  // forearm_r
    {0.55f, 0.87f, 0.84f},  // thigh_l
    {0.08f, 0.52f, 0.52f},  // thigh_r
    {0.96f, 0.93f, 0.55f},  // calf_l
    {0.62f, 0.56f, 0.14f},  // calf_r
}};

/// Shades of wood and slate, so that a thing beside a body stands out from it.
constexpr std::array<std::array<float, 3>, body::kThingPartCount> kThingColors = {{
    {0.62f, 0.50f, 0.40f},
    {0.45f, 0.52f, 0.58f},
    {0.78f, 0.68f, 0.56f},
    {0.33f, 0.38f, 0.44f},
    {0.52f, 0.40f, 0.31f},
    {0.64f, 0.70f, 0.74f},
    {0.70f, 0.58f, 0.42f},
    {0.42f, 0.46f, 0.44f},
    {0.56f, 0.46f, 0.42f},
    {0.54f, 0.60f, 0.62f},
    {0.84f, 0.76f, 0.66f},
    {0.38f, 0.32f, 0.29f},
    {0.74f, 0.64f, 0.60f},
    {0.48f, 0.56f, 0.52f},
    {0.66f, 0.54f, 0.34f},
    {0.30f, 0.34f, 0.34f},
}};

}  // namespace

std::span<const float, 3> part_color(body::Part part) {
  if (body::is_of_thing(part))
    return kThingColors[static_cast<std::size_t>(part) - static_cast<std::size_t>(body::Part::kThing)];
  return kColors[static_cast<std::size_t>(part)];
}

}  // namespace bodice::io
