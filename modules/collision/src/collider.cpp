#include <bodice/collision/collider.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include <bodice/engine/parallel.hpp>

#include "response.hpp"

namespace bodice::collision {

using geometry::Vec3;

namespace {

constexpr std::size_t kGrain = 1024;  // particles a task: some tens of microseconds

std::vector<geometry::Ellipsoid> in_frame_of(const Vec3& origin, const proxy::BodyProxy& proxy) {
  std::vector<geometry::Ellipsoid> shapes;
  shapes.reserve(proxy.ellipsoids().size());
  for (const proxy::ProxyEllipsoid& e : proxy.ellipsoids()) {
    shapes.push_back(e.shape);
    shapes.back().center -= origin;
  }
  return shapes;
}

Vec3 middle_of(const proxy::BodyProxy& proxy) {
  geometry::Box box;
  for (const proxy::ProxyEllipsoid& e : proxy.ellipsoids()) {
    const geometry::Box one = geometry::bounding_box(e.shape);
    box.extend(one.low);
    box.extend(one.high);
  }
  return box.empty() ? Vec3(Vec3::Zero()) : box.center();
}

Vec3 at(const float* x, const float* y, const float* z, std::size_t i) {
  return {double{x[i]}, double{y[i]}, double{z[i]}};
}

ParticleState load(const Particles& particles, std::size_t i) {
  ParticleState state;
  state.position = at(particles.x, particles.y, particles.z, i);
  state.velocity = Vec3::Zero();
  state.has_velocity = particles.vx != nullptr;
  if (state.has_velocity) state.velocity = at(particles.vx, particles.vy, particles.vz, i);
  if (particles.safe_x) state.safe = at(particles.safe_x, particles.safe_y, particles.safe_z, i);
  state.has_safe = particles.safe_x && state.safe.allFinite();
  return state;
}

void store(const ParticleState& state, const Particles& particles, std::size_t i) {
  particles.x[i] = static_cast<float>(state.position.x());
  particles.y[i] = static_cast<float>(state.position.y());
  particles.z[i] = static_cast<float>(state.position.z());
  if (!state.has_velocity) return;
  particles.vx[i] = static_cast<float>(state.velocity.x());
  particles.vy[i] = static_cast<float>(state.velocity.y());
  particles.vz[i] = static_cast<float>(state.velocity.z());
}

void count(const ParticleReport& particle, body::Part part, ContactReport& report) {
  ++report.contacts;
  ++report.contacts_by_part[static_cast<int>(part)];
  report.unresolved += particle.outcome == Outcome::kUnresolved;
  report.pending += particle.outcome == Outcome::kPending;
  report.wrong_side += particle.wrong_side;
  report.fallbacks += particle.fallback;
  report.max_iterations = std::max(report.max_iterations, static_cast<std::uint32_t>(particle.iterations));
  report.deepest_m = std::max(report.deepest_m, static_cast<float>(particle.depth_m));
}

/// Sums of integers and maxima: the same for any order of the blocks.
class SharedReport {
 public:
  void add(const ContactReport& block) {
    while (busy_.test_and_set(std::memory_order_acquire)) {
    }
    total_.add(block);
    busy_.clear(std::memory_order_release);
  }
  const ContactReport& total() const { return total_; }

 private:
  std::atomic_flag busy_;
  ContactReport total_;
};

}  // namespace

void ContactReport::add(const ContactReport& other) {
  contacts += other.contacts;
  for (int part = 0; part < body::kPartCount; ++part) contacts_by_part[part] += other.contacts_by_part[part];
  unresolved += other.unresolved;
  pending += other.pending;
  wrong_side += other.wrong_side;
  fallbacks += other.fallbacks;
  not_finite += other.not_finite;
  max_iterations = std::max(max_iterations, other.max_iterations);
  deepest_m = std::max(deepest_m, other.deepest_m);
}

struct Collider::Impl {
  explicit Impl(const proxy::BodyProxy& proxy)
      : origin(middle_of(proxy)), margin_m(proxy.margin_m()), field(in_frame_of(origin, proxy)) {
    for (const proxy::ProxyEllipsoid& e : proxy.ellipsoids()) part.push_back(e.part);
  }

  ContactReport resolve(const Particles& particles, const ResolveOptions& options, std::size_t begin,
                        std::size_t end) const;

  Vec3 origin;
  double margin_m;
  UnionField field;
  std::vector<body::Part> part;
};

ContactReport Collider::Impl::resolve(const Particles& particles, const ResolveOptions& options,
                                      std::size_t begin, std::size_t end) const {
  ContactReport report;
  const double clearance_m = margin_m + double{options.thickness_m};
  for (std::size_t i = begin; i < end; ++i) {
    ParticleState state = load(particles, i);
    if (!state.position.allFinite() || !state.velocity.allFinite()) {
      ++report.not_finite;
      continue;
    }
    const ParticleReport one = options.response == Response::kPaper
                                   ? resolve_paper(field, clearance_m, state)
                                   : resolve_nearest(field, clearance_m, options, state);
    if (one.outcome == Outcome::kClear) continue;
    store(state, particles, i);
    count(one, part[one.ellipsoid], report);
  }
  return report;
}

Collider::Collider(const proxy::BodyProxy& proxy) : impl_(std::make_unique<Impl>(proxy)) {}
Collider::~Collider() = default;
Collider::Collider(Collider&&) noexcept = default;
Collider& Collider::operator=(Collider&&) noexcept = default;

const Vec3& Collider::origin() const noexcept {
  return impl_->origin;
}

std::size_t Collider::size() const noexcept {
  return impl_->field.size();
}

Contact Collider::query(const float (&local_point)[3]) const noexcept {
  Contact contact;
  contact.signed_distance = std::numeric_limits<float>::infinity();
  contact.ellipsoid = kNoEllipsoid;
  const Vec3 p(double{local_point[0]}, double{local_point[1]}, double{local_point[2]});
  if (!p.allFinite()) return contact;
  const Owner owner = impl_->field.owner(p, std::numeric_limits<double>::infinity());
  if (owner.ellipsoid == kNoEllipsoid) return contact;
  contact.signed_distance = static_cast<float>(owner.at.signed_distance - impl_->margin_m);
  const Vec3 point = owner.at.point + impl_->margin_m * owner.at.normal;
  for (int axis = 0; axis < 3; ++axis) {
    contact.point[axis] = static_cast<float>(point[axis]);
    contact.normal[axis] = static_cast<float>(owner.at.normal[axis]);
  }
  contact.ellipsoid = owner.ellipsoid;
  return contact;
}

void Collider::query(const engine::Context& context, const Particles& particles,
                     std::span<Contact> contacts) const {
  engine::parallel_for(context, particles.count, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      contacts[i] = query({particles.x[i], particles.y[i], particles.z[i]});
  });
}

ContactReport Collider::resolve(const engine::Context& context, const Particles& particles,
                                const ResolveOptions& options) const {
  SharedReport report;
  engine::parallel_for(context, particles.count, kGrain, [&](std::size_t begin, std::size_t end) {
    report.add(impl_->resolve(particles, options, begin, end));
  });
  return report.total();
}

}  // namespace bodice::collision
