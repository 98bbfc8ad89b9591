#pragma once

#include <string>

#include <bodice/proxy/body_proxy.hpp>

namespace bodice::inline v0_1::proxy {

/// What is wrong with the binding of the data, or nothing. Every index that posing uses is checked.
std::string binding_fault(const Binding& binding, const BodyProxy::Data& data);

}  // namespace bodice::proxy
