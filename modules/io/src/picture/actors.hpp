// The content of a scene as surfaces ready to draw.
#pragma once

#include <bodice/io/scene.hpp>

#include "stage.hpp"

namespace bodice::inline v0_1::io {

enum class SkinColor { kPlain, kByPart };

/// The skin as it is in a kept frame; null: as it was at first.
Actor body_actor(const Scene& scene, SkinColor color, const std::size_t* frame = nullptr);

/// Adds one actor an ellipsoid in its part's color. With `shades`, ellipsoids of a part differ in brightness,
/// so that each is visible.
void add_ellipsoids(const proxy::BodyProxy& proxy, bool shades, std::vector<Actor>& actors);

/// Adds the proxy's surface if the scene has it, else its ellipsoids.
void add_proxy(const Scene& scene, std::vector<Actor>& actors);

/// Adds the things beside the body in the colors of their parts.
void add_things(const Scene& scene, std::vector<Actor>& actors);

/// Adds all garments at a kept frame. Precondition: every garment has it.
void add_garments(const Scene& scene, std::size_t frame, std::vector<Actor>& actors);

/// The least box around all actors of all rows.
geometry::Box box_of(const std::vector<std::vector<Actor>>& rows);

}  // namespace bodice::io
