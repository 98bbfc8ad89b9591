#include "outfits.hpp"

#include <cstdio>
#include <fstream>
#include <map>

#include <nlohmann/json.hpp>

#include <bodice/proxy/proxy_file.hpp>
#include <bodice/tryon/wearing.hpp>

#include <bench_support/or_exit.hpp>

namespace bench {
namespace {

namespace fs = std::filesystem;
using namespace bodice;

/// The mesh with each triangle cut in four at the middles of its edges.
geometry::TriMesh halve_edges(const geometry::TriMesh& mesh) {
  geometry::TriMesh fine{.positions = mesh.positions};
  std::map<std::pair<geometry::Index, geometry::Index>, geometry::Index> middle;
  auto between = [&](geometry::Index a, geometry::Index b) {
    const auto [it, fresh] =
        middle.try_emplace(std::minmax(a, b), static_cast<geometry::Index>(fine.positions.size()));
    if (fresh) fine.positions.push_back(0.5 * (mesh.positions[a] + mesh.positions[b]));
    return it->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto ab = between(a, b), bc = between(b, c), ca = between(c, a);
    fine.triangles.insert(fine.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return fine;
}

}  // namespace

std::vector<Outfit> find_outfits(const fs::path& data, const std::string& only, bool also_halved) {
  std::ifstream in(data / "garments" / "garments.json");
  std::vector<Outfit> outfits;
  for (const auto& entry : nlohmann::json::parse(in)) {
    const std::string file = entry["file"], body = entry["body"], pose = entry["pose"];
    if (file.find(only) == std::string::npos) continue;
    Outfit outfit{file.substr(0, file.rfind('.')), data / "garments" / file,
                  data / "bodies" / (body + "_" + pose + ".obj")};
    outfits.push_back(outfit);
    if (!also_halved) continue;
    outfit.name.insert(outfit.name.find("__"), "_fine");
    outfit.halved = true;
    outfits.push_back(std::move(outfit));
  }
  return outfits;
}

Body load_body(const engine::Context& context, const fs::path& file, proxy::Tier tier,
               const fs::path& cache) {
  tryon::SegmentedSkin skin = or_exit(tryon::segment_file(context, file, {}));
  const fs::path kept = cache / (file.stem().string() + "_" + std::string(proxy::name(tier)) + ".bodice");
  if (!cache.empty() && fs::exists(kept)) return {std::move(skin), or_exit(proxy::load(kept))};
  tryon::PreparedBody fitted = or_exit(tryon::fit_proxy(context, std::move(skin), {.tier = tier}));
  if (!cache.empty()) {
    fs::create_directories(cache);
    if (const auto saved = proxy::save(fitted.fit.proxy, kept); !saved)
      std::fprintf(stderr, "%s\n", saved.error().sentence().c_str());
  }
  return {std::move(fitted.skin), std::move(fitted.fit.proxy)};
}

tryon::WornGarment load_garment(const engine::Context& context, const Outfit& outfit, const Body& body) {
  io::ImportedMesh mesh = or_exit(io::import_garment(context, outfit.garment, body.skin.input.frame));
  tryon::WornGarment worn{.name = outfit.name, .mesh = std::move(mesh.skin)};
  if (outfit.halved) worn.mesh = halve_edges(worn.mesh);
  worn.held = tryon::held_vertices(worn.mesh, body.skin);
  return worn;
}

}  // namespace bench
