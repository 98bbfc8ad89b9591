#include "base/structures.hpp"

#include <limits>

namespace bodice::inline v0_1::capi {
namespace {

/// More than any structure will have: what states more is garbage.
constexpr std::size_t kMostBytes = 4096;

void set_defaults(bodice_context_options& options) {
  options.abi = BODICE_ABI;
  options.workers = 1;
  options.log_level = BODICE_INFO;
  options.tasks_in_flight = 64;
}
void set_defaults(bodice_pose& pose) {
  pose.tables = 1;
}
void set_defaults(bodice_query_options& options) {
  options.within_m = std::numeric_limits<float>::infinity();
}
void set_defaults(bodice_resolve_options& options) {
  options.friction = 0.3f;
  options.max_push_m = std::numeric_limits<float>::infinity();
}
void set_defaults(bodice_mesh& mesh) {
  mesh.index_bytes = 4;
}
void set_defaults(bodice_rig& rig) {
  rig.joints_per_vertex = 4;
}
void set_defaults(bodice_fit_options& options) {
  options.tier = -1;
  options.bind = 1;
}
void set_defaults(bodice_session_options& options) {
  options.tier = -1;
  options.substeps = 8;
  options.thickness_m = 0.001;
}
void set_defaults(bodice_drape_options& options) {
  options.frames = 120;
  options.substeps = 16;
  options.dt_s = 1.0 / 60.0;
  options.tack_m = 0.006;
}
template <class T>
void set_defaults(T&) {}

/// Fills as much of a structure as the host has of it; what it has more of is zero.
template <class T>
Outcome fill(void* structure, std::size_t size) {
  if (size < std::min(Structure<T>::kFirst, sizeof(T)) || size > kMostBytes)
    return {BODICE_VERSION_MISMATCH,
            std::string(Structure<T>::kName) + " has " + std::to_string(size) +
                " bytes in this program, which no version of bodice has. Pass its sizeof."};
  T value{};
  set_defaults(value);
  std::memset(structure, 0, size);
  std::memcpy(structure, &value, std::min(size, sizeof value));
  const bodice_head head{static_cast<std::uint32_t>(size), cookie_of(Structure<T>::kKind)};
  std::memcpy(structure, &head, sizeof head);
  return {};
}

template <class T, class... Others>
Outcome fill_one_of(std::int32_t kind, void* structure, std::size_t size) {
  if (kind == Structure<T>::kKind) return fill<T>(structure, size);
  if constexpr (sizeof...(Others) > 0)
    return fill_one_of<Others...>(kind, structure, size);
  else
    return {BODICE_VERSION_MISMATCH,
            "There is no structure of kind " + std::to_string(kind) +
                " in this library. Install a library as new as the program's bodice.h."};
}

}  // namespace

Outcome check_head(const bodice_head* head, std::int32_t kind, const char* name, std::size_t first,
                   std::size_t size) {
  const auto maker = [&] { return "bodice_default_" + std::string(name).substr(7) + "()"; };
  if (!head) return invalid(std::string(name) + " is null.", "Pass one that " + maker() + " has filled.");
  if (head->cookie != cookie_of(kind))
    return {BODICE_NOT_INITIALIZED, std::string(name) + " was not initialized. Begin with " + maker() +
                                        " and change members of what it returns."};
  if (head->struct_size < first || head->struct_size > kMostBytes)
    return {BODICE_VERSION_MISMATCH, std::string(name) + " states a size of " +
                                         std::to_string(head->struct_size) +
                                         " bytes, which no version of bodice has. Do not change its head."};
  // A newer program may have members that this library lacks, as long as it does not use them.
  const char* bytes = reinterpret_cast<const char*>(head);
  if (std::any_of(bytes + std::min<std::size_t>(size, head->struct_size), bytes + head->struct_size,
                  [](char byte) { return byte != 0; }))
    return {BODICE_VERSION_MISMATCH, std::string(name) +
                                         " uses members that this library does not have. Install a "
                                         "library as new as the program's bodice.h."};
  return {};
}

}  // namespace bodice::capi

bodice_status bodice_fill_defaults(int32_t kind, void* structure, size_t size) {
  using namespace bodice::capi;
  return guarded([&]() -> Outcome {
    if (!structure) return invalid("The structure is null.", "Pass one.");
    return fill_one_of<bodice_context_options, bodice_proxy_info, bodice_pose, bodice_particles,
                       bodice_contacts, bodice_query_options, bodice_resolve_options, bodice_contact_report,
                       bodice_mesh, bodice_rig, bodice_skin_options, bodice_skin_info, bodice_fit_options,
                       bodice_fit_report, bodice_garment, bodice_session_options, bodice_step_report,
                       bodice_drape_options, bodice_drape_report>(kind, structure, size);
  });
}
