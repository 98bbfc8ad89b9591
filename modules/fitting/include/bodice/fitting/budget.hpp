// What a query costs, by law: the time that FitOptions::budget_us asks about.
#pragma once

#include <bodice/proxy/body_proxy.hpp>

namespace bodice::fitting {

/// Time of one query of 10,000 particles within 30 mm of the skin, in Morton order and with nothing kept from
/// an earlier one (a Workspace makes the next ones a quarter faster), microseconds, for 16 or more
/// ellipsoids: on one thread of a 2.5 GHz server with AVX-512, where bodies are within a fifth of it (up to
/// twice it with the tier paper, whose ellipsoids overlap more). A law and no clock, so that fits repeat;
/// another machine takes longer or shorter by about the same factor for every proxy.
double predicted_frame_us(proxy::Tier tier, int ellipsoids);

}  // namespace bodice::fitting
