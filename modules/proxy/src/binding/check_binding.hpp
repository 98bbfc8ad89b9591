#pragma once

#include <string>

#include <bodice/proxy/body_proxy.hpp>

namespace bodice::inline v0_1::proxy {

/// Matrices beyond this would leave the range of double when they are multiplied.
inline constexpr double kLargestEntry = 1e30;
/// Bytes of a name: files have 16 bits for the length.
inline constexpr std::size_t kLongestName = 65535;

/// What is wrong with the binding of the data, or nothing. Every index that posing uses is checked.
std::string binding_fault(const Binding& binding, const BodyProxy::Data& data);

}  // namespace bodice::proxy
