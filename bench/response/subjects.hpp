// The bodies that are measured.
#pragma once

#include <cstdint>

#include <bodice/proxy/body_proxy.hpp>
#include <bodice/synth/body.hpp>

namespace bench {

/// A proxy of the tier, fitted to a made body.
bodice::proxy::BodyProxy fit_body(bodice::synth::Pose pose, std::uint64_t seed, bodice::proxy::Tier tier);

}  // namespace bench
