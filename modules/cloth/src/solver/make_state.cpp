#include <algorithm>
#include <cmath>
#include <string>

#include "base/check_options.hpp"
#include "solver/state.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

// The limit of a tie exceeds its distance along the cloth by this fraction of the strain limit. More is not
// needed, because distances along edges are 2 % too long.
constexpr double kCoarseSlack = 0.25;

// The threshold of continuous collision, a fraction of the longest travel in a substep: 5 mm for a garment a
// meter across, which is within the radius of fingers.
constexpr float kCcdThreshold = 0.1f;

// Puts the particles in Morton order and updates the map from vertices.
void reorder(WeldedGarment& garment) {
  const std::vector<Index> order = morton_order(garment.mesh.positions);
  std::vector<Index> index(order.size());
  std::vector<Vec3> positions;
  for (Index i = 0; i < order.size(); ++i) {
    index[order[i]] = i;
    positions.push_back(garment.mesh.positions[order[i]]);
  }
  garment.mesh.positions = std::move(positions);
  for (Triangle& t : garment.mesh.triangles) t = {index[t[0]], index[t[1]], index[t[2]]};
  for (Index& p : garment.particle_of_vertex) p = p == geometry::kNoIndex ? p : index[p];
}

Pins make_pins(const WeldedGarment& garment, std::span<const Index> pinned,
               std::vector<engine::Warning>& warnings) {
  Pins pins;
  std::size_t unknown = 0;
  for (const Index v : pinned) {
    const bool known =
        v < garment.particle_of_vertex.size() && garment.particle_of_vertex[v] != geometry::kNoIndex;
    pins.particle.push_back(known ? garment.particle_of_vertex[v] : geometry::kNoIndex);
    pins.to.push_back(known ? garment.mesh.positions[pins.particle.back()] : Vec3(Vec3::Zero()));
    if (!known) ++unknown;
  }
  if (unknown > 0) {
    warnings.push_back({"garment-pins-dropped", "garment",
                        std::to_string(unknown) + " pins name a vertex that does not exist or was dropped.",
                        ""});
  }
  pins.from = pins.to;
  return pins;
}

std::vector<bool> pinned_particles(const Pins& pins, std::size_t particles) {
  std::vector<bool> out(particles, false);
  for (const Index p : pins.particle) {
    if (p != geometry::kNoIndex) out[p] = true;
  }
  return out;
}

// The reported position of each vertex that is dropped: its input position, or the garment's center if that
// is not finite.
std::vector<Vec3> reported_positions(const geometry::TriMesh& garment, const geometry::TriMesh& particles) {
  const Vec3 center = geometry::bounding_box(particles.positions).center();
  std::vector<Vec3> out = garment.positions;
  for (Vec3& p : out) p = p.allFinite() ? p : center;
  return out;
}

// The garment's edges with its threads, because both hold the cloth together.
Topology with_threads(Topology topology, std::span<const Thread> threads) {
  for (const Thread& t : threads)
    topology.edges.push_back({std::min(t.a, t.b), std::max(t.a, t.b), 0.0, false});
  const auto ends = [](const Edge& e) { return std::pair(e.a, e.b); };
  std::ranges::stable_sort(topology.edges, {}, ends);
  const auto repeated = std::ranges::unique(topology.edges, {}, ends);
  topology.edges.erase(repeated.begin(), repeated.end());
  return topology;
}

}  // namespace

engine::Result<State> make_state(const geometry::TriMesh& garment, std::span<const Index> pinned,
                                 const Fabric& fabric, const SolverOptions& options,
                                 std::span<const Tack> tacks) {
  if (auto good = check(fabric); !good) return good.error();
  if (auto good = check(options); !good) return good.error();
  auto welded = weld(garment);
  if (!welded) return welded.error();
  reorder(*welded);
  State s;
  s.fabric = fabric;
  s.options = options;
  s.warnings = std::move(welded->warnings);
  const geometry::TriMesh& mesh = welded->mesh;
  s.pins = make_pins(*welded, pinned, s.warnings);
  s.pins.yield = options.pins_yield;
  s.particles = make_particles(mesh, fabric.density_kg_m2, pinned_particles(s.pins, mesh.positions.size()));
  const Topology topology = find_topology(mesh);
  s.stretch = make_stretch(mesh, topology, fabric, s.particles);
  s.bend = make_bend(mesh, topology, fabric, s.particles);
  s.threads = make_threads(tacks, welded->particle_of_vertex, mesh.positions);
  const Topology together = with_threads(topology, s.threads);
  s.coarse = make_coarse(mesh, together, welded->median_edge_m, kCoarseSlack * fabric.max_stretch);
  update_weights({}, s.particles, s.coarse);  // later whenever a particle falls asleep or wakes
  s.air = make_air(mesh);
  s.ring = make_ring(mesh, together);
  if (options.self_collision)
    s.self = make_self_contact(mesh, s.particles, options.layer_gap_m, welded->median_edge_m);
  s.sleep = make_sleep(s.particles.count(), welded->median_edge_m);
  s.contacts = make_contacts(s.particles.count(), fabric.friction,
                             make_face_contact(mesh, topology, options, welded->median_edge_m, s.particles));
  if (options.certify_m && !s.contacts.faces.elements.all.empty())
    s.contacts.certificate = make_certificate(s.contacts.faces.elements, s.particles.count());
  s.strain.resize(s.stretch.slots());
  s.scratch.resize(s.particles.count());
  s.selection = make_selection(std::max(s.stretch.slots(), s.particles.count()));
  s.max_travel_m = static_cast<float>(kMaxTravel * geometry::bounding_box(mesh.positions).size().norm());
  s.contacts.motion.ccd_threshold_m = kCcdThreshold * s.max_travel_m;
  s.input = reported_positions(garment, mesh);
  s.particle_of_vertex = std::move(welded->particle_of_vertex);
  return s;
}

bool set_positions(std::span<const Vec3> world_positions, State& s) {
  if (world_positions.size() != s.particle_of_vertex.size()) return false;
  if (!std::ranges::all_of(world_positions, [](const Vec3& p) { return p.allFinite(); })) return false;
  Particles& p = s.particles;
  for (std::size_t v = world_positions.size(); v-- > 0;) {
    const Index i = s.particle_of_vertex[v];
    if (i == geometry::kNoIndex) continue;
    const Eigen::Vector3f at = (world_positions[v] - p.origin).cast<float>();
    p.x[i] = at.x(), p.y[i] = at.y(), p.z[i] = at.z();
    p.vx[i] = p.vy[i] = p.vz[i] = 0.0f;
    p.point[i] = {at.x(), at.y(), at.z(), p.point[i].weight};
  }
  for (std::size_t k = 0; k < s.pins.particle.size(); ++k)
    if (s.pins.particle[k] != geometry::kNoIndex) s.pins.from[k] = p.world(s.pins.particle[k]);
  wake_all(s.sleep);
  s.self.crossings_known = false, forget_pairs(s.self);
  forget_owners(s.contacts.motion);
  return true;
}

}  // namespace bodice::cloth
