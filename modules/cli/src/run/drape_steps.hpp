// The steps of `drape`, which `batch` takes as well, once a body and once a garment.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <bodice/tryon/rigged_body.hpp>

#include "run/run.hpp"

namespace bodice::inline v0_1::cli {

/// The options of `drape`.
/// Frames that one drape may have.
inline constexpr int kMostFrames = 100000;

struct DrapeCommand {
  CommonOptions common;
  std::vector<std::string> garments, props;
  std::string made = "skirt", output = "drape.glb", hold = "auto", position = "auto", tack = "auto",
              fabric = "cotton";
  std::vector<double> wind_m_s;
  std::optional<double> thickness_mm;
  std::optional<int> frames;
  bool no_picture = false, no_prepare = false;
  std::string contact_sheet, film_strip, fit_map, cache;
  std::string thumbnail;  ///< a small picture of the end, for lists of results; no option gives it
  int sheet_columns = 8;
  tryon::MotionChoice motion;
  tryon::DrapeOptions drape;

  bool moves() const { return !motion.motion.empty(); }
};

/// The point cache of garment `k`: the first has the given name, the others _2, _3, ... before the extension.
std::string cache_file(const DrapeCommand& command, std::size_t k);

/// Adds all options of `drape` but its callback, which runs it.
void add_drape_options(CLI::App& sub, DrapeCommand& command);

/// The body's skin by part, with a rig where it will move.
engine::Result<tryon::SegmentedSkin> read_body(Run& run, const DrapeCommand& command);

/// What moves the body; empty where it stands still. Warnings are added to the skin's.
engine::Result<std::optional<tryon::BodyMotion>> find_motion(const Run& run, const DrapeCommand& command,
                                                             tryon::SegmentedSkin& skin);

/// The garments of files, or a made one. Warnings are added to the skin's.
engine::Result<std::vector<tryon::WornGarment>> dress(const Run& run, const DrapeCommand& command,
                                                      tryon::SegmentedSkin& skin);

/// Fits the proxy; `bound`: to the skin's rig, if it has one.
engine::Result<tryon::PreparedBody> fit_body(Run& run, tryon::SegmentedSkin skin, bool bound);

/// The things of --prop, fitted like the body. Their warnings are added to the body's.
engine::Result<std::vector<tryon::PreparedBody>> read_props(Run& run, const DrapeCommand& command,
                                                            tryon::PreparedBody& body);

/// A body with what it wears and what stands beside it.
struct DressedBody {
  tryon::PreparedBody body;
  std::optional<tryon::BodyMotion> motion;
  std::vector<tryon::WornGarment> worn;
  std::vector<tryon::PreparedBody> props = {};
};

/// Drapes, and writes GLB, pictures and page as the options name them; their files are added to `written`.
engine::Result<tryon::DrapeReport> drape_and_write(Run& run, const DrapeCommand& command,
                                                   DressedBody& dressed, std::vector<std::string>& written);

}  // namespace bodice::cli
