// The picture that a page shows before anything has run.
#pragma once

#include <span>
#include <string>

#include <bodice/proxy/body_proxy.hpp>

namespace bodice::inline v0_1::page {

/// Ellipsoids from the front as SVG: each is an ellipse, those behind drawn first.
std::string still_svg(std::span<const proxy::ProxyEllipsoid> ellipsoids);

}  // namespace bodice::page
