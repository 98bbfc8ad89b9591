#include <bodice/collision/collider.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstring>

#include <bodice/engine/parallel.hpp>

#include "collider/collider_impl.hpp"

namespace bodice::inline v0_1::collision {

using geometry::Vec3;

namespace {

/// Merges the reports of tasks: sums of integers and maxima, which do not depend on the order.
class SharedReport {
 public:
  void add(const ContactReport& block) {
    // The lock is held for a few nanoseconds, once a task.
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

/// Calls work(begin, end, sequence) for every `size` particles of [begin, end).
template <class Work>
void for_batches(std::size_t begin, std::size_t end, int size, const ParticleSequence& sequence,
                 Work&& work) {
  for (std::size_t at = begin; at < end; at += static_cast<std::size_t>(size))
    work(at, std::min(at + static_cast<std::size_t>(size), end), sequence);
}

/// Runs work in parallel tasks of whole batches over all particles and calls done(result) for each task. They
/// are visited in the order of `all`; without a workspace and an order, each task may sort its particles.
template <class Result, class Work, class Done>
void for_tasks(const engine::Context& context, const ParticleView& particles, const ParticleSequence& all,
               int size, Work&& work, Done&& done) {
  engine::parallel_for(context, particles.count, TaskOrder::kMost, [&](std::size_t begin, std::size_t end) {
    Result result;
    const auto some = [&](std::size_t from, std::size_t to, const ParticleSequence& sequence) {
      work(from, to, sequence, result);
    };
    if (all.workspace || !all.stored()) {
      for_batches(begin, end, size, all, some);
    } else {
      const TaskOrder own(particles, begin, end);
      for_batches(begin, end, size, {own.order(), begin, nullptr}, some);
    }
    done(result);
  });
}

/// With fillets each block has candidates of its own, so that larger batches gain nothing.
int batch_size(const ResolveOptions& options, bool relief) {
  return !relief && options.blend_m > 0.0f ? kBlock : kBatch;
}

/// Replaces NaN and meaningless values by zero or by no limit, as ResolveOptions states.
ResolveOptions sanitized(ResolveOptions options) {
  if (!std::isfinite(options.thickness_m)) options.thickness_m = 0.0f;
  constexpr float kSticks = 1e6f;  // more has the same effect, but infinity times zero would be NaN
  options.friction = options.friction > 0.0f ? std::min(options.friction, kSticks) : 0.0f;
  if (!(options.blend_m > 0.0f && std::isfinite(options.blend_m))) options.blend_m = 0.0f;
  options.max_push_m = std::isnan(options.max_push_m) ? std::numeric_limits<float>::infinity()
                                                      : std::max(0.0f, options.max_push_m);
  return options;
}

}  // namespace

void ContactReport::add(const ContactReport& other) {
  contacts += other.contacts;
  for (int i = 0; i < body::kAllPartCount; ++i) contacts_by_part[i] += other.contacts_by_part[i];
  unresolved += other.unresolved;
  pending += other.pending;
  wrong_side += other.wrong_side;
  fallbacks += other.fallbacks;
  pinched += other.pinched;
  judged_exactly += other.judged_exactly;
  not_finite += other.not_finite;
  max_iterations = std::max(max_iterations, other.max_iterations);
  deepest_m = std::max(deepest_m, other.deepest_m);
}

Collider::Collider(const proxy::BodyProxy& proxy, engine::MemoryResource* memory)
    : impl_(std::make_unique<Impl>(proxy, memory)) {}
Collider::~Collider() = default;
Collider::Collider(Collider&&) noexcept = default;
Collider& Collider::operator=(Collider&&) noexcept = default;

const Vec3& Collider::origin() const noexcept {
  return impl_->origin;
}

std::size_t Collider::size() const noexcept {
  return impl_->field.size();
}

bool Collider::has_relief() const noexcept {
  return impl_->model.relief.has_value();
}

std::uint64_t Collider::proxy_hash() const noexcept {
  return impl_->proxy_hash;
}

std::uint64_t Collider::poses() const noexcept {
  return impl_->poses;
}

Vec3 Collider::surface_velocity(std::uint32_t ellipsoid, const Vec3& local_point) const noexcept {
  if (!impl_->moving || ellipsoid >= impl_->motion.size()) return Vec3::Zero();
  return impl_->motion[impl_->internal_index[ellipsoid]].at(local_point);
}

Contact Collider::query(const float (&local_point)[3], const QueryOptions& options) const noexcept {
  float x = local_point[0], y = local_point[1], z = local_point[2];
  Contact contact;
  impl_->query_range(Particles{1, &x, &y, &z}, 0, 1, {}, options, {&contact, 1});
  return contact;
}

void Collider::query(const engine::Context& context, const Particles& particles, std::span<Contact> contacts,
                     const QueryOptions& options) const {
  impl_->query(context, particles, contacts, options, nullptr);
}

void Collider::query(const engine::Context& context, const Particles& particles, std::span<Contact> contacts,
                     Workspace& workspace, const QueryOptions& options) const {
  impl_->query(context, particles, contacts, options, workspace.data_.get());
}

void Collider::query(const engine::Context& context, const StridedParticles& particles,
                     std::span<Contact> contacts, Workspace& workspace, const QueryOptions& options) const {
  impl_->query(context, ParticleView(particles), contacts, options, workspace.data_.get());
}

std::size_t Collider::query_all(const float (&local_point)[3], float within_m,
                                std::span<Contact> contacts) const noexcept {
  const Vec3 p(double{local_point[0]}, double{local_point[1]}, double{local_point[2]});
  if (!p.allFinite()) return 0;
  std::size_t found = 0;
  const auto nearer = [](const Contact& a, const Contact& b) {
    return a.signed_distance < b.signed_distance;
  };
  for (std::uint32_t k = 0; k < impl_->field.size(); ++k) {
    const geometry::ClosestPoint at = geometry::closest_point(impl_->field.shape(k), p);
    ReliefSample sample{at.signed_distance, at.normal, k};
    if (impl_->model.relief) sample = correct(impl_->field, *impl_->model.relief, k, at);
    const Contact contact = impl_->make_contact(p, sample.distance_m, sample.gradient.stableNormalized(), k);
    if (contact.signed_distance > within_m) continue;
    // Inserts the contact into the sorted front part; the farthest drops out when it is full.
    const std::size_t kept = std::min(found++, contacts.size());
    const auto end = contacts.begin() + static_cast<std::ptrdiff_t>(kept);
    const auto slot = std::upper_bound(contacts.begin(), end, contact, nearer);
    if (slot == contacts.end()) continue;
    std::move_backward(slot, kept < contacts.size() ? end : end - 1, kept < contacts.size() ? end + 1 : end);
    *slot = contact;
  }
  return found;
}

ContactReport Collider::resolve(const engine::Context& context, const Particles& particles,
                                const ResolveOptions& options) const {
  return impl_->resolve(context, particles, sanitized(options), nullptr);
}

ContactReport Collider::resolve(const engine::Context& context, const Particles& particles,
                                const ResolveOptions& options, Workspace& workspace) const {
  return impl_->resolve(context, particles, sanitized(options), workspace.data_.get());
}

ContactReport Collider::resolve(const engine::Context& context, const StridedParticles& particles,
                                const ResolveOptions& options, Workspace& workspace) const {
  return impl_->resolve(context, ParticleView(particles), sanitized(options), workspace.data_.get());
}

ParticleSequence Collider::Impl::begin_call(const ParticleView& particles, WorkspaceData* workspace) const {
  if (!workspace) return {};
  workspace->candidates.begin_call(particles.count, shapes, model.beyond_m());
  workspace->order.refresh(particles);
  return {workspace->order.order(), 0, workspace};
}

namespace {

/// Adds a vector to a contact's point. Four numbers at once become vector code: the fourth, which is the
/// normal's first, keeps its bits, because nothing changes when minus zero is added.
void shift_point(Contact& contact, const double (&by)[4]) {
  static_assert(offsetof(Contact, normal) == offsetof(Contact, point) + sizeof(Contact::point));
  auto* const at = reinterpret_cast<std::byte*>(&contact) + offsetof(Contact, point);
  float number[4];
  std::memcpy(number, at, sizeof number);
  for (int i = 0; i < 4; ++i) number[i] = static_cast<float>(double{number[i]} + by[i]);
  std::memcpy(at, number, sizeof number);
}

/// Takes the contacts of one batch, which are in the cache still, into the coordinates of the positions.
void shift_contacts(const StridedParticles& particles, const ParticleSequence& sequence, std::size_t begin,
                    std::size_t end, std::span<Contact> contacts) {
  const double by[4] = {particles.origin[0], particles.origin[1], particles.origin[2], -0.0};
  const std::uint32_t* const index = sequence.from(begin);
  if (!index) {
    for (Contact& contact : contacts.subspan(begin, end - begin)) shift_point(contact, by);
    return;
  }
  for (std::size_t i = begin; i < end; ++i) shift_point(contacts[index[i - begin]], by);
}

}  // namespace

void Collider::Impl::query(const engine::Context& context, const ParticleView& all,
                           std::span<Contact> contacts, const QueryOptions& options,
                           WorkspaceData* workspace) const {
  struct Nothing {};
  ParticleView particles = all;
  particles.count = std::min(all.count, contacts.size());
  if (!particles.has_positions()) {
    std::fill_n(contacts.begin(), particles.count, no_contact());
    return;
  }
  ParticleSequence sequence = begin_call(particles, workspace);
  std::vector<std::uint32_t> own_order;
  if (!workspace && particles.count > TaskOrder::kMost) {
    own_order = order_if_scattered(particles);
    sequence.order = own_order;
  }
  for_tasks<Nothing>(
      context, particles, sequence, kBatch,
      [&](std::size_t begin, std::size_t end, const ParticleSequence& some, Nothing&) {
        query_range(particles, begin, end, some, options, contacts);
        if (particles.strided.shift_contacts) shift_contacts(particles.strided, some, begin, end, contacts);
      },
      [](const Nothing&) {});
}

ContactReport Collider::Impl::resolve(const engine::Context& context, const ParticleView& particles,
                                      const ResolveOptions& options, WorkspaceData* workspace) const {
  if (!particles.has_positions()) {
    ContactReport report;
    report.not_finite = particles.count;
    return report;
  }
  SharedReport total;
  for_tasks<ContactReport>(
      context, particles, begin_call(particles, workspace), batch_size(options, model.relief.has_value()),
      [&](std::size_t begin, std::size_t end, const ParticleSequence& sequence, ContactReport& report) {
        resolve_range(particles, begin, end, sequence, options, report);
      },
      [&](const ContactReport& report) { total.add(report); });
  return total.total();
}

}  // namespace bodice::collision
