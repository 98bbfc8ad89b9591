// Why cloth lies inside the skin of a body that walks: area by cause, judged by the exact posed skin.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include <bodice/body/part.hpp>
#include <bodice/tryon/drape.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bench {

/// Why a point of cloth lies in the skin.
enum class Cause {
  kOverlap,   ///< the skin overlaps itself, so that no position of the cloth is right
  kProxy,     ///< outside of the proxy, which has the skin too deep
  kParticle,  ///< inside the proxy, as is a corner of the triangle
  kFace       ///< inside the proxy, with all corners outside
};
inline constexpr std::size_t kCauses = 4;

/// Area of cloth deeper than half a millimeter in the skin, square centimeters, by cause, and in each by the
/// part of the body that the cloth was nearest to at the start, and the part that it lies in.
struct Causes {
  using ByPart = std::array<double, bodice::body::kPartCount>;
  std::array<std::array<ByPart, bodice::body::kPartCount>, kCauses> cm2 = {};

  double of(Cause cause) const;
  void add(const Causes& other, double share);
};

/// What the causes of one drape on a body that moves are found from.
struct Judged {
  const bodice::tryon::PreparedBody& body;
  const bodice::tryon::BodyMotion& motion;
  const bodice::geometry::TriMesh& garment;
  const bodice::tryon::DrapeResult& draped;
};

/// Why a particle lies in the skin.
enum class DeepCause {
  kOverlap,  ///< the skin overlaps itself, so that no position is right
  kNoRoom,   ///< the skin faces itself there, nearer than twice the distance that cloth keeps
  kProxy,    ///< less than half as deep in the proxy, which has the skin too deep
  kCloth     ///< in the proxy as well: what cloth left there
};
inline constexpr std::size_t kDeepCauses = 4;

/// Particles deeper in the skin than they may be, over some frames, by cause.
struct DeepParticles {
  struct Of {
    std::size_t count = 0;           ///< particles over kDeep_m, of all frames
    double deepest_m = 0.0;          ///< the deepest of these
    double time_s = 0.0;             ///< its frame
    bodice::body::Part own{}, in{};  ///< the part that it was nearest to at the start, and that it lies in
  };
  static constexpr double kDeep_m = 0.002;
  std::array<Of, kDeepCauses> of;
};

/// Adds the particles of the kept frame with this number.
void add_deep_particles(const bodice::engine::Context& context, const Judged& judged, std::size_t frame,
                        DeepParticles& found);

/// Prints a line for each cause that there is.
void print_deep_particles(const DeepParticles& found);

/// The causes in the kept frame with this number.
Causes find_causes(const bodice::engine::Context& context, const Judged& judged, std::size_t frame);

/// Prints a line a cause, with the largest of what lies in which part.
void print_causes(const Causes& causes, const std::string& when);

}  // namespace bench
