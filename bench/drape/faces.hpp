// Does skin show through the cloth? Every garment of the data folder on its body, which stands and then
// walks, judged over whole triangles by the exact skin.
#pragma once

#include <filesystem>
#include <string>

#include <bodice/tryon/drape.hpp>

namespace bench {

/// Which garments are judged, and how they are draped.
struct FacesOptions {
  std::filesystem::path data;   ///< folder that holds garments/ and bodies/
  std::string only;             ///< part of the garments' names
  std::filesystem::path cache;  ///< folder that keeps proxies of standing bodies; empty: none
  std::filesystem::path
      sheet;  ///< PNG of all garments at their ends, standing in the first rows; empty: none
  int standing_frames = 120;
  double tighter_m = 0.0;  ///< garments are first moved so much nearer to the skin, but not into it
  bool walking_only = false;
  /// The number of walks of each garment, with positions at the start that differ by less than a micrometer.
  /// Where cloth is crushed, the result of one walk is a matter of rounding.
  int starts = 1;
  bool causes = false;  ///< whether to name the causes of cloth inside the skin, in the worst frame of a walk
  bodice::tryon::DrapeOptions drape;  ///< frames, kept frames and motion are set for each row
};

/// Prints a row for each garment and body; false if the sheet cannot be written.
bool judge_faces(const bodice::engine::Context& context, const FacesOptions& options);

}  // namespace bench
