#include <bodice/synth/scan.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <bodice/engine/catch_canceled.hpp>
#include <bodice/geometry/contour.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/synth/body.hpp>
#include <bodice/synth/thing.hpp>

#include "scan/camera.hpp"
#include "scan/flaws.hpp"
#include "scan/hair.hpp"
#include "scan/pieces.hpp"
#include "scan/props.hpp"
#include "scan/solid.hpp"

namespace bodice::inline v0_1::synth {
namespace {

using geometry::Box;
using geometry::DistanceField;
using geometry::MeshDistance;
using geometry::TriMesh;
using geometry::Vec3;

constexpr double kCameraRadius_m = 2.2;

/// A shirt's hem that stands off the trunk at a level. `skin` is the body's signed distance.
DistanceField hem(const DistanceField& skin, double level_m) {
  return [skin, level_m](const Vec3& p) {
    const double band = std::max(skin(p) - 0.025, std::abs(p.y() - level_m) - 0.012);
    const double trunk = std::hypot(p.x(), p.z()) - 0.24;
    return std::max(band, trunk);
  };
}

/// Makes one scan, in the body's own coordinates until the end.
class Scanner {
 public:
  Scanner(const engine::Context& context, ScanKind kind, std::uint64_t seed, ScanSubjects subjects)
      : context_(context),
        kind_(kind),
        random_(seed, 0xF1A5 + static_cast<std::uint64_t>(kind)),
        body_(std::move(subjects.body)),
        other_(std::move(subjects.other)) {
    scan_.persons.push_back({body_.mesh, body_.landmarks, body_.stature_m});
  }

  engine::Result<Scan> run() {
    switch (kind_) {
      case ScanKind::kBooth:
      case ScanKind::kFewCameras:
      case ScanKind::kPatches:
      case ScanKind::kFloorLoose:
        photograph();
        break;
      case ScanKind::kPieces:
      case ScanKind::kTucked:
      case ScanKind::kClothes:
        for (auto& piece : cut_to_pieces(kind_, body_)) scan_.meshes.push_back(std::move(piece));
        break;
      case ScanKind::kSeated:
      case ScanKind::kLow:
        add("body", body_.mesh);
        break;
      case ScanKind::kChairBeside:
      case ScanKind::kChairInMesh:
        sit_on_chair();
        break;
      case ScanKind::kTwoApart:
      case ScanKind::kTwoClose:
        append(second_person(), merged());
        break;
      case ScanKind::kNoise:
      case ScanKind::kStrongNoise:
        add_roughness();
        break;
      default:
        fuse();
    }
    to_file();
    return std::move(scan_);
  }

 private:
  void add(std::string name, TriMesh mesh) { scan_.meshes.push_back({std::move(name), std::move(mesh)}); }

  /// The one mesh of the scan, with the body in it.
  TriMesh& merged() {
    if (scan_.meshes.empty()) add("scan", body_.mesh);
    return scan_.meshes.front().shape;
  }

  void photograph() {
    TriMesh noisy = body_.mesh;
    add_noise(0.0015, random_, noisy);
    const bool patches = kind_ == ScanKind::kPatches;
    const int count = kind_ == ScanKind::kFewCameras ? 3 : patches ? 6 : 8;
    const auto cameras =
        ring_of_cameras(count, kCameraRadius_m, random_.uniform(0.0, 6.0), 0.5 * body_.stature_m);
    const std::vector<int> seen = best_cameras(context_, noisy, cameras);
    TriMesh scan;
    if (!patches) scan = take_others(noisy, seen, -1);
    for (int c = 0; patches && c < count; ++c) {
      TriMesh patch = take(noisy, seen, c);
      shift(0.002 * Vec3(random_.normal(), random_.normal(), random_.normal()), patch);
      append(patch, scan);
    }
    for (int i = 0; i < 8; ++i) {
      const Vec3 around(random_.uniform(-0.6, 0.6), random_.uniform(0.0, 2.0), random_.uniform(-0.6, 0.6));
      append(debris(around, 0.01, random_), scan);
    }
    if (kind_ == ScanKind::kFloorLoose) {
      TriMesh sheet = floor_sheet(1.6, 0.03, 0.003, random_);
      shift({0.0, -0.004, 0.0}, sheet);
      append(sheet, scan);
    }
    add("scan", std::move(scan));
  }

  void sit_on_chair() {
    TriMesh boards = make_chair(seat_of(body_) - Vec3(0.0, 0.003, 0.0), 0.04);
    if (kind_ == ScanKind::kChairBeside) {
      add("body", body_.mesh);
      add("chair", std::move(boards));
    } else {
      append(boards, merged());
    }
  }

  /// The other body, beside this one: so far to its left that the skins are a gap apart.
  TriMesh second_person() {
    const double gap = kind_ == ScanKind::kTwoApart   ? random_.uniform(0.3, 0.8)
                       : kind_ == ScanKind::kTwoClose ? random_.uniform(0.01, 0.04)
                                                      : -random_.uniform(0.005, 0.02);
    const MeshDistance distance(context_, body_.mesh);
    double low = 0.0, high = 3.0;
    while (high - low > 1e-3) {
      const double middle = 0.5 * (low + high);
      double least = high;
      for (const Vec3& p : other_.mesh.positions)
        least = std::min(least, distance.signed_distance(p + middle * Vec3::UnitX()));
      (least < gap ? low : high) = middle;
    }
    const Vec3 by = high * Vec3::UnitX();
    shift(by, other_.mesh);
    for (auto& mark : other_.landmarks) mark.position += by;
    scan_.persons.push_back({other_.mesh, other_.landmarks, other_.stature_m});
    return other_.mesh;
  }

  void add_roughness() {
    TriMesh& mesh = merged();
    const bool strong = kind_ == ScanKind::kStrongNoise;
    if (strong) add_waves(0.003, random_, mesh);
    const std::vector<Vec3> normal = vertex_normals(mesh);
    add_noise(strong ? 0.004 : 0.0015, random_, mesh);
    for (std::size_t v = 0; strong && v < normal.size(); ++v)
      if (random_.below(20) == 0) mesh.positions[v] += (random_.below(2) == 0 ? 0.01 : -0.01) * normal[v];
  }

  /// The kinds that are one surface around a field.
  void fuse() {
    const MeshDistance body(context_, body_.mesh);
    const DistanceField skin = [&](const Vec3& p) { return body.signed_distance(p); };
    Solid all{skin, geometry::bounding_box(body_.mesh.positions)};
    std::optional<MeshDistance> second;
    if (kind_ == ScanKind::kWebbed) {  // what lies within 9 mm of itself grows together
      all.distance = [skin](const Vec3& p) { return skin(p) - 0.004; };
    } else if (kind_ == ScanKind::kFloorJoined) {
      all.add(solid_of({{{-0.8, -0.03, -0.8}, {0.8, 0.006, 0.8}}}));
    } else if (kind_ == ScanKind::kChairFused) {
      all.add(solid_of(chair(seat_of(body_) + Vec3(0.0, 0.01, 0.0))));
    } else if (kind_ == ScanKind::kBunAndHem) {
      all.add(hair_in_a_bun(body_, random_));
      all.add({hem(skin, 0.52 * body_.stature_m), {}});
    } else if (kind_ == ScanKind::kLongHair) {
      all.add(hair_that_hangs(body_, skin, random_));
    } else if (kind_ == ScanKind::kTwoFused) {
      const TriMesh other = second_person();
      second.emplace(context_, other);
      all.add({[&](const Vec3& p) { return second->signed_distance(p); },
               geometry::bounding_box(other.positions)});
    }
    TriMesh mesh =
        geometry::contour(context_, geometry::sample_field(context_, all.distance, all.box, cell_m()));
    finish(mesh);
    add("scan", std::move(mesh));
  }

  double cell_m() const {
    if (kind_ == ScanKind::kWebbed) return 0.018;
    if (kind_ == ScanKind::kPhotogrammetry) return 0.006;
    return kind_ == ScanKind::kClosed ? 0.008 : 0.01;
  }

  void finish(TriMesh& mesh) {
    if (kind_ == ScanKind::kClosed) add_waves(0.003, random_, mesh);
    if (kind_ == ScanKind::kPhotogrammetry) {
      jitter(0.45, random_, mesh);
      add_noise(0.001, random_, mesh);
    }
    if (kind_ != ScanKind::kFloorJoined) return;
    std::vector<int> under(mesh.triangles.size());  // a phone sees a floor from above alone
    for (std::size_t t = 0; t < under.size(); ++t)
      under[t] = std::min({mesh.corner(t, 0).y(), mesh.corner(t, 1).y(), mesh.corner(t, 2).y()}) < 0.0;
    mesh = take(mesh, under, 0);
  }

  /// Turns and moves the body, and everything to the unit and axes of the file.
  void to_file() {
    const bool millimeters = kind_ == ScanKind::kPhotogrammetry;
    constexpr std::array kUnits_m = {1.0, 0.01, 0.001};
    scan_.frame.meters_per_unit = millimeters ? 0.001 : kUnits_m[random_.below(3)];
    scan_.frame.up = millimeters || random_.below(2) == 0 ? geometry::Axis::kZ : geometry::Axis::kY;
    const double heading = random_.uniform(0.0, 2.0 * std::numbers::pi);
    const Eigen::AngleAxisd turn(heading, Vec3::UnitY());
    const Vec3 by(random_.uniform(-0.5, 0.5), 0.0, random_.uniform(-0.5, 0.5));
    const auto moved = [&](const Vec3& p) { return Vec3(turn * p + by); };
    for (ScanPerson& person : scan_.persons) {
      for (Vec3& p : person.body.positions) p = moved(p);
      for (auto& mark : person.landmarks) mark.position = moved(mark.position);
    }
    for (ScanMesh& mesh : scan_.meshes)
      for (Vec3& p : mesh.shape.positions) p = scan_.frame.to_file(moved(p));
  }

  const engine::Context& context_;
  ScanKind kind_;
  engine::Random random_;
  Body body_, other_;
  Scan scan_;
};

}  // namespace

std::string_view name(ScanKind kind) {
  constexpr std::array<std::string_view, kScanKindCount> kScanNames = {
      "booth",        "few cameras", "patches",     "closed",       "fused",          "webbed",
      "floor joined", "floor loose", "bun and hem", "long hair",    "photogrammetry", "pieces",
      "tucked",       "clothes",     "seated",      "chair beside", "chair in mesh",  "chair fused",
      "two apart",    "two close",   "two fused",   "low",          "noise",          "strong noise"};
  return kScanNames[static_cast<std::size_t>(kind)];
}

engine::Result<Scan> make_scan(const engine::Context& context, ScanKind kind, std::uint64_t seed,
                               ScanSubjects subjects) {
  return engine::catch_canceled("The making of the scan", [&]() -> engine::Result<Scan> {
    return Scanner(context, kind, seed, std::move(subjects)).run();
  });
}

}  // namespace bodice::synth
