#include "whole/garments.hpp"

#include "arrays/mesh.hpp"
#include "base/handles.hpp"
#include "base/structures.hpp"

namespace bodice::inline v0_1::capi {
namespace {

constexpr std::size_t kMostGarments = 1000;

Outcome read_garment(const bodice_garment* given, std::size_t number, tryon::WornGarment& out) {
  bodice_garment garment;
  BODICE_CHECK(read(given, garment));
  out.name = garment.name ? garment.name : "garment_" + std::to_string(number);
  if (Outcome mesh = read_mesh(garment.mesh, out.mesh); !mesh.ok())
    return {mesh.status(), "Garment '" + out.name + "': " + mesh.sentence()};
  if (garment.held_count > 0 && !garment.held)
    return invalid("Garment '" + out.name + "' has a number of held vertices but no array of them.",
                   "Set held, or held_count to 0.");
  for (std::size_t i = 0; i < garment.held_count; ++i) {
    if (garment.held[i] >= out.mesh.positions.size())
      return invalid(
          "Garment '" + out.name + "': held vertex " + std::to_string(garment.held[i]) + " does not exist.",
          "Its mesh has " + std::to_string(out.mesh.positions.size()) + " vertices.");
    out.held.push_back(garment.held[i]);
  }
  return {};
}

}  // namespace

Outcome read_garments(const bodice_garment* given, std::size_t count, std::vector<tryon::WornGarment>& out) {
  if (count > kMostGarments)
    return invalid("There are " + std::to_string(count) + " garments.", "Pass at most 1000.");
  if (!given || count == 0) return invalid("There are no garments.", "Pass one or more.");
  // Elements of an array are as far apart as the program's structure is long, which its head states.
  bodice_garment first;
  BODICE_CHECK(read(given, first));
  for (std::size_t i = 0; i < count; ++i) {
    const char* at = reinterpret_cast<const char*>(given) + i * given->head.struct_size;
    out.emplace_back();
    BODICE_CHECK(read_garment(reinterpret_cast<const bodice_garment*>(at), i, out.back()));
  }
  return {};
}

Outcome read_fabric(const char* name, std::optional<cloth::Fabric>& out) {
  if (!name) return {};
  auto fabric = cloth::find_fabric(name);
  if (!fabric) return fabric.error();
  out = std::move(fabric).value();
  return {};
}

Outcome read_positions(const bodice_vectors* given, std::size_t count, StridedVectors& out) {
  if (!given) return invalid("The arrays of positions are null.", "Pass bodice_vectors.");
  BODICE_CHECK(read_vectors(*given, count, "positions", out));
  if (!out && count > 0) return invalid("The positions have no arrays.", "Set x, or x, y and z.");
  return {};
}

}  // namespace bodice::capi
