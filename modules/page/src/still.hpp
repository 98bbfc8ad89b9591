// The picture that a page shows before anything has run.
#pragma once

#include <string>

#include <bodice/proxy/body_proxy.hpp>

namespace bodice::page {

/// The proxy's ellipsoids from the front as SVG: each is an ellipse, those behind drawn first.
std::string still_svg(const proxy::BodyProxy& proxy);

}  // namespace bodice::page
