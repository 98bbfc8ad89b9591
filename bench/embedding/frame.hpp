#pragma once

#include <cstddef>

#include <bodice/proxy/body_proxy.hpp>
#include <bodice/synth/body.hpp>

namespace embedding {

/// Prints what a frame of bodice_collider_pose() and bodice_resolve() of 5,000 particles takes, median and
/// least of many, and how often it calls malloc once warm, which is returned (0 where it is not counted).
std::size_t print_frames(const bodice::synth::Body& body, const bodice::proxy::BodyProxy& proxy,
                         const char* name);

}  // namespace embedding
