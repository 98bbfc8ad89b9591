// The parts of a drape's report.
#pragma once

#include <vector>

#include <bodice/tryon/drape.hpp>
#include <bodice/tryon/penetration.hpp>

namespace bodice::inline v0_1::tryon {

/// The part of the report that is known before the first frame.
DrapeReport describe(const std::vector<WornGarment>& garments, const DrapeOptions& options,
                     const cloth::SolverOptions& solver, const cloth::Fabric& fabric);

/// Adds the depth of a frame in the skin: to the list, to the maximum, and as that of the last frame.
void add_frame(int frame, const Penetration& depth, DrapeReport& report);

/// Sets the stretch and speed of the cloth at the last frame.
void add_cloth(const cloth::FrameReport& last, DrapeReport& report);

/// Sets the times of the cloth's frames, milliseconds.
void summarize_times(std::vector<double> frame_ms, DrapeReport& report);

/// The scale of a map: ease is shown up to five centimeters, strain up to twice what the fabric yields.
FitScale fit_scale(FitMap map, const cloth::Fabric& fabric);

}  // namespace bodice::tryon
