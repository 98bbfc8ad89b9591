#pragma once

#include <optional>

#include <bodice/proxy/body_proxy.hpp>

namespace bodice::inline v0_1::proxy {

/// The first fault of the data, if there is one. No BodyProxy has a fault.
std::optional<engine::Error> find_fault(const BodyProxy::Data& data);

}  // namespace bodice::proxy
