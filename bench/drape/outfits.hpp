#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <bodice/tryon/drape.hpp>

namespace bench {

/// A garment of the data folder and the body it was made for.
struct Outfit {
  std::string name;
  std::filesystem::path garment, body;
  bool halved = false;  ///< whether its edges are halved: each triangle becomes four
};

/// The outfits of garments.json with `only` in their names. With `also_halved`, each one is followed by
/// NAME_fine__BODY with halved edges.
std::vector<Outfit> find_outfits(const std::filesystem::path& data, const std::string& only,
                                 bool also_halved);

/// A body as a drape needs it: skin and proxy.
struct Body {
  bodice::tryon::SegmentedSkin skin;
  bodice::proxy::BodyProxy proxy;
};

/// Segments and fits the body; a proxy of this body and tier in the folder `cache` (unless that is empty)
/// saves the fit. Ends the program with a sentence if the body is unusable.
Body load_body(const bodice::engine::Context& context, const std::filesystem::path& file,
               bodice::proxy::Tier tier, const std::filesystem::path& cache);

bodice::tryon::WornGarment load_garment(const bodice::engine::Context& context, const Outfit& outfit,
                                        const Body& body);

}  // namespace bench
