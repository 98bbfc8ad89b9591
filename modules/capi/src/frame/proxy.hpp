#pragma once

#include <bodice/proxy/body_proxy.hpp>

#include "base/context.hpp"

struct bodice_proxy {
  bodice::capi::SharedContext context;
  bodice::proxy::BodyProxy proxy;
};
