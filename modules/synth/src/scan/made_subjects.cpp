// The made bodies that are scanned.
#include <array>

#include <bodice/engine/random.hpp>
#include <bodice/synth/scan.hpp>

namespace bodice::inline v0_1::synth {
namespace {

Pose pose_of(ScanKind kind, engine::Random& random) {
  if (sits(kind)) return Pose::kSit;
  constexpr std::array kStanding = {Pose::kA, Pose::kArmsDown, Pose::kT, Pose::kStride};
  if (hangs_arms(kind)) return Pose::kArmsDown;
  const bool game = kind >= ScanKind::kPieces && kind <= ScanKind::kClothes;
  return kStanding[random.below(game ? 1 : kStanding.size())];
}

/// An adult of random build, standing as people do in scanners.
BodyOptions person(ScanKind kind, std::uint64_t seed, std::uint64_t number) {
  engine::Random random(seed, 0x5CA4 + 2 * static_cast<std::uint64_t>(kind) + 101 * number);
  BodyOptions o;
  o.sex = random.below(2) == 0 ? body::Sex::kFemale : body::Sex::kMale;
  o.stature_m = random.uniform(1.5, 1.95);
  o.mass_kg = random.uniform(18.5, 36.0) * o.stature_m * o.stature_m;
  o.pose = pose_of(kind, random);
  o.vertices = kind == ScanKind::kLow ? static_cast<int>(random.uniform(1350.0, 1700.0)) : 14000;
  o.seed = random.bits() >> 1;
  return o;
}

}  // namespace

bool sits(ScanKind kind) {
  return kind >= ScanKind::kSeated && kind <= ScanKind::kChairFused;
}

bool hangs_arms(ScanKind kind) {
  return kind == ScanKind::kWebbed || kind == ScanKind::kTwoClose || kind == ScanKind::kTwoFused;
}

engine::Result<Scan> make_scan(const engine::Context& context, ScanKind kind, std::uint64_t seed) {
  ScanSubjects subjects;
  const bool two = kind >= ScanKind::kTwoApart && kind <= ScanKind::kTwoFused;
  for (std::uint64_t number = 0; number < (two ? 2 : 1); ++number) {
    auto body = make_body(context, person(kind, seed, number));
    if (!body) return body.error();
    (number == 0 ? subjects.body : subjects.other) = std::move(*body);
  }
  return make_scan(context, kind, seed, std::move(subjects));
}

}  // namespace bodice::synth
