#include "cases.hpp"

#include <algorithm>
#include <array>
#include <fstream>

#include <nlohmann/json.hpp>

#include <bodice/geometry/mesh_repair.hpp>

#include "read_mesh.hpp"

namespace bench {
namespace {

namespace fs = std::filesystem;
using bodice::geometry::kNoIndex;
using bodice::geometry::Vec3;
using nlohmann::json;

json read_json(const fs::path& file) {
  std::ifstream in(file);
  return json::parse(in);
}

std::vector<int> read_labels(const fs::path& file) {
  std::vector<int> labels;
  std::ifstream in(file, std::ios::binary);
  if (file.extension() == ".u8")
    for (char c; in.get(c);) labels.push_back(static_cast<unsigned char>(c));
  else
    for (int k; in >> k;) labels.push_back(k);
  return labels;
}

std::vector<int> coarse_of_fine(const fs::path& data) {
  return read_json(data / "labels" / "classes.json")["fine_to_coarse"].get<std::vector<int>>();
}

/// The file of a mesh's labels, as the data's README lists it.
fs::path labels_of(const fs::path& data, const fs::path& mesh) {
  const std::string stem = mesh.stem().string(), folder = mesh.parent_path().filename().string();
  if (folder == "bodies") return data / "labels" / "makehuman13380.labels.txt";
  if (folder == "big") return mesh.parent_path() / (stem + ".labels.u8");
  fs::path own = mesh.parent_path() / (stem + ".labels.txt");
  if (fs::exists(own)) return own;
  if (folder == "awkward" && stem.starts_with("f_avg_") && stem.find("soup") == std::string::npos &&
      stem.find("nonmanifold") == std::string::npos)
    return mesh.parent_path() / "f_avg_3000v.labels.txt";
  return {};
}

/// The truth of the body that a file was made from, if it is known.
fs::path truth_of(const fs::path& data, const fs::path& mesh) {
  const std::string stem = mesh.stem().string();
  if (mesh.parent_path().filename() == "bodies") return data / "bodies" / (stem + ".json");
  fs::path best;
  for (const auto& entry : fs::directory_iterator(data / "bodies"))
    if (entry.path().extension() == ".json" && stem.find(entry.path().stem().string()) != std::string::npos)
      best = entry.path();
  if (!best.empty() || mesh.parent_path().filename() != "awkward") return best;
  if (stem.starts_with("f_avg_")) return data / "bodies" / "f_avg_rest.json";
  return stem.starts_with("m_avg_") ? data / "bodies" / "m_avg_rest.json" : fs::path();
}

/// What some files changed in the position and unit of their body, as the data's README lists it.
struct Damage {
  double scale = 1.0;
  bool z_up = false;
  Vec3 shift = Vec3::Zero();
  Vec3 operator()(const Vec3& p) const { return scale * (z_up ? Vec3(p.x(), -p.z(), p.y()) : p) + shift; }
};

Damage damage_of(const std::string& stem) {
  if (stem == "f_avg_zup_cm") return {100.0, true, Vec3::Zero()};
  if (stem == "f_avg_far_origin") return {1.0, false, Vec3(1000.0, 50.0, -2000.0)};
  if (stem == "m_avg_as_exported_dm") return {10.0, false, Vec3::Zero()};
  return {};
}

Vec3 point(const json& j) {
  return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()};
}

void read_truth(const fs::path& file, Case& c) {
  const json j = read_json(file);
  c.stature = j["stature_rest_m"];
  c.landmarks["crown"] = point(j["landmarks"]["head_top"]);
  c.landmarks["perineum"] = point(j["landmarks"]["crotch"]);
  c.landmarks["neck"] = point(j["joints"]["neck"]);
  for (const std::string side : {"l", "r"}) {
    c.landmarks["fingertip_" + side] = point(j["landmarks"][side + "_fingertip"]);
    c.landmarks["toe_" + side] = point(j["landmarks"][side + "_toe_tip"]);
    c.landmarks["armpit_" + side] = point(j["landmarks"][side + "_armpit"]);
    c.landmarks["elbow_" + side] = point(j["joints"][side + "_elbow"]);
    c.landmarks["knee_" + side] = point(j["joints"][side + "_knee"]);
    c.landmarks["wrist_" + side] = point(j["joints"][side + "_wrist"]);
    c.landmarks["ankle_" + side] = point(j["joints"][side + "_ankle"]);
    c.joints["upper_arm_" + side] = point(j["joints"][side + "_shoulder"]);
    c.joints["thigh_" + side] = point(j["joints"][side + "_hip"]);
  }
  const std::pair<const char*, const char*> trunk[] = {{"pelvis", "pelvis"},
                                                       {"spine_lower", "spine_mid"},
                                                       {"spine_upper", "spine_upper"},
                                                       {"neck", "neck"},
                                                       {"head", "head"}};
  for (const auto& [ours, theirs] : trunk) c.joints[ours] = point(j["joints"][theirs]);
}

/// The poses that bodies are made in; everything in awkward/ is made from such a body but the fused one.
bool stands_at_rest(const std::string& stem) {
  return stem.find("rest") != std::string::npos || stem.find("tpose") != std::string::npos;
}

Case load(const fs::path& data, const fs::path& file, const std::vector<int>& coarse) {
  Case c{file.parent_path().filename().string() + "/" + file.filename().string(), {}, {}, {}, 0.0, false};
  c.rest = stands_at_rest(file.stem().string());
  c.kind = file.parent_path().filename().string();
  const auto repaired = bodice::geometry::repair({}, read_mesh(file));
  if (!repaired) return c;
  c.mesh = repaired->mesh;
  const fs::path labels = labels_of(data, file);
  if (!labels.empty()) {
    const std::vector<int> fine = read_labels(labels);
    c.truth.assign(c.mesh.positions.size(), -1);
    for (std::size_t i = 0; i < std::min(fine.size(), repaired->vertex_of_input.size()); ++i)
      if (repaired->vertex_of_input[i] != kNoIndex) c.truth[repaired->vertex_of_input[i]] = coarse[fine[i]];
  }
  const fs::path truth = truth_of(data, file);
  if (!truth.empty()) {
    read_truth(truth, c);
    const Damage damage = damage_of(file.stem().string());
    for (auto& [name, p] : c.landmarks) p = damage(p);
    for (auto& [name, p] : c.joints) p = damage(p);
    c.stature *= damage.scale;
  }
  return c;
}

}  // namespace

int coarse_class(bodice::body::Part part) {
  constexpr std::array<int, bodice::body::kPartCount> table = {0, 1, 1, 1, 1, 2, 2, 3, 7, 4, 8, 5, 9, 6, 10};
  return table[static_cast<std::size_t>(part)];
}

std::vector<int> body_labels(const fs::path& data) {
  const std::vector<int> coarse = coarse_of_fine(data);
  std::vector<int> labels = read_labels(data / "labels" / "makehuman13380.labels.txt");
  for (int& label : labels) label = coarse[label];
  return labels;
}

std::vector<Case> file_cases(const fs::path& data, const std::string& only) {
  const std::vector<int> coarse = coarse_of_fine(data);
  std::vector<fs::path> files;
  for (const char* folder : {"bodies", "counts", "big", "awkward"})
    for (const auto& entry : fs::directory_iterator(data / folder)) {
      const std::string ext = entry.path().extension().string();
      if ((ext == ".obj" || ext == ".ply" || ext == ".stl") &&
          entry.path().string().find(only) != std::string::npos)
        files.push_back(entry.path());
    }
  std::sort(files.begin(), files.end());
  std::vector<Case> cases;
  for (const fs::path& file : files) cases.push_back(load(data, file, coarse));
  return cases;
}

}  // namespace bench
