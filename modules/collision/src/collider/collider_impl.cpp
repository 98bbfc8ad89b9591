#include "collider/collider_impl.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <utility>

#include "collider/one_particle.hpp"
#include "model/tolerances.hpp"

namespace bodice::inline v0_1::collision {

using geometry::Vec3;

namespace {

Vec3 middle_of(const proxy::BodyProxy& proxy) {
  geometry::Box box;
  for (const proxy::ProxyEllipsoid& e : proxy.ellipsoids()) {
    const geometry::Box one = geometry::bounding_box(e.shape);
    box.extend(one.low);
    box.extend(one.high);
  }
  return box.empty() ? Vec3(Vec3::Zero()) : box.center();
}

/// Halves the span across its longest side until groups remain. Equal centers keep their order, so that the
/// lowest index still wins a tie between identical ellipsoids.
void halve(std::span<std::uint32_t> order, std::span<const proxy::ProxyEllipsoid> ellipsoids) {
  if (order.size() <= kGroup) {
    std::sort(order.begin(), order.end());
    return;
  }
  const auto center = [&](std::uint32_t k) -> const Vec3& { return ellipsoids[k].shape.center; };
  geometry::Box box;
  for (const std::uint32_t k : order) box.extend(center(k));
  int axis = 0;
  (box.high - box.low).maxCoeff(&axis);
  const std::size_t half = (order.size() / 2 + kGroup - 1) / kGroup * kGroup;
  const auto key = [&](std::uint32_t k) { return std::pair(center(k)[axis], k); };
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  halve(order.first(half), ellipsoids);
  halve(order.subspan(half), ellipsoids);
}

/// Order of the ellipsoids in which the members of each group are neighbors.
std::vector<std::uint32_t> spatial_order(const proxy::BodyProxy& proxy) {
  std::vector<std::uint32_t> order(proxy.ellipsoids().size());
  std::iota(order.begin(), order.end(), 0u);
  halve(order, proxy.ellipsoids());
  return order;
}

std::vector<geometry::Ellipsoid> local_shapes(const Vec3& origin, const proxy::BodyProxy& proxy,
                                              std::span<const std::uint32_t> order) {
  std::vector<geometry::Ellipsoid> shapes;
  shapes.reserve(order.size());
  for (const std::uint32_t k : order) {
    shapes.push_back(proxy.ellipsoids()[k].shape);
    shapes.back().center -= origin;
  }
  return shapes;
}

void count(const ParticleReport& particle, body::Part part, ContactReport& report) {
  ++report.contacts;
  ++report.contacts_by_part[static_cast<int>(part)];
  report.unresolved += particle.outcome == Outcome::kUnresolved;
  report.pending += particle.outcome == Outcome::kPending;
  report.wrong_side += particle.wrong_side;
  report.fallbacks += particle.fallback;
  report.pinched += particle.pinched;
  report.max_iterations = std::max(report.max_iterations, static_cast<std::uint32_t>(particle.iterations));
  report.deepest_m = std::max(report.deepest_m, static_cast<float>(particle.depth_m));
}

/// Counts contacts by part, with one store a run of equal parts. Neighbors mostly belong to one part, and
/// each store would wait for the one before.
class PartCount {
 public:
  explicit PartCount(ContactReport& report) : report_(report) {}
  ~PartCount() { store(); }
  PartCount(const PartCount&) = delete;
  PartCount& operator=(const PartCount&) = delete;

  void add(body::Part part) {
    if (part != part_) store();
    part_ = part;
    ++run_;
  }

 private:
  void store() {
    report_.contacts_by_part[static_cast<int>(part_)] += run_;
    run_ = 0;
  }

  ContactReport& report_;
  body::Part part_{};
  std::uint64_t run_ = 0;
};

template <class Work>
void for_lanes(const LaneBits& lanes, int count, Work&& work) {
  for (int begin = 0; begin < count; begin += kBlock)
    for (std::uint64_t left = lanes.from(begin); left != 0; left &= left - 1)
      work(begin + std::countr_zero(left));
}

}  // namespace

Collider::Impl::Impl(const proxy::BodyProxy& proxy, engine::MemoryResource* memory)
    : proxy_hash(proxy.hash()),
      origin(middle_of(proxy)),
      proxy_index(spatial_order(proxy)),
      margin_m(proxy.margin_m()),
      rest_margin_m(proxy.margin_m()),
      stature_m(proxy.stature_m()),
      texels(proxy.texels().size()),
      shapes(local_shapes(origin, proxy, proxy_index)),
      field(shapes),
      model{Baked(shapes, field.boxes(), proxy_index), std::nullopt} {
  if (proxy.relief().size() == shapes.size() && !shapes.empty())
    model.relief.emplace(proxy, proxy_index, memory);
  internal_index.resize(proxy_index.size());
  for (std::uint32_t k = 0; k < proxy_index.size(); ++k) internal_index[proxy_index[k]] = k;
  for (const std::uint32_t k : proxy_index) part.push_back(proxy.ellipsoids()[k].part);
  for (const geometry::Ellipsoid& shape : shapes)
    material.emplace_back().set(shape.center, material_of(shape).axes);
  material_before = material;
  trial.resize(shapes.size());
  motion.resize(shapes.size());
  affine_motions.resize(shapes.size());
}

Contact Collider::Impl::make_contact(const Vec3& p, double distance_m, const Vec3& normal,
                                     std::uint32_t ellipsoid) const {
  Contact contact;
  const double signed_distance = distance_m - margin_m;
  const Vec3 point = p - signed_distance * normal;
  contact.signed_distance = static_cast<float>(signed_distance);
  for (int axis = 0; axis < 3; ++axis) {
    contact.point[axis] = static_cast<float>(point[axis]);
    contact.normal[axis] = static_cast<float>(normal[axis]);
  }
  contact.ellipsoid = ellipsoid < proxy_index.size() ? proxy_index[ellipsoid] : kNoEllipsoid;
  return contact;
}

Contact Collider::Impl::exact_contact(const Vec3& p) const {
  if (!p.allFinite() || field.size() == 0) return no_contact();
  if (model.relief) {
    const ReliefSample sample = relief_sample(field, *model.relief, p);
    return make_contact(p, sample.distance_m, sample.gradient.stableNormalized(), sample.owner);
  }
  const Owner owner = field.owner(p, std::numeric_limits<double>::infinity());
  return make_contact(p, owner.at.signed_distance, owner.at.normal, owner.ellipsoid);
}

std::uint32_t Collider::Impl::owner_of(const Vec3& p) const {
  if (model.buries()) return relief_sample(field, *model.relief, p).owner;
  return field.owner(p, std::numeric_limits<double>::infinity()).ellipsoid;
}

void Collider::Impl::resolve_exactly(const ParticleView& particles, std::uint32_t i,
                                     const ResolveOptions& options, ContactReport& report) const {
  ++report.judged_exactly;
  ParticleState state = load(particles, i);
  const double clearance_m = margin_m + double{options.thickness_m};
  const ReliefTables* const relief = model.relief ? &*model.relief : nullptr;
  if (moving) {
    const std::uint32_t owner = owner_of(state.position);
    state.surface_velocity = motion[owner].at(state.position);
    // The safe position moves with the ellipsoid that owns the particle.
    state.affine_motions = affine_motions;
    state.safe_before = state.safe;
    state.safe = state.path_start(owner);
  }
  ParticleReport one;
  switch (options.response) {
    case Response::kPaper:
      one = resolve_paper(field, clearance_m, state);
      break;
    case Response::kClosestPoint:
      one = resolve_closest_point(field, relief, clearance_m, options, state);
      break;
  }
  if (one.outcome == Outcome::kClear) return;
  store(state, particles, i);
  count(one, part[one.ellipsoid], report);
}

ResponseParameters Collider::Impl::parameters_of(const ResolveOptions& options) const {
  return {.clearance_m = static_cast<float>(margin_m) + options.thickness_m,
          .slack_m = static_cast<float>(kCertificate * field.size_m()),
          .friction = options.friction,
          .max_push_m = options.max_push_m,
          .motion = moving ? motion.data() : nullptr,
          .dt_s = static_cast<float>(moved_dt_s),
          .travel_m = moving ? travel_m : 0.0f,
          .blend_m = options.blend_m};
}

Status Collider::Impl::resolve_by_kernel(const ParticleView& particles, std::size_t begin, std::size_t end,
                                         const ParticleSequence& sequence, const ResolveOptions& options,
                                         ContactReport& report) const {
  GatheredBatch gathered;
  gather(particles, sequence.from(begin), begin, end, gathered);
  ParticleBatch& batch = gathered.batch;
  batch.cache = cache_access_of(particles, begin, end, sequence.workspace);
  batch.next = next_batch_of(particles, end, sequence, nullptr);
  BatchResponse response;
  // A particle that is pushed too far away for floats goes to the exact side, as do those that overflow a
  // list.
  if (batch.count > 0 && resolve_batch(model, parameters_of(options), batch, response) != Status::kDone)
    return Status::kTooMany;
  report.not_finite += gathered.not_finite;
  for (int i = 0; i < gathered.far_count; ++i) resolve_exactly(particles, gathered.far[i], options, report);
  WorkspaceData* const workspace = sequence.workspace;
  for (std::size_t block = 0; workspace && block * kBlock < static_cast<std::size_t>(batch.count); ++block)
    workspace->order.note_radius(begin / kBlock + block, response.radius_m[block]);
  scatter(gathered, response, particles);
  PartCount parts(report);
  for (int k = 0; k < response.count; ++k) parts.add(part[static_cast<std::size_t>(response.owner[k])]);
  report.deepest_m = std::max(report.deepest_m, response.deepest_m);
  report.contacts += static_cast<std::uint64_t>(response.count);
  report.pending += static_cast<std::uint64_t>(response.pending);
  report.max_iterations = std::max(report.max_iterations, response.iterations);
  for_lanes(response.left_to_exact, batch.count,
            [&](int lane) { resolve_exactly(particles, gathered.index[lane], options, report); });
  return Status::kDone;
}

void Collider::Impl::resolve_all_exactly(const ParticleView& particles, std::size_t begin, std::size_t end,
                                         const ParticleSequence& sequence, const ResolveOptions& options,
                                         ContactReport& report) const {
  GatheredBatch gathered;
  gather(particles, sequence.from(begin), begin, end, gathered);
  report.not_finite += gathered.not_finite;
  if (field.size() == 0) return;
  for (int i = 0; i < gathered.far_count; ++i) resolve_exactly(particles, gathered.far[i], options, report);
  for (int lane = 0; lane < gathered.batch.count; ++lane)
    resolve_exactly(particles, gathered.index[lane], options, report);
}

void Collider::Impl::resolve_range(const ParticleView& particles, std::size_t begin, std::size_t end,
                                   const ParticleSequence& sequence, const ResolveOptions& options,
                                   ContactReport& report) const {
  if (field.size() == 0 || options.response != Response::kClosestPoint) {
    resolve_all_exactly(particles, begin, end, sequence, options, report);
    return;
  }
  const auto from = [&](int lane) { return begin + static_cast<std::size_t>(lane); };
  constexpr int kSizes[] = {kBlock};
  with_fallback(
      {0, static_cast<int>(end - begin)}, kSizes,
      [&](LaneSpan some) {
        return resolve_by_kernel(particles, from(some.begin), from(some.end), sequence, options, report);
      },
      [&](LaneSpan some) {
        resolve_all_exactly(particles, from(some.begin), from(some.end), sequence, options, report);
        return Status::kDone;
      });
}

}  // namespace bodice::collision
