// Contacts written into arrays of the host.
#pragma once

#include <bodice/collision/collider.hpp>

#include "arrays/strided.hpp"
#include "base/context.hpp"

namespace bodice::inline v0_1::capi {

/// Arrays of the host for contacts, checked for a number of particles.
struct HostContacts {
  Strided contact, distance;
  bool distance_is_double = false;
  StridedVectors point, normal;
  std::uint32_t* ellipsoid = nullptr;
  std::uint8_t* part = nullptr;

  /// Whether the engine can write contacts into the host's array directly, and no other array is requested.
  bool fits_engine() const;
};

Outcome read_contacts(const bodice_contacts* given, std::size_t count, HostContacts& out);

/// Contacts of the engine in coordinates less `origin`, and the ellipsoids' parts, which may be null.
struct EngineContacts {
  const collision::Contact* contacts;
  std::size_t count;
  double origin[3];
  const proxy::BodyProxy* proxy;
};

void write_contacts(const engine::Context& context, const EngineContacts& from, const HostContacts& to);

/// One contact in the form of the interface.
bodice_contact as_c(const collision::Contact& contact, const double (&origin)[3]);

}  // namespace bodice::capi
