// Differs from the paper's section 4 in three points:
// - The target is the closest point of the union or of its corrected surface, not the exit of one central
//   ray.
// - The side of a limb at which a particle comes out is that of its safe position.
// - Where two limbs leave no room for the clearance, the particle rests midway, still outside of both.
#include <cmath>
#include <limits>

#include "exact/cutting_planes.hpp"
#include "exact/ray_exits.hpp"
#include "exact/response.hpp"
#include "exact/response_steps.hpp"
#include "exact/shorter_exit.hpp"
#include "model/tolerances.hpp"

namespace bodice::inline v0_1::collision {

using geometry::Vec3;

namespace {

/// Moves the particle to `x`, or toward it as far as max_push_m allows.
void move(const Vec3& x, const Halfspaces& contact, const ResolveOptions& options, ParticleReport& report,
          ParticleState& particle) {
  const Vec3 p = particle.position;
  const double push = (x - p).norm();
  // Undoing the particle's own path does not count as a push.
  const Vec3 path = particle.has_safe ? Vec3(p - particle.safe) : Vec3(Vec3::Zero());
  const double limit = double{options.max_push_m} + (path.dot(x - p) < 0.0 ? path.norm() : 0.0);
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

/// The closest-point response of one particle: cutting planes first, then the fallbacks.
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
    near_.prepare(p_, 0.0);
    start_ = near_.at(p_);
    const bool inside = start_.distance_m < clearance_m_;
    if (!inside && !passed_through_something()) return report_;
    report_.ellipsoid = start_.owner;
    x_ = p_;
    if (inside) push_from_start();
    const bool stuck = inside && !outside(x_);
    if (particle_.has_safe && (!inside || stuck || long_path())) return_to_entry(inside, stuck);
    if (!inside && report_.ellipsoid == kNoEllipsoid) return report_;  // the path reached no surface
    if (inside && (by_chance_ || !outside(x_))) take_shortest_exit();
    classify();
    move(x_, contact_, options_, report_, particle_);
    return report_;
  }

 private:
  /// Whether the path passed through an ellipsoid. If so, the safe position becomes the one relative to that
  /// ellipsoid.
  bool passed_through_something() {
    const std::uint32_t through =
        particle_.has_safe ? passed_through(field_, particle_, p_) : std::uint32_t{kNoEllipsoid};
    if (through == kNoEllipsoid) return false;
    particle_.safe = particle_.path_start(through);
    return true;
  }

  double stored_distance(const Vec3& x) {
    if (x != stored_at_) {
      stored_at_ = x;
      stored_m_ = near_.at(rounded_to_float(x)).distance_m;
    }
    return stored_m_;
  }
  bool outside(const Vec3& x) { return stored_distance(x) >= surface_m_ - certificate_m_; }
  bool long_path() const { return (p_ - particle_.safe).norm() > kLongPath * near_.shortest_radius_m(); }

  void push_from_start() {
    report_.depth_m = clearance_m_ - start_.distance_m;
    const double longest_m = kLongestPush * report_.depth_m + overshoot_m_;
    const PushResult pushed = push_by_planes(near_, p_, start_, clearance_m_, overshoot_m_, longest_m);
    report_.iterations = pushed.rounds;
    x_ = pushed.position;
    contact_ = pushed.contact;
    by_chance_ = pushed.clear && pushed.set_back;
    const double short_m = std::max(kShortPush * field_.size_m(), kLongestPlainPush * report_.depth_m);
    if (pushed.clear && !near_.nonconvex() && (x_ - p_).norm() > short_m) shorten_push();
  }

  /// Planes that were added on the path hold a particle deep between many ellipsoids too far off.
  void shorten_push() {
    report_.fallback = true;
    const auto x = shorter_exit(field_, p_, x_, clearance_m_);
    if (!x) return;
    x_ = *x;
    contact_ = touching(x_);
  }

  /// Returns the particle to the point where its path entered the union, if x_ is on another side or still
  /// inside.
  void return_to_entry(bool inside, bool stuck) {
    const double safe_clearance_m = std::min(clearance_m_, near_.at(particle_.safe).distance_m);
    if (safe_clearance_m < surface_m_ - certificate_m_) return;  // the safe position is not outside
    const auto entry = near_.nonconvex() ? first_nonconvex_entry(near_, field_, near_.bulge_m(),
                                                                 particle_.safe, p_, safe_clearance_m)
                                         : first_entry(field_, particle_.safe, p_, safe_clearance_m);
    if (!entry) return;
    const bool other_side =
        !inside || entry->normal.dot(contact_[0].normal) < kSlidingCosine || !reachable(x_);
    if (!other_side && !stuck) return;
    x_ = slide(*entry, safe_clearance_m);
    by_chance_ = false;
    contact_ = single(entry->normal);
    report_.wrong_side = other_side;
    report_.fallback = stuck;
    if (!inside) report_.ellipsoid = entry->ellipsoid;
  }

  /// Slides from the entry along the surface by the rest of the path, so that a particle pulled through a
  /// limb is held by it but not glued to it. Returns the entry itself if sliding leads to no clear point.
  Vec3 slide(const Entry& entry, double safe_clearance_m) {
    const Vec3 rest = p_ - entry.point;
    const Vec3 along = rest - entry.normal.dot(rest) * entry.normal;
    near_.prepare(entry.point, 0.0);
    const double longest_m = std::min(along.norm(), kLongPath * near_.shortest_radius_m());
    if (!(longest_m > overshoot_m_)) return entry.point;
    const Vec3 q = entry.point + longest_m * along.stableNormalized();
    const ReliefSample there = near_.at(q);
    if (there.distance_m >= safe_clearance_m) return reachable(q) ? q : entry.point;
    const PushResult pushed = push_by_planes(near_, q, there, safe_clearance_m, overshoot_m_, longest_m);
    return pushed.clear && reachable(pushed.position) ? pushed.position : entry.point;
  }

  /// Whether the path from the safe position to x passes through no ellipsoid.
  bool reachable(const Vec3& x) const { return passed_through(field_, particle_, x) == kNoEllipsoid; }

  /// The shortest exit found so far.
  struct Exit {
    Vec3 x = Vec3::Zero();
    double length_m = std::numeric_limits<double>::infinity();
    const Halfspaces* contact = nullptr;  ///< null: not known
  };

  /// Takes x if it is nearer than the exit so far. A path through a limb counts as longer by the size of the
  /// union.
  void take_shorter(Exit& exit, const Vec3& x, const Halfspaces* contact = nullptr) const {
    double length_m = (x - p_).norm();
    if (particle_.has_safe && length_m < exit.length_m && !reachable(x)) length_m += field_.size_m();
    if (length_m < exit.length_m) exit = {x, length_m, contact};
  }

  /// Handles what cutting planes leave inside. In a fold without room a particle with a limited push rests
  /// midway. A position deep between ellipsoids has several certain exits, of which the shortest is taken.
  void take_shortest_exit() {
    const bool fold = stored_distance(x_) > surface_m_ - kFoldDepth * field_.size_m();
    if (!by_chance_ && fold && std::isfinite(options_.max_push_m)) return;
    report_.fallback = true;
    Exit exit;
    const Halfspaces chance_contact = contact_;
    if (by_chance_) take_shorter(exit, x_, &chance_contact);
    // A crease farther away than the usual push is still nearer than the far side of the facing surface.
    constexpr double kAnywhere = std::numeric_limits<double>::infinity();
    const PushResult far = push_by_planes(near_, p_, start_, clearance_m_, overshoot_m_, kAnywhere);
    if (far.clear) take_shorter(exit, far.position, &far.contact);
    if (near_.nonconvex()) exit_beyond_bulge(exit);
    exit_along_rays(exit);
    if (!std::isfinite(exit.length_m)) return;
    if (!near_.nonconvex())
      if (const auto x = shorter_exit(field_, p_, exit.x, clearance_m_)) take_shorter(exit, *x);
    x_ = exit.x;
    contact_ = exit.contact ? *exit.contact : touching(x_);
  }

  /// The planes of the surfaces that hold a particle at x, which is clear.
  Halfspaces touching(const Vec3& x) {
    if (near_.nonconvex()) return single(near_.at(x).gradient.stableNormalized());
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

  /// Tries the rays along the contact's normals and along the axes, since in a fold a ray along a normal may
  /// graze another surface for meters. The exit so far is where surfaces meet, and stays unless a ray is much
  /// shorter.
  void exit_along_rays(Exit& exit) {
    const auto follow = [&](const Vec3& direction) {
      if (const auto x = exit_along(direction, kMuchShorter * exit.length_m)) take_shorter(exit, *x);
    };
    for (int i = 0; i < contact_.size(); ++i) follow(contact_[i].normal);
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {-1.0, 1.0}) follow(sign * Vec3::Unit(axis));
  }

  /// Pushes to where the plain ellipsoids are as far as the surface can bulge. They are convex, so that
  /// cutting planes succeed where the nonconvex surface defeats them.
  void exit_beyond_bulge(Exit& exit) {
    const double plain_m = clearance_m_ + near_.bulge_m();
    NearField plain(field_, nullptr, 0.0, plain_m + 2.0 * slack_m_);
    plain.prepare(p_, 0.0);
    const ReliefSample start = plain.at(p_);
    if (start.owner == kNoEllipsoid) return;
    const PushResult far =
        push_by_planes(plain, p_, start, plain_m, slack_m_, std::numeric_limits<double>::infinity());
    if (far.clear) take_shorter(exit, halve_to_clear(far.position));
  }

  /// Ray exit in this direction; nothing if it is longer than `longest_m`. From beyond the bulge of a
  /// nonconvex surface it is brought back to the surface.
  std::optional<Vec3> exit_along(const Vec3& direction, double longest_m) {
    const auto far =
        exit_along_ray(field_, p_, direction, clearance_m_ + slack_m_ + near_.bulge_m(), longest_m);
    if (!far) return std::nullopt;
    return near_.nonconvex() ? halve_to_clear(*far) : Vec3(*far + slack_m_ * direction);
  }

  /// First clear point between the particle and `far`, found by bisection; it lies just beyond a nonconvex
  /// surface.
  Vec3 halve_to_clear(const Vec3& far) {
    Vec3 in = p_, out = far;
    for (int i = 0; i < kExitHalvings && (out - in).norm() > overshoot_m_; ++i) {
      const Vec3 middle = 0.5 * (in + out);
      (near_.at(middle).distance_m >= clearance_m_ + overshoot_m_ ? out : in) = middle;
    }
    return out + kBesideJump * field_.size_m() * (far - p_).stableNormalized();
  }

  /// Sets the outcome, by the distance of the position that is stored.
  void classify() {
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
  Vec3 stored_at_ =
      Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< argument of the last stored_distance()
  double stored_m_ = 0.0;
  Halfspaces contact_;
  bool by_chance_ = false;  ///< x_ is clear, but perhaps not the closest such point
  ParticleReport report_;
};

}  // namespace

ParticleReport resolve_closest_point(const UnionField& field, const ReliefTables* relief, double clearance_m,
                                     const ResolveOptions& options, ParticleState& particle) {
  return Resolver(field, relief, clearance_m, options, particle).run();
}

}  // namespace bodice::collision
