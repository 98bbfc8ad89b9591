#pragma once

#include <bodice/collision/collider.hpp>

#include "base/context.hpp"

struct bodice_workspace {
  explicit bodice_workspace(bodice::capi::SharedContext shared)
      : context(shared),
        engine(shared->memory()),
        numbers(shared),
        element(shared),
        claim(shared),
        contacts(shared) {}

  bodice::capi::SharedContext context;
  bodice::collision::Workspace engine;
  bodice::capi::HostArray<float> numbers;          ///< the paths of a sweep, one array after another
  bodice::capi::HostArray<std::uint32_t> element;  ///< the element of each particle that is not pinned
  bodice::capi::HostArray<std::uint32_t> claim;    ///< for each element, the particle that names it
  bodice::capi::HostArray<bodice::collision::Contact> contacts;
};
