// Structures of the interface that may grow. Their heads are checked, and members that the version of the
// other side lacks stay at their defaults.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

#include "base/outcome.hpp"

namespace bodice::inline v0_1::capi {

/// The cookie of a kind of structure.
constexpr std::uint32_t cookie_of(std::int32_t kind) {
  return 0xB0D1CE00u | static_cast<std::uint32_t>(kind);
}

/// The traits of a structure: its kind, its name, and its size in the first version of the interface.
template <class T>
struct Structure;

#define BODICE_STRUCTURE(type, KIND, SIZE)      \
  template <>                                   \
  struct Structure<type> {                      \
    static constexpr std::int32_t kKind = KIND; \
    static constexpr const char* kName = #type; \
    static constexpr std::size_t kFirst = SIZE; \
  }
BODICE_STRUCTURE(bodice_context_options, BODICE_CONTEXT_OPTIONS, 88);
BODICE_STRUCTURE(bodice_proxy_info, BODICE_PROXY_INFO, 56);
BODICE_STRUCTURE(bodice_pose, BODICE_POSE, 48);
BODICE_STRUCTURE(bodice_particles, BODICE_PARTICLES, 200);
BODICE_STRUCTURE(bodice_contacts, BODICE_CONTACTS, 144);
BODICE_STRUCTURE(bodice_query_options, BODICE_QUERY_OPTIONS, 16);
BODICE_STRUCTURE(bodice_resolve_options, BODICE_RESOLVE_OPTIONS, 32);
BODICE_STRUCTURE(bodice_contact_report, BODICE_CONTACT_REPORT, 184);
BODICE_STRUCTURE(bodice_mesh, BODICE_MESH, 80);
BODICE_STRUCTURE(bodice_rig, BODICE_RIG, 64);
BODICE_STRUCTURE(bodice_skin_options, BODICE_SKIN_OPTIONS, 40);
BODICE_STRUCTURE(bodice_skin_info, BODICE_SKIN_INFO, 64);
BODICE_STRUCTURE(bodice_fit_options, BODICE_FIT_OPTIONS, 64);
BODICE_STRUCTURE(bodice_fit_report, BODICE_FIT_REPORT, 72);
BODICE_STRUCTURE(bodice_garment, BODICE_GARMENT, 40);
BODICE_STRUCTURE(bodice_session_options, BODICE_SESSION_OPTIONS, 40);
BODICE_STRUCTURE(bodice_step_report, BODICE_STEP_REPORT, 56);
BODICE_STRUCTURE(bodice_drape_options, BODICE_DRAPE_OPTIONS, 64);
BODICE_STRUCTURE(bodice_drape_report, BODICE_DRAPE_REPORT, 64);
#undef BODICE_STRUCTURE

/// A structure with its defaults, as bodice_fill_defaults() makes it.
template <class T>
T with_defaults() {
  T value;
  bodice_fill_defaults(Structure<T>::kKind, &value, sizeof value);
  return value;
}

/// Checks the head of a structure of the host; `size` is that of the structure in this library.
Outcome check_head(const bodice_head* head, std::int32_t kind, const char* name, std::size_t first,
                   std::size_t size);

/// Reads a structure of the host into one of this version. Null reads as the defaults if `optional`.
template <class T>
Outcome read(const T* given, T& out, bool optional = false) {
  using Known = Structure<T>;
  static_assert(sizeof(void*) != 8 || sizeof(T) >= Known::kFirst, "a member was removed: raise BODICE_ABI");
  out = with_defaults<T>();
  if (!given && optional) return {};
  if (Outcome head = check_head(reinterpret_cast<const bodice_head*>(given), Known::kKind, Known::kName,
                                std::min(Known::kFirst, sizeof(T)), sizeof(T));
      !head.ok())
    return head;
  std::memcpy(&out, given, std::min<std::size_t>(given->head.struct_size, sizeof(T)));
  return {};
}

/// Writes the members that the host's version of the structure has. `out` may be null if `optional`.
template <class T>
Outcome write(const T& value, T* out, bool optional = false) {
  using Known = Structure<T>;
  if (!out && optional) return {};
  if (Outcome head = check_head(reinterpret_cast<const bodice_head*>(out), Known::kKind, Known::kName,
                                std::min(Known::kFirst, sizeof(T)), SIZE_MAX);
      !head.ok())
    return head;
  const std::size_t size = std::min<std::size_t>(out->head.struct_size, sizeof(T));
  std::memcpy(reinterpret_cast<char*>(out) + sizeof(bodice_head),
              reinterpret_cast<const char*>(&value) + sizeof(bodice_head), size - sizeof(bodice_head));
  return {};
}

}  // namespace bodice::capi
