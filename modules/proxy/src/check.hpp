#pragma once

#include <optional>

#include <bodice/proxy/body_proxy.hpp>

namespace bodice::proxy {

/// What is wrong with the data, if anything: the precondition of every BodyProxy.
std::optional<engine::Error> find_fault(const BodyProxy::Data& data);

}  // namespace bodice::proxy
