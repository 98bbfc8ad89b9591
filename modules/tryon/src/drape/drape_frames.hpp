// The frames of a drape: they are simulated, recorded and measured.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <bodice/tryon/drape.hpp>
#include <bodice/tryon/garment_reach.hpp>
#include <bodice/tryon/penetration.hpp>

#include "drape/recorder.hpp"
#include "motion/moving_body.hpp"

namespace bodice::inline v0_1::tryon {

/// The cloth, and the body twice. Cloth collides with `contact_body`; its tables beyond the garments' reach
/// stay as at rest. The report measures `whole_body`.
struct Scene {
  const Wardrobe& all;
  cloth::Solver& solver;
  MovingBody contact_body, whole_body;
};

/// Makes the scene of a drape; a moving body gets the base poses. Fails where the proxy cannot follow its
/// rig.
engine::Result<Scene> make_scene(const Wardrobe& all, cloth::Solver& solver, const PreparedBody& body,
                                 const proxy::BodyProxy& with_props, bool moves,
                                 const proxy::BasePoses& bases);

/// A drape in progress: it moves the body, steps the cloth, and records and measures frames.
class Drape {
 public:
  Drape(const engine::Context& context, const DrapeOptions& options, Scene& scene, Recorder& recorder,
        DrapeResult& result);

  /// Puts the held vertices on the body in its bind pose, as pins.
  void hold(double thickness_m, const rig::SkinWeights* skin_weights, const PreparedBody& body);

  /// Brings a body that moves from the bind pose to the clip's first frame.
  engine::Result<void> ramp();

  /// Runs all frames and measures each.
  engine::Result<void> run(const Progress& progress);

  std::span<const geometry::Vec3> positions() const { return positions_; }

  /// Measures the ease of each garment at its present positions, and warns of garments that do not fit.
  void measure_garments(const std::vector<WornGarment>& garments, const PreparedBody& body,
                        const cloth::Fabric& fabric);

  /// Colors the tracks by the fit of the garments at their present positions.
  void color(const FitScale& scale, const std::vector<WornGarment>& garments,
             std::vector<io::GarmentTrack>& tracks);

 private:
  /// Moves the body to a second of its clip, negative ones on the ramp, and pins with it.
  engine::Result<void> pose(double time_s, double dt_s);
  /// Records a frame if it is one to keep, and then measures it.
  void record_and_measure(int frame, const Penetration& depth);

  const engine::Context& context_;
  const DrapeOptions& options_;
  Scene& scene_;
  Recorder& recorder_;
  DrapeResult& result_;
  std::optional<MotionPlayer> player_;        // absent where the body stands still
  std::vector<rig::Affine> joints_;           // #J
  std::vector<geometry::Vec3> positions_;     // #vertices of all garments
  GarmentReach reach_;                        // boxes around positions_
  std::vector<geometry::Vec3> held_, posed_;  // pins in the bind pose and in this one
  rig::SkinWeights held_weights_;
};

}  // namespace bodice::tryon
