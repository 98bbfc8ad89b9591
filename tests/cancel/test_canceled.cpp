// Every public function that takes a Context and returns a Result is canceled at one checkpoint after
// another. It returns kCanceled, or its result if it ended before. It throws nothing.
#include <doctest/doctest.h>

#include <functional>
#include <string>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/engine/cancel.hpp>
#include <bodice/fitting/enclose_parts.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/geometry/mesh_repair.hpp>
#include <bodice/io/import.hpp>
#include <bodice/io/obj.hpp>
#include <bodice/io/rig.hpp>
#include <bodice/proxy/proxy_surface.hpp>
#include <bodice/rigging/make_rig.hpp>
#include <bodice/synth/body.hpp>
#include <bodice/synth/garment.hpp>
#include <bodice/tryon/drape.hpp>
#include <bodice/tryon/reach.hpp>
#include <bodice_test/temp_folder.hpp>

using namespace bodice;
using engine::Context;
using engine::ErrorCode;

namespace {

/// A serial executor that cancels the work at its checkpoint number `at`, counted from 0.
class CancellingExecutor final : public engine::Executor {
 public:
  explicit CancellingExecutor(int at) : left_(at) {
    if (at == 0) source_.cancel();
  }
  int concurrency() const noexcept override { return 1; }
  void bulk(std::size_t count, engine::FunctionRef<void(std::size_t)> body) override {
    for (std::size_t i = 0; i < count; ++i) body(i);
  }
  void yield() noexcept override {
    if (--left_ == 0) source_.cancel();
  }
  Context context() { return {.executor = this, .cancel = source_.token()}; }

 private:
  engine::CancelSource source_;
  int left_;
};

using Call = std::function<engine::Result<void>(const Context&)>;

/// The same Result without its value.
template <class T>
engine::Result<void> outcome(const engine::Result<T>& result) {
  if (result.ok()) return {};
  return result.error();
}

struct Subjects {
  synth::Body body = *synth::make_body({}, {.vertices = 1500});
  body::ProportionProfile profile = *body::find_profile("ansur2");
  fitting::LabeledSkin skin{body.mesh, body.part, body.stature_m};
  proxy::BodyProxy proxy = *fitting::enclose_parts({}, skin, fitting::kAllParts);
  tryon::PreparedBody worn = *tryon::fit_proxy({}, *tryon::segment_builtin({}, {.vertices = 1500}, {}),
                                               {.tier = proxy::Tier::kPaper});
  geometry::TriMesh patch{{{-0.1, 1.2, 0.3}, {0.1, 1.2, 0.3}, {0.0, 1.3, 0.3}}, {{0, 1, 2}}};
  bodice_test::TempFolder folder;
  std::filesystem::path file = folder / "body.obj", open_file = folder / "open.obj";
};

/// A skin without some triangles, and a part of it as a second piece beside it.
geometry::TriMesh opened(const geometry::TriMesh& whole) {
  geometry::TriMesh mesh = whole;
  mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + 40);
  const auto first = static_cast<geometry::Index>(mesh.positions.size());
  for (const geometry::Vec3& p : whole.positions) mesh.positions.push_back(p + geometry::Vec3(1.5, 0.0, 0.0));
  for (std::size_t t = 0; t < whole.triangles.size() / 8; ++t)
    mesh.triangles.push_back(
        {whole.triangles[t][0] + first, whole.triangles[t][1] + first, whole.triangles[t][2] + first});
  return mesh;
}

/// The number of checkpoints that the call reached; it is canceled at each of them in turn.
int cancel_everywhere(const std::string& name, const Call& call) {
  CAPTURE(name);
  int reached = 0;
  for (int at : {0, 1, 2, 3, 5, 8, 13, 21, 34, 55, 89, 144}) {
    CAPTURE(at);
    CancellingExecutor executor(at);
    engine::Result<void> result;
    CHECK_NOTHROW(result = call(executor.context()));
    if (result.ok()) break;
    REQUIRE(result.error().code == ErrorCode::kCanceled);
    CHECK(result.error().message.find("anceled") != std::string::npos);  // or "Canceled at ..."
    ++reached;
  }
  return reached;
}

}  // namespace

TEST_CASE("canceled work is kCanceled from every public function, wherever it is cut") {
  const Subjects of;
  REQUIRE(io::write_obj(of.body.mesh, of.file).ok());
  REQUIRE(io::write_obj(opened(of.body.mesh), of.open_file).ok());
  const struct {
    const char* name;
    Call call;
  } rows[] = {
      {"repair", [&](const Context& c) { return outcome(geometry::repair(c, of.body.mesh)); }},
      {"proxy_surface", [&](const Context& c) { return outcome(proxy::proxy_surface(c, of.proxy, 0.05)); }},
      {"make_body", [&](const Context& c) { return outcome(synth::make_body(c, {.vertices = 1500})); }},
      {"make_garment",
       [&](const Context& c) {
         return outcome(synth::make_garment(
             c, {of.body.mesh, of.body.part, of.body.landmarks, of.body.stature_m}, {.edge_length_m = 0.05}));
       }},
      {"analyze", [&](const Context& c) { return outcome(anatomy::analyze(c, of.body.mesh, {of.profile})); }},
      {"enclose_parts",
       [&](const Context& c) { return outcome(fitting::enclose_parts(c, of.skin, fitting::kAllParts)); }},
      {"fit",
       [&](const Context& c) {
         return outcome(fitting::fit(c, of.skin, {.tier = proxy::Tier::kSolid, .max_ellipsoids = 20}));
       }},
      {"segment_file", [&](const Context& c) { return outcome(tryon::segment_file(c, of.file, {})); }},
      {"segment_mesh",
       [&](const Context& c) { return outcome(tryon::segment_mesh(c, of.worn.skin.input, {})); }},
      {"fit_proxy",
       [&](const Context& c) {
         return outcome(
             tryon::fit_proxy(c, of.worn.skin, {.tier = proxy::Tier::kSolid, .max_ellipsoids = 20}));
       }},
      {"reachable_parts",
       [&](const Context& c) {
         return outcome(tryon::reachable_parts(c, of.worn.skin, {&of.body.mesh, 1}, 0.05));
       }},
      {"within_reach",
       [&](const Context& c) {
         return outcome(tryon::within_reach(c, of.proxy, {&of.body.mesh, 1}, 0.05));
       }},
      {"drape",
       [&](const Context& c) {
         return outcome(tryon::drape(c, of.worn, {{.name = "patch", .mesh = of.patch}}, {.frames = 2}));
       }},
      {"import_body", [&](const Context& c) { return outcome(io::import_body(c, of.file)); }},
      {"import_body, an open skin in two pieces",
       [&](const Context& c) { return outcome(io::import_body(c, of.open_file)); }},
      {"import_rigged_body", [&](const Context& c) { return outcome(io::import_rigged_body(c, of.file)); }},
      {"make_rig",
       [&](const Context& c) {
         return outcome(rigging::make_rig(c, of.worn.skin.input.skin, of.worn.skin.anatomy));
       }},
      {"import_garment", [&](const Context& c) { return outcome(io::import_garment(c, of.file, {})); }},
  };
  for (const auto& row : rows) {
    CHECK_MESSAGE(cancel_everywhere(row.name, row.call) > 0, row.name);
    CHECK_MESSAGE(row.call({}).ok(), row.name);
  }
}
