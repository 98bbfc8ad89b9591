#include "faces/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <bodice/engine/parallel.hpp>

#include "base/tolerances.hpp"
#include "faces/own_side.hpp"
#include "faces/push_sample.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

constexpr int kRounds = 6;              // rounds of pushes, each followed by proofs of what they moved
constexpr std::size_t kProofGrain = 4;  // runs a task
constexpr std::size_t kBatch = 64;      // pieces that are queried together: a block of the collider
constexpr int kMostCuts = 12;           // halvings of an edge: a meter becomes a quarter of a millimeter
// A batch that is cut adds at most three pieces a level for each piece that it takes off the stack.
constexpr std::size_t kMostPieces = kBatch * (3 * kMostCuts + 4);

// A part of a triangle, by the barycentric weights of its corners.
struct Piece {
  std::uint32_t element = 0;
  int cuts = 0;
  float weight[3][2] = {};
};

Float4 at(const Particles& p, const Element& e, float b0, float b1) {
  const auto [i, j, k] = e.particle;
  return b0 * Float4{p.x[i], p.y[i], p.z[i], 0.0f} + b1 * Float4{p.x[j], p.y[j], p.z[j], 0.0f} +
         (1.0f - b0 - b1) * Float4{p.x[k], p.y[k], p.z[k], 0.0f};
}

// The proof of the triangles of one run.
class Prover {
 public:
  Prover(const collision::Collider& body, float tolerance_m, const FaceContact& f, const Particles& p,
         std::size_t run, FaceCertificate& out)
      : body_(body), tolerance_m_(tolerance_m), f_(f), p_(p), run_(run), out_(out) {
    const Steepness& steep = body.has_relief() ? kCertifiedRelief : kPlainSteepness;
    slope_ = steep.slope;
  }

  std::size_t prove() {
    out_.deep_count[run_] = out_.open[run_] = 0;
    std::size_t samples = 0;
    const std::uint32_t end = f_.elements.run_begin[run_ + 1];
    for (std::uint32_t e = f_.elements.run_begin[run_]; e < end || pieces_ > 0;) {
      for (; e < end && pieces_ < kBatch; ++e)
        if (!f_.elements.all[e].is_edge()) piece_[pieces_++] = whole(e);
      samples += prove_batch();
    }
    return samples;
  }

 private:
  static Piece whole(std::uint32_t element) {
    return {.element = element, .weight = {{1.0f, 0.0f}, {0.0f, 1.0f}, {0.0f, 0.0f}}};
  }

  std::size_t prove_batch() {
    Piece batch[kBatch];
    std::size_t count = 0;
    while (pieces_ > 0 && count < kBatch) {
      const Piece& piece = piece_[--pieces_];
      if (!is_open(piece)) batch[count++] = piece;
    }
    float x[kBatch], y[kBatch], z[kBatch], radius[kBatch], longest = 0.0f;
    for (std::size_t k = 0; k < count; ++k) {
      const auto& w = batch[k].weight;
      const Element& e = f_.elements.all[batch[k].element];
      const Float4 a = at(p_, e, w[0][0], w[0][1]), b = at(p_, e, w[1][0], w[1][1]),
                   c = at(p_, e, w[2][0], w[2][1]), center = (a + b + c) * (1.0f / 3.0f);
      x[k] = center[0], y[k] = center[1], z[k] = center[2];
      radius[k] = std::sqrt(
          std::max({dot(a - center, a - center), dot(b - center, b - center), dot(c - center, c - center)}));
      longest = std::max(longest, radius[k]);
    }
    collision::Contact contact[kBatch];
    const engine::Context alone{.executor = &engine::inline_executor()};
    body_.query(alone, {.count = count, .x = x, .y = y, .z = z}, {contact, count},
                {.within_m = slope_ * longest});
    for (std::size_t k = 0; k < count; ++k) decide(batch[k], contact[k], slope_ * radius[k]);
    return count;
  }

  // Decides about a piece by the contact of its center. A point of the piece may be nearer to the body than
  // the center by `fall_m`.
  void decide(const Piece& piece, const collision::Contact& center, float fall_m) {
    if (center.ellipsoid == collision::kNoEllipsoid || center.signed_distance - fall_m >= -tolerance_m_)
      return;
    if (center.signed_distance < -0.5f * tolerance_m_)
      note_deep(piece, center);
    else if (fall_m > 0.5f * tolerance_m_ && piece.cuts < kMostCuts)
      return cut(piece);
    if (!is_open(piece)) ++out_.open[run_], open_ |= bit_of(piece);
  }

  // A triangle with an open piece is not looked at again until it has moved, because its other pieces cannot
  // prove it.
  static_assert(kRun <= 64);
  std::uint64_t bit_of(const Piece& piece) const {
    return std::uint64_t{1} << (piece.element - f_.elements.run_begin[run_]);
  }
  bool is_open(const Piece& piece) const { return (open_ & bit_of(piece)) != 0; }

  void note_deep(const Piece& piece, const collision::Contact& center) {
    std::uint32_t& count = out_.deep_count[run_];
    if (count == kDeepARun) return;
    FaceSample& s = out_.deep[run_ * kDeepARun + count++];
    const Element& e = f_.elements.all[piece.element];
    std::ranges::copy(e.particle, s.particle);
    for (int b = 0; b < 2; ++b)
      s.weight[b] = (piece.weight[0][b] + piece.weight[1][b] + piece.weight[2][b]) / 3.0f;
    const Float4 where = at(p_, e, s.weight[0], s.weight[1]);
    for (int axis = 0; axis < 3; ++axis) s.at[axis] = where[axis], s.normal[axis] = center.normal[axis];
    s.distance_m = center.signed_distance;
  }

  void cut(const Piece& piece) {
    float middle[3][2];  // of the edge from each corner to the next one
    for (int c = 0; c < 3; ++c)
      for (int b = 0; b < 2; ++b) middle[c][b] = 0.5f * (piece.weight[c][b] + piece.weight[(c + 1) % 3][b]);
    for (int corner = 0; corner < 4; ++corner) {
      Piece& part = piece_[pieces_++];
      part = {.element = piece.element, .cuts = piece.cuts + 1};
      for (int b = 0; b < 2; ++b) {
        part.weight[0][b] = corner < 3 ? piece.weight[corner][b] : middle[0][b];
        part.weight[1][b] = corner < 3 ? middle[corner][b] : middle[1][b];
        part.weight[2][b] = corner < 3 ? middle[(corner + 2) % 3][b] : middle[2][b];
      }
    }
  }

  const collision::Collider& body_;
  const float tolerance_m_;
  const FaceContact& f_;
  const Particles& p_;
  const std::size_t run_;
  FaceCertificate& out_;
  float slope_ = 1.0f;
  std::uint64_t open_ = 0;  // bits of the run's triangles without a proof
  std::size_t pieces_ = 0;
  Piece piece_[kMostPieces];
};

// Pushes one point to the body's surface, as contact does.
void push(const FaceSample& s, const FaceContact& f, Particles& p, FaceCertificate& c) {
  const std::array<float, 3> weight = weights_of(s);
  Float4 moved = -vector_of(s.at);
  std::array<float, 3> inverse_mass;
  for (int k = 0; k < 3; ++k) {
    const Index i = s.particle[k];
    moved += weight[k] * Float4{p.x[i], p.y[i], p.z[i], 0.0f};
    inverse_mass[k] = p.point[i].weight;
  }
  const float yielding = yielding_of(weight, inverse_mass);
  const float depth = -(s.distance_m + dot(vector_of(s.normal), moved));
  if (!(depth > 0.0f) || !(yielding > 0.0f) || !is_on_its_side(s, f)) return;
  for (int k = 0; k < 3; ++k) {
    const Index i = s.particle[k];
    const float by = depth * p.point[i].weight * weight[k] / yielding;
    if (by == 0.0f) continue;
    p.x[i] += by * s.normal[0], p.y[i] += by * s.normal[1], p.z[i] += by * s.normal[2];
    c.moved[i / kTravelCluster] = 1;
  }
}

}  // namespace

FaceCertificate make_certificate(const Elements& elements, std::size_t particles) {
  FaceCertificate c;
  c.due.resize(elements.runs()), c.open.resize(elements.runs()), c.deep_count.resize(elements.runs());
  c.deep.resize(elements.runs() * kDeepARun);
  c.moved.resize(engine::block_count(particles, kTravelCluster));
  return c;
}

FaceProof prove_faces(const engine::Context& context, const collision::Collider& body, float tolerance_m,
                      const FaceContact& f, Particles& p, FaceCertificate& c) {
  FaceProof proof;
  proof.tolerance_m = tolerance_m;
  std::ranges::fill(c.due, std::uint8_t{1});
  for (int round = 0;; ++round) {
    proof.samples += engine::ordered_reduce(
        context, c.due.size(), std::max(kProofGrain, c.due.size() / 64 + 1), std::size_t{0},
        [&](std::size_t begin, std::size_t end) {
          std::size_t samples = 0;
          for (std::size_t run = begin; run < end; ++run)
            if (c.due[run]) samples += Prover(body, tolerance_m, f, p, run, c).prove();
          return samples;
        },
        std::plus<>());
    if (round == kRounds) break;
    std::ranges::fill(c.moved, std::uint8_t{0});
    for (std::size_t run = 0; run < c.due.size(); ++run)
      for (std::uint32_t k = 0; c.due[run] && k < c.deep_count[run]; ++k)
        push(c.deep[run * kDeepARun + k], f, p, c);
    bool any = false;
    for (std::size_t run = 0; run < c.due.size(); ++run) {
      const auto clusters = f.elements.clusters_of(run);
      c.due[run] = std::ranges::any_of(clusters, [&](std::uint32_t k) { return c.moved[k] != 0; });
      any = any || c.due[run];
    }
    if (!any) break;
  }
  for (const std::uint32_t open : c.open) proof.open += open;
  return proof;
}

}  // namespace bodice::cloth
