// Differs from the paper's section 4: the closest point of the union, or of its corrected surface, instead of
// the central ray of one ellipsoid; where a particle came from decides between the sides of a limb; where two
// limbs leave no room for the clearance it rests midway, still outside of both.
#include <cmath>
#include <limits>

#include "exact/cutting_planes.hpp"
#include "exact/ray_exits.hpp"
#include "exact/response.hpp"
#include "model/tolerances.hpp"

namespace bodice::collision {

using geometry::Vec3;

namespace {

/// Takes the inward part out of the velocity and slows the rest by Coulomb friction, restitution 0.
void correct_velocity(const Halfspaces& contact, double friction, Vec3& velocity) {
  const Vec3 along = contact.nearest_velocity(velocity);
  const double impulse = (along - velocity).norm();
  const double speed = along.norm();
  velocity =
      speed > friction * impulse ? Vec3(along * (1.0 - friction * impulse / speed)) : Vec3(Vec3::Zero());
}

/// The place as it is stored. Through memory, since g++ 12 vectorizes a pair of casts to float and back into
/// none.
Vec3 stored(const Vec3& x) {
  const auto rounded = [](double v) {
    const volatile float kept = static_cast<float>(v);
    return double{kept};
  };
  return {rounded(x.x()), rounded(x.y()), rounded(x.z())};
}

Halfspaces single(const Vec3& normal) {
  Halfspaces result;
  result.add({normal, 0.0});
  return result;
}

/// The particle goes to `x`, or as far on the way as it may in this call.
void move(const Vec3& x, const Halfspaces& contact, const ResolveOptions& options, ParticleReport& report,
          ParticleState& particle) {
  const Vec3 p = particle.position;
  const double push = (x - p).norm();
  // Undoing the particle's own path is not a push.
  const double own_path = particle.has_safe ? (p - particle.safe).norm() : 0.0;
  const double limit = double{options.max_push_m} + own_path;
  particle.position = x;
  if (push > limit) {
    particle.position = p + (x - p) * (limit / push);
    report.outcome = Outcome::kPending;
  }
  if (!particle.has_velocity) return;
  Vec3 relative = particle.velocity - particle.surface_velocity;
  correct_velocity(contact, double{options.friction}, relative);
  particle.velocity = relative + particle.surface_velocity;
}

class Resolver {
 public:
  Resolver(const UnionField& field, const ReliefTables* relief, double clearance_m,
           const ResolveOptions& options, ParticleState& particle)
      : field_(field),
        options_(options),
        particle_(particle),
        p_(particle.position),
        clearance_m_(clearance_m),
        surface_m_(std::min(clearance_m, clearance_m - double{options.thickness_m})),
        slack_m_(kCertificate * (field.size_m() + p_.cwiseAbs().maxCoeff())),
        near_(field, relief, double{options.blend_m}, clearance_m + 2.0 * slack_m_),
        overshoot_m_(std::max(slack_m_, std::min(kReliefOvershoot * near_.blend_m(),
                                                 relief ? near_.blend_m() : kFilletOvershoot * slack_m_))),
        certificate_m_(relief ? std::max(slack_m_, kReliefCertificate * near_.blend_m()) : slack_m_) {}

  ParticleReport run() {
    near_.expect(p_, 0.0);
    start_ = near_.at(p_);
    const bool inside = start_.distance_m < clearance_m_;
    if (!inside && !passed_through_something()) return report_;
    report_.ellipsoid = start_.owner;
    x_ = p_;
    if (inside) settle_from_start();
    const bool stuck = inside && !outside(x_);
    if (particle_.has_safe && (!inside || stuck || long_path())) return_to_entry(inside, stuck);
    if (!inside && report_.ellipsoid == kNoEllipsoid) return report_;  // the path met nothing
    if (inside && (chance_ || !outside(x_))) leave_certainly();
    judge();
    move(x_, contact_, options_, report_, particle_);
    return report_;
  }

 private:
  /// If so, the path is taken as the ellipsoid sees it that was passed through.
  bool passed_through_something() {
    const std::uint32_t through =
        particle_.has_safe ? passed_through(field_, particle_, p_) : std::uint32_t{kNoEllipsoid};
    if (through == kNoEllipsoid) return false;
    particle_.safe = particle_.path_start(through);
    return true;
  }

  double stored_distance(const Vec3& x) {
    if (x != judged_) {
      judged_ = x;
      judged_m_ = near_.at(stored(x)).distance_m;
    }
    return judged_m_;
  }
  bool outside(const Vec3& x) { return stored_distance(x) >= surface_m_ - certificate_m_; }
  bool long_path() const { return (p_ - particle_.safe).norm() > kLongPath * near_.shortest_radius_m(); }

  void settle_from_start() {
    report_.depth_m = clearance_m_ - start_.distance_m;
    const double longest_m = kLongestPush * report_.depth_m + overshoot_m_;
    const Settled settled = settle(near_, p_, start_, clearance_m_, overshoot_m_, longest_m);
    report_.iterations = settled.rounds;
    x_ = settled.place;
    contact_ = settled.contact;
    chance_ = settled.clear && settled.set_back;
  }

  /// Back to where the path met the union, if leaving at x would be on another side, or inside.
  void return_to_entry(bool inside, bool stuck) {
    const double kept_m = std::min(clearance_m_, near_.at(particle_.safe).distance_m);
    if (kept_m < surface_m_ - certificate_m_) return;  // the safe position is not
    const auto entry = near_.bent()
                           ? first_bent_entry(near_, field_, near_.bulge_m(), particle_.safe, p_, kept_m)
                           : first_entry(field_, particle_.safe, p_, kept_m);
    if (!entry) return;
    const bool other_side = !inside || entry->normal.dot(contact_[0].normal) < kSlidingCosine || !reached(x_);
    if (!other_side && !stuck) return;
    x_ = slide(*entry, kept_m);
    chance_ = false;
    contact_ = single(entry->normal);
    report_.wrong_side = other_side;
    report_.fallback = stuck;
    if (!inside) report_.ellipsoid = entry->ellipsoid;
  }

  /// What is left of the path beyond the entry, along the surface: a particle that is pulled through a limb
  /// is held by it but not glued to it. The entry itself if that leads nowhere clear.
  Vec3 slide(const Entry& entry, double kept_m) {
    const Vec3 rest = p_ - entry.point;
    const Vec3 along = rest - entry.normal.dot(rest) * entry.normal;
    near_.expect(entry.point, 0.0);
    const double longest_m = std::min(along.norm(), kLongPath * near_.shortest_radius_m());
    if (!(longest_m > overshoot_m_)) return entry.point;
    const Vec3 q = entry.point + longest_m * along.stableNormalized();
    const ReliefSample there = near_.at(q);
    if (there.distance_m >= kept_m) return reached(q) ? q : entry.point;
    const Settled settled = settle(near_, q, there, kept_m, overshoot_m_, longest_m);
    return settled.clear && reached(settled.place) ? settled.place : entry.point;
  }

  /// Whether the way from the safe position leads there without passing through anything.
  bool reached(const Vec3& x) const { return passed_through(field_, particle_, x) == kNoEllipsoid; }

  /// The shortest way out that was found.
  struct Way {
    Vec3 x = Vec3::Zero();
    double length_m = std::numeric_limits<double>::infinity();
    const Halfspaces* contact = nullptr;  ///< if it is known
  };

  /// A way through a limb counts as longer, by the size of all.
  void take_shorter(Way& way, const Vec3& x, const Halfspaces* contact = nullptr) const {
    double length_m = (x - p_).norm();
    if (particle_.has_safe && length_m < way.length_m && !reached(x)) length_m += field_.size_m();
    if (length_m < way.length_m) way = {x, length_m, contact};
  }

  /// What planes do not settle: a fold with no room in it, where a push that is bounded rests midway, or a
  /// place deep between ellipsoids, which several ways lead out of for certain: the shortest.
  void leave_certainly() {
    const bool fold = stored_distance(x_) > surface_m_ - kFoldDepth * field_.size_m();
    if (!chance_ && fold && std::isfinite(options_.max_push_m)) return;
    report_.fallback = true;
    Way way;
    const Halfspaces by_chance = contact_;
    if (chance_) take_shorter(way, x_, &by_chance);
    // A crease that is far for the depth is nearer than the other side of what faces it.
    constexpr double kAnywhere = std::numeric_limits<double>::infinity();
    const Settled far = settle(near_, p_, start_, clearance_m_, overshoot_m_, kAnywhere);
    if (far.clear) take_shorter(way, far.place, &far.contact);
    if (near_.bent()) leave_before_bulge(way);
    leave_along_rays(way);
    if (!std::isfinite(way.length_m)) return;
    x_ = way.x;
    contact_ = way.contact ? *way.contact : touching(x_);
  }

  /// The surfaces that hold a particle at x, which is clear.
  Halfspaces touching(const Vec3& x) {
    if (near_.bent()) return single(near_.at(x).gradient.stableNormalized());
    Halfspaces result;
    const double within_m = clearance_m_ + 2.0 * overshoot_m_;
    field_.visit_near(
        x, [&] { return within_m; },
        [&](std::size_t k, const UnionField::Plane&) {
          const geometry::ClosestPoint at = geometry::closest_point(field_.shape(k), x);
          if (at.signed_distance <= within_m) result.add({at.normal, 0.0});
        });
    return result.size() > 0 ? result : single(near_.at(x).gradient);
  }

  /// Along normals, and along the axes: in a fold a ray along a normal may graze another surface for meters.
  /// What was settled is where surfaces meet, and stays if it is about as near.
  void leave_along_rays(Way& way) {
    const auto follow = [&](const Vec3& direction) {
      if (const auto x = exit_along(direction, kMuchShorter * way.length_m)) take_shorter(way, *x);
    };
    for (int i = 0; i < contact_.size(); ++i) follow(contact_[i].normal);
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {-1.0, 1.0}) follow(sign * Vec3::Unit(axis));
  }

  /// Towards where the plain ellipsoids are as far as the surface can bulge. They are convex, and planes
  /// settle what a bent surface does not.
  void leave_before_bulge(Way& way) {
    const double plain_m = clearance_m_ + near_.bulge_m();
    NearField plain(field_, nullptr, 0.0, plain_m + 2.0 * slack_m_);
    plain.expect(p_, 0.0);
    const ReliefSample start = plain.at(p_);
    if (start.owner == kNoEllipsoid) return;
    const Settled far = settle(plain, p_, start, plain_m, slack_m_, std::numeric_limits<double>::infinity());
    if (far.clear) take_shorter(way, first_clear(far.place));
  }

  /// May give up beyond `longest_m`. A bent surface is left before the bulge around it.
  std::optional<Vec3> exit_along(const Vec3& direction, double longest_m) {
    const auto far =
        exit_along_ray(field_, p_, direction, clearance_m_ + slack_m_ + near_.bulge_m(), longest_m);
    if (!far) return std::nullopt;
    return near_.bent() ? first_clear(*far) : Vec3(*far + slack_m_ * direction);
  }

  /// On the way to a place that is clear, where a bent surface is left, by halving.
  Vec3 first_clear(const Vec3& far) {
    Vec3 in = p_, out = far;
    for (int i = 0; i < kExitHalvings && (out - in).norm() > overshoot_m_; ++i) {
      const Vec3 middle = 0.5 * (in + out);
      (near_.at(middle).distance_m >= clearance_m_ + overshoot_m_ ? out : in) = middle;
    }
    return out + kBesideJump * field_.size_m() * (far - p_).stableNormalized();
  }

  /// What counts is the place that is stored.
  void judge() {
    const double distance_m = stored_distance(x_);
    report_.outcome = Outcome::kResolved;
    report_.pinched = distance_m < clearance_m_ - certificate_m_;
    if (distance_m >= surface_m_ - certificate_m_) return;
    report_.outcome = std::isfinite(options_.max_push_m) ? Outcome::kPending : Outcome::kUnresolved;
  }

  const UnionField& field_;
  const ResolveOptions& options_;
  ParticleState& particle_;
  const Vec3 p_;
  const double clearance_m_, surface_m_, slack_m_;
  NearField near_;
  const double overshoot_m_, certificate_m_;
  ReliefSample start_;
  Vec3 x_ = Vec3::Zero();
  Vec3 judged_ = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< of the last stored_distance()
  double judged_m_ = 0.0;
  Halfspaces contact_;
  bool chance_ = false;  ///< x_ is clear, but not the closest place that is
  ParticleReport report_;
};

}  // namespace

ParticleReport resolve_closest_point(const UnionField& field, const ReliefTables* relief, double clearance_m,
                                     const ResolveOptions& options, ParticleState& particle) {
  return Resolver(field, relief, clearance_m, options, particle).run();
}

}  // namespace bodice::collision
