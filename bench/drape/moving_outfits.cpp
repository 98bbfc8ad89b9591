#include "moving_outfits.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <span>

#include <bodice/synth/garment.hpp>
#include <bodice/tryon/wearing.hpp>

#include <bench_support/or_exit.hpp>

namespace bench {
namespace {

using namespace bodice;
using body::Part;

/// A garment of the table: of a file where there is one, else made.
struct Entry {
  const char* garment;
  const char* made_body;  ///< its name in bodies_of()
  const char* data_body;  ///< in DIR/bodies
  const char* data_file;  ///< in DIR/garments; null: made
};
constexpr Entry kEntries[] = {
    {"skirt", "made_woman", "f_avg_rest", "skirt_long__f_avg_rest"},
    {"skirt", "made_man", "f_heavy_rest", nullptr},
    {"tshirt", "made_man", "m_avg_rest", "tshirt_jeans__m_avg_rest"},
    {"tshirt", "made_woman", "m_old_heavy_rest", "tshirt_jeans__m_old_heavy_rest"},
    {"bodysuit", "made_woman", "f_avg_rest", "bodysuit_tight__f_avg_rest"},
    {"bodysuit", "made_man", "m_avg_rest", "bodysuit_tight__m_avg_rest"},
};

constexpr Part kShirt[] = {Part::kTorsoUL, Part::kTorsoUR, Part::kTorsoML,   Part::kTorsoMR,
                           Part::kTorsoLL, Part::kTorsoLR, Part::kUpperArmL, Part::kUpperArmR};
constexpr Part kSuit[] = {Part::kTorsoUL, Part::kTorsoUR,   Part::kTorsoML,   Part::kTorsoMR, Part::kTorsoLL,
                          Part::kTorsoLR, Part::kUpperArmL, Part::kUpperArmR, Part::kThighL,  Part::kThighR};
constexpr double kShirtEase_m = 0.012, kSuitEase_m = 0.005;

synth::BodyOptions made_body(const std::string& name) {
  if (name == "made_woman") return {};
  return {.sex = body::Sex::kMale, .stature_m = 1.78, .mass_kg = 88.0, .seed = 3};
}

std::shared_ptr<const MovingBody> prepare(const engine::Context& context, const std::string& name,
                                          const std::filesystem::path& data) {
  tryon::BodySource source = made_body(name);
  if (!data.empty()) source = tryon::BodyFile{data / "bodies" / (name + ".obj")};
  tryon::SegmentedSkin skin =
      data.empty() ? or_exit(tryon::segment_builtin(context, made_body(name), {}))
                   : or_exit(tryon::segment_file(context, data / "bodies" / (name + ".obj"), {}));
  or_exit(tryon::give_rig(context, source, skin));
  return std::make_shared<const MovingBody>(
      MovingBody{name, or_exit(tryon::fit_bound_proxy(context, std::move(skin), {}))});
}

/// The skin of some parts above a height, moved outward.
geometry::TriMesh cut_from_skin(const tryon::SegmentedSkin& body, std::span<const Part> parts, double above_m,
                                double ease_m) {
  std::uint32_t wanted = 0;
  for (const Part part : parts) wanted |= 1u << static_cast<int>(part);
  const geometry::TriMesh& skin = body.input.skin;
  const std::vector<geometry::Vec3> normals = geometry::vertex_normals(skin);
  std::vector<geometry::Index> vertex(skin.positions.size(), geometry::kNoIndex);
  geometry::TriMesh cut;
  for (const geometry::Triangle& t : skin.triangles) {
    bool inside = true;
    for (const geometry::Index v : t)
      inside = inside && (wanted >> static_cast<int>(body.anatomy.part[v]) & 1u) != 0 &&
               skin.positions[v].y() >= above_m;
    if (!inside) continue;
    geometry::Triangle& own = cut.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      geometry::Index& v = vertex[t[k]];
      if (v == geometry::kNoIndex) {
        v = static_cast<geometry::Index>(cut.positions.size());
        cut.positions.push_back(skin.positions[t[k]] + ease_m * normals[t[k]]);
      }
      own[k] = v;
    }
  }
  return cut;
}

/// Where the thighs end: a shirt that went below would have a hole for each leg.
double top_of_thighs_m(const tryon::SegmentedSkin& body) {
  double top_m = -std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < body.anatomy.part.size(); ++v)
    if (body.anatomy.part[v] == Part::kThighL || body.anatomy.part[v] == Part::kThighR)
      top_m = std::max(top_m, body.input.skin.positions[v].y());
  return top_m;
}

tryon::WornGarment make_garment(const engine::Context& context, const std::string& kind,
                                const tryon::SegmentedSkin& skin) {
  constexpr double kAll = -std::numeric_limits<double>::infinity();
  if (kind == "tshirt")
    return {
        .name = kind, .mesh = cut_from_skin(skin, kShirt, top_of_thighs_m(skin), kShirtEase_m), .held = {}};
  if (kind == "bodysuit")
    return {.name = kind, .mesh = cut_from_skin(skin, kSuit, kAll, kSuitEase_m), .held = {}};
  tryon::WornGarment skirt = or_exit(tryon::make_garment(context, skin));
  skirt.name = kind;
  return skirt;
}

tryon::WornGarment read_garment(const engine::Context& context, const std::filesystem::path& file,
                                const tryon::SegmentedSkin& skin) {
  io::ImportedMesh mesh = or_exit(io::import_garment(context, file, skin.input.frame));
  tryon::WornGarment worn{.name = file.stem().string(), .mesh = std::move(mesh.skin), .held = {}};
  worn.held = tryon::held_vertices(worn.mesh, skin);
  return worn;
}

}  // namespace

std::vector<MovingOutfit> moving_outfits(const engine::Context& context, const std::filesystem::path& data,
                                         const std::string& only) {
  std::map<std::string, std::shared_ptr<const MovingBody>> bodies;
  std::vector<MovingOutfit> outfits;
  for (const Entry& entry : kEntries) {
    const std::string body_name = data.empty() ? entry.made_body : entry.data_body;
    const std::string name = std::string(entry.garment) + "__" + body_name;
    if (name.find(only) == std::string::npos) continue;
    std::shared_ptr<const MovingBody>& body = bodies[body_name];
    if (!body) body = prepare(context, body_name, data);
    const tryon::SegmentedSkin& skin = body->prepared.skin;
    const bool from_file = !data.empty() && entry.data_file != nullptr;
    outfits.push_back(
        {name, body,
         from_file ? read_garment(context, data / "garments" / (std::string(entry.data_file) + ".obj"), skin)
                   : make_garment(context, entry.garment, skin)});
  }
  return outfits;
}

}  // namespace bench
