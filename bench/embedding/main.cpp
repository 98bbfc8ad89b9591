// What does the C interface cost beside the C++ call, with particles as hosts have them? One thread, a made
// body, 10,000 particles within 30 mm of the skin. All are measured in turns; the fastest of many calls
// counts. Structures in the world are compared with a C++ program that copies them to and fro by hand. --help
// has the arguments.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include <bodice.hpp>
#include <bodice/collision/collider.hpp>
#include <bodice/engine/random.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/proxy/proxy_file.hpp>
#include <bodice/synth/body.hpp>

#include <bench_support/help.hpp>
#include <bench_support/median.hpp>

#include "frame.hpp"

using namespace bodice;

namespace {

/// Particles in the forms that are compared; every call begins from the same positions.
struct Particles {
  std::vector<float> x, y, z;  ///< local frame
  std::vector<float> xyz;      ///< world
};

Particles near_skin(const synth::Body& body, const geometry::Vec3& origin, std::size_t count) {
  engine::Random random(1);
  Particles all;
  for (std::size_t i = 0; i < count; ++i) {
    const auto v = i * body.mesh.positions.size() / count;
    geometry::Vec3 p = body.mesh.positions[v];
    for (int axis = 0; axis < 3; ++axis) p[axis] += random.uniform(-0.017, 0.017);
    const Eigen::Vector3f local = (p - origin).cast<float>();
    all.x.push_back(local.x()), all.y.push_back(local.y()), all.z.push_back(local.z());
    for (int axis = 0; axis < 3; ++axis) all.xyz.push_back(static_cast<float>(p[axis]));
  }
  return all;
}

template <class Call>
double microseconds(Call&& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}

/// The times of many calls of each, in turns.
struct Times {
  std::vector<double> cpp_us, soa_us, by_hand_us, aos_us;
};

template <class Call>
void take(std::vector<double>& us, Call&& call) {
  us.push_back(microseconds(call));
}

constexpr double kBar = 1.02;  ///< what the C interface may cost at most, in times of the C++ call

/// The median of the ratios of calls that follow each other: that the processor changes its clock in between
/// falls on both.
double ratio(const std::vector<double>& us, const std::vector<double>& to_us) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < us.size(); ++i) ratios.push_back(us[i] / to_us[i]);
  return bench::median(std::move(ratios));
}

/// Prints a row of medians; returns whether both forms are within the bar.
bool print(const char* name, const char* call, const Times& t) {
  const double soa = ratio(t.soa_us, t.cpp_us), aos = ratio(t.aos_us, t.by_hand_us);
  std::printf("| %s, %s | %.1f | %.1f (%+.1f %%) | %.1f | %.1f (%+.1f %%) |\n", name, call,
              bench::median(t.cpp_us), bench::median(t.soa_us), 100.0 * (soa - 1.0),
              bench::median(t.by_hand_us), bench::median(t.aos_us), 100.0 * (aos - 1.0));
  return soa <= kBar && aos <= kBar;
}

/// What a C++ program with particles as structures in the world does.
struct ByHand {
  const geometry::Vec3& origin;
  Particles& now;

  void in() const {
    for (std::size_t i = 0; i < now.x.size(); ++i) {
      now.x[i] = static_cast<float>(double{now.xyz[3 * i]} - origin.x());
      now.y[i] = static_cast<float>(double{now.xyz[3 * i + 1]} - origin.y());
      now.z[i] = static_cast<float>(double{now.xyz[3 * i + 2]} - origin.z());
    }
  }
  void out() const {
    for (std::size_t i = 0; i < now.x.size(); ++i) {
      now.xyz[3 * i] = static_cast<float>(double{now.x[i]} + origin.x());
      now.xyz[3 * i + 1] = static_cast<float>(double{now.y[i]} + origin.y());
      now.xyz[3 * i + 2] = static_cast<float>(double{now.z[i]} + origin.z());
    }
  }
  void out(std::vector<collision::Contact>& contacts) const {
    for (collision::Contact& contact : contacts)
      for (int axis = 0; axis < 3; ++axis)
        contact.point[axis] = static_cast<float>(double{contact.point[axis]} + origin[axis]);
  }
};

void write(const std::filesystem::path& file, const void* bytes, std::size_t size) {
  std::ofstream(file, std::ios::binary)
      .write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
}

/// Distances alone of points in the world, part after part as rows.py has it.
void measure_distances(const char* name, const ::bodice::Collider& collider, std::vector<float>& xyz,
                       ::bodice::Workspace& workspace, int rounds) {
  constexpr std::size_t kPart = 10000;
  std::vector<float> distance(kPart);
  bodice_contacts out = bodice_default_contacts();
  out.distance = {distance.data(), 0, BODICE_FLOAT, 0};
  double sum_us = 0.0;
  for (std::size_t begin = 0; begin < xyz.size() / 3; begin += kPart) {
    ::bodice::Particles part(std::min(kPart, xyz.size() / 3 - begin));
    part.position(&xyz[3 * begin]);
    double least_us = 1e300;
    for (int round = 0; round < rounds; ++round)
      least_us = std::min(least_us, microseconds([&] { collider.query(part, workspace, out); }));
    sum_us += least_us;
  }
  std::printf("distances %s %.1f\n", name, sum_us);
}

/// Returns whether all calls are within the bar.
bool measure(const char* name, const synth::Body& body, proxy::Tier tier, std::size_t count, int rounds,
             const char* folder) {
  const engine::Context engine_context;
  const auto fit = fitting::fit(engine_context, {body.mesh, body.part, body.stature_m}, {.tier = tier});
  if (!fit) std::exit((std::puts(fit.error().sentence().c_str()), 1));
  const std::vector<std::byte> bytes = proxy::to_binary(fit->proxy);
  auto context = Context::create();
  auto handle = Proxy::from_bytes(*context, bytes.data(), bytes.size());
  // Where colliders and workspaces lie in memory changes a call by up to 4 %: each side takes turns at
  // several.
  constexpr std::size_t kCopies = 3;
  std::vector<collision::Collider> engines;
  std::array<collision::Workspace, kCopies> workspaces;
  std::vector<::bodice::Collider> colliders;
  std::vector<::bodice::Workspace> c_soa, c_aos;
  for (std::size_t k = 0; k < kCopies; ++k) {
    engines.emplace_back(fit->proxy);
    colliders.push_back(std::move(*Collider::create(*context, *handle)));
    c_soa.push_back(std::move(*Workspace::create(*context)));
    c_aos.push_back(std::move(*Workspace::create(*context)));
  }

  const Particles start = near_skin(body, engines.front().origin(), count);
  Particles now = start;
  const collision::Particles particles{count, now.x.data(), now.y.data(), now.z.data()};
  ::bodice::Particles soa(count), aos(count);
  soa.space = BODICE_LOCAL;
  soa.bodice_particles::position = {now.x.data(), now.y.data(), now.z.data(), 0, BODICE_FLOAT, 0};
  aos.position(now.xyz.data());
  std::vector<collision::Contact> contacts(count);
  bodice_contacts out = bodice_default_contacts();
  out.contact = reinterpret_cast<bodice_contact*>(contacts.data());

  if (folder) {
    write(std::filesystem::path(folder) / (std::string(name) + ".bodice"), bytes.data(), bytes.size());
    write(std::filesystem::path(folder) / "points.f32", start.xyz.data(), start.xyz.size() * sizeof(float));
    measure_distances(name, colliders.front(), now.xyz, c_aos.front(), rounds);
    return true;
  }
  Times query, resolve;
  const geometry::Vec3 origin = engines.front().origin();
  const ByHand by_hand{origin, now};
  for (int round = 0; round < rounds; ++round) {
    const std::size_t k = static_cast<std::size_t>(round) % kCopies;
    take(query.cpp_us, [&] { engines[k].query(engine_context, particles, contacts, workspaces[k]); });
    take(query.soa_us, [&] { colliders[k].query(soa, c_soa[k], out); });
    take(query.by_hand_us, [&] {
      by_hand.in();
      engines[k].query(engine_context, particles, contacts, workspaces[k]);
      by_hand.out(contacts);
    });
    take(query.aos_us, [&] { colliders[k].query(aos, c_aos[k], out); });
  }
  for (int round = 0; round < rounds; ++round) {
    const std::size_t k = static_cast<std::size_t>(round) % kCopies;
    now = start;
    take(resolve.cpp_us, [&] { engines[k].resolve(engine_context, particles, {}, workspaces[k]); });
    now = start;
    take(resolve.soa_us, [&] { colliders[k].resolve(soa, c_soa[k]); });
    now = start;
    take(resolve.by_hand_us, [&] {
      by_hand.in();
      engines[k].resolve(engine_context, particles, {}, workspaces[k]);
      by_hand.out();
    });
    now = start;
    take(resolve.aos_us, [&] { colliders[k].resolve(aos, c_aos[k]); });
  }
  const bool queries_fast = print(name, "query", query);
  return print(name, "resolve", resolve) && queries_fast;
}

constexpr const char* kUsage =
    "embedding [PARTICLES] [ROUNDS] [FOLDER]    default: 10000 2000\n"
    "What a call of bodice.h costs beside the C++ call, on one thread, measured in turns:\n"
    "medians, and the medians of the ratios of calls that follow each other.\n"
    "Exits with 1 if a call takes over 2 % longer, or if a warm frame calls malloc.\n"
    "With a FOLDER, proxies and particles are written there, and distances alone are\n"
    "measured, for rows.py.\n";

}  // namespace

int main(int argc, char** argv) {
  if (bench::help_requested(argc, argv, kUsage)) return 0;
  const std::size_t count = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 10000;
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 2000;
  const auto body = synth::make_body(engine::Context{}, {});
  if (!body) return std::puts(body.error().sentence().c_str()), 1;
  std::printf("%s; %zu particles, microseconds a call\n\n", bodice_build(), count);
  const char* folder = argc > 3 ? argv[3] : nullptr;
  if (!folder)
    std::puts(
        "| proxy, call | C++, packed | C, the same arrays | C++, structures by hand | C, structures |\n"
        "|---|---|---|---|---|");
  bool is_fast = measure("tight", *body, proxy::Tier::kTight, count, rounds, folder);
  is_fast = measure("relief", *body, proxy::Tier::kRelief, count, rounds, folder) && is_fast;
  if (folder) return 0;
  std::puts(
      "\n| frame of 5,000 structures, microseconds: median (least) | pose | resolve | calls of malloc in 300 "
      "|\n"
      "|---|---|---|---|");
  std::size_t allocations = 0;
  for (const proxy::Tier tier : {proxy::Tier::kTight, proxy::Tier::kRelief}) {
    const auto fit = fitting::fit({}, {body->mesh, body->part, body->stature_m}, {.tier = tier});
    if (!fit) return std::puts(fit.error().sentence().c_str()), 1;
    allocations +=
        embedding::print_frames(*body, fit->proxy, tier == proxy::Tier::kTight ? "tight" : "relief");
  }
  if (!is_fast) std::puts("\nA call of C takes over 2 % longer than the C++ call.");
  if (allocations > 0) std::puts("\nA warm frame calls malloc.");
  return is_fast && allocations == 0 ? 0 : 1;
}
