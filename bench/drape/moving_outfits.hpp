// A skirt, a T-shirt and a bodysuit, on two bodies each that can move.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <bodice/tryon/drape.hpp>
#include <bodice/tryon/rigged_body.hpp>

namespace bench {

/// A body with a rig and a bound proxy.
struct MovingBody {
  std::string name;
  bodice::tryon::PreparedBody prepared;
};

/// A garment on a body that moves.
struct MovingOutfit {
  std::string name;
  std::shared_ptr<const MovingBody> body;
  bodice::tryon::WornGarment garment;
};

/// Lists the outfits that are judged: real bodies with their garments if `data` is a folder of these, and two
/// made bodies if it is an empty path. What no file has is made: a skirt, or a shirt and a suit cut from the
/// skin at a distance. Outfits without `only` in their names are left out; each body is fitted once. Ends the
/// program with a sentence where a file is unusable.
std::vector<MovingOutfit> moving_outfits(const bodice::engine::Context& context,
                                         const std::filesystem::path& data, const std::string& only);

}  // namespace bench
