// Made bodies with truth, and how far an answer is from it.
#pragma once

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/synth/body.hpp>
#include <bodice/synth/scan.hpp>

namespace made {

using bodice::geometry::Vec3;

/// A body of random sex, build, pose and resolution.
bodice::synth::Body random_body(std::uint64_t seed);

/// Share of the skin's area that has the right part, 3 cm (of a 1.7 m body) around the true borders left out.
/// Upper and middle torso count as one, left and right torso as one: their borders are a convention.
double agreement(const bodice::synth::Body& truth, const std::vector<bodice::body::Part>& found);

/// Share of the middle and upper torso's area that is on its side of the chest line.
double chest_agreement(const bodice::synth::Body& truth, const std::vector<bodice::body::Part>& found);

/// Share of the limbs' area that carries the other side's part.
double swapped(const bodice::synth::Body& truth, const std::vector<bodice::body::Part>& found);

/// Distance of a found landmark from the true one, of the stature.
double error(const bodice::synth::Body& truth, const bodice::anatomy::Anatomy& found,
             bodice::body::LandmarkId id);

/// The body with the nearest triangles of two parts replaced by a tube between them: what a remesher makes of
/// limbs that touch.
bodice::geometry::TriMesh fused(const bodice::synth::Body& truth, const bodice::geometry::TriMesh& mesh,
                                bodice::body::Part one, bodice::body::Part other);

/// The skin of a scan that is one mesh, in meters, y up.
bodice::geometry::TriMesh skin_of(const bodice::synth::Scan& scan);

}  // namespace made
