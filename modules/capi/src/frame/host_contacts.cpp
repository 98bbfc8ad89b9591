#include "frame/host_contacts.hpp"

#include <cstdint>
#include <cstring>

#include <bodice/engine/parallel.hpp>

#include "base/handles.hpp"
#include "base/structures.hpp"

namespace bodice::inline v0_1::capi {
namespace {

static_assert(sizeof(bodice_contact) == sizeof(collision::Contact) &&
                  offsetof(bodice_contact, point) == offsetof(collision::Contact, point) &&
                  offsetof(bodice_contact, normal) == offsetof(collision::Contact, normal) &&
                  offsetof(bodice_contact, ellipsoid) == offsetof(collision::Contact, ellipsoid),
              "the engine writes contacts into arrays of the host");
static_assert(BODICE_NO_ELLIPSOID == collision::kNoEllipsoid);

constexpr std::size_t kContactsATask = 4096;  ///< contacts that one task copies
constexpr std::uint8_t kNoPart = 255;

/// Writes a coordinate of a contact's point. A contact is copied whole and its point replaced after that: put
/// together in registers, it would be read back before its parts have been stored, which takes longer than
/// the query.
void set_coordinate(char* contact, int axis, float value) {
  std::memcpy(contact + offsetof(bodice_contact, point) + static_cast<std::size_t>(axis) * sizeof value,
              &value, sizeof value);
}

float outward(float local, double origin) {
  return static_cast<float>(double{local} + origin);
}

void write_one(const EngineContacts& from, std::size_t i, const HostContacts& to) {
  const collision::Contact& c = from.contacts[i];
  if (to.contact) {
    char* const at = to.contact.at(i);
    std::memcpy(at, &c, sizeof c);
    for (int axis = 0; axis < 3; ++axis) set_coordinate(at, axis, outward(c.point[axis], from.origin[axis]));
  }
  if (to.distance && to.distance_is_double)
    to.distance.set(i, double{c.signed_distance});
  else if (to.distance)
    to.distance.set(i, c.signed_distance);
  if (to.point) {
    double point[3];
    for (int axis = 0; axis < 3; ++axis) point[axis] = double{c.point[axis]} + from.origin[axis];
    to.point.set(i, point);
  }
  if (to.normal) to.normal.set(i, {double{c.normal[0]}, double{c.normal[1]}, double{c.normal[2]}});
  if (to.ellipsoid) to.ellipsoid[i] = c.ellipsoid;
  if (to.part)
    to.part[i] = from.proxy && c.ellipsoid != collision::kNoEllipsoid
                     ? static_cast<std::uint8_t>(from.proxy->ellipsoids()[c.ellipsoid].part)
                     : kNoPart;
}

}  // namespace

bool HostContacts::fits_engine() const {
  return contact && contact.stride == sizeof(bodice_contact) &&
         reinterpret_cast<std::uintptr_t>(contact.data) % alignof(collision::Contact) == 0 && !distance &&
         !point && !normal && !ellipsoid && !part;
}

Outcome read_contacts(const bodice_contacts* given, std::size_t count, HostContacts& out) {
  bodice_contacts contacts;
  BODICE_CHECK(read(given, contacts));
  BODICE_CHECK(read_elements(contacts.contact, contacts.contact_stride, sizeof(bodice_contact), count,
                             "bodice_contacts.contact", out.contact));
  BODICE_CHECK(read_scalars(contacts.distance, count, "bodice_contacts.distance", out.distance,
                            out.distance_is_double));
  BODICE_CHECK(read_vectors(contacts.point, count, "bodice_contacts.point", out.point));
  BODICE_CHECK(read_vectors(contacts.normal, count, "bodice_contacts.normal", out.normal));
  out.ellipsoid = contacts.ellipsoid;
  out.part = contacts.part;
  return {};
}

void write_contacts(const engine::Context& context, const EngineContacts& from, const HostContacts& to) {
  engine::parallel_for(context, from.count, kContactsATask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) write_one(from, i, to);
  });
}

bodice_contact as_c(const collision::Contact& contact, const double (&origin)[3]) {
  bodice_contact out;
  out.distance = contact.signed_distance;
  for (int axis = 0; axis < 3; ++axis) {
    out.point[axis] = outward(contact.point[axis], origin[axis]);
    out.normal[axis] = contact.normal[axis];
  }
  out.ellipsoid = contact.ellipsoid;
  return out;
}

}  // namespace bodice::capi
