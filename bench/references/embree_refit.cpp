#include <bench_references/moving_peers.hpp>
#include <bench_references/skin_signs.hpp>

#ifdef BENCH_EMBREE
#include <embree3/rtcore.h>
#endif

namespace bench {

#ifdef BENCH_EMBREE

namespace {

using bodice::geometry::TrianglePoint;
using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;

class EmbreeRefit final : public MovingPeer {
 public:
  EmbreeRefit(const TriMesh& rest, double reach_m) : signs_(rest), reach_m_(static_cast<float>(reach_m)) {
    for (const auto& t : rest.triangles) indices_.insert(indices_.end(), t.begin(), t.end());
    vertices_.resize(3 * rest.positions.size() + 1);  // Embree reads sixteen bytes a vertex
    copy(rest);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
    geometry_ = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry_, RTC_BUILD_QUALITY_REFIT);
    rtcSetSharedGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices_.data(), 0,
                               12, rest.positions.size());
    rtcSetSharedGeometryBuffer(geometry_, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices_.data(), 0, 12,
                               rest.triangles.size());
    rtcCommitGeometry(geometry_);
    rtcAttachGeometry(scene_, geometry_);
    rtcCommitScene(scene_);
  }
  EmbreeRefit(const EmbreeRefit&) = delete;
  EmbreeRefit& operator=(const EmbreeRefit&) = delete;
  ~EmbreeRefit() override {
    rtcReleaseGeometry(geometry_);
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  std::string name() const override { return "Embree 3, refit, signs by normals"; }
  bool needs_skin() const override { return true; }
  bool knows_depth() const override { return false; }  // beyond its reach it finds no triangle and no side
  double bytes() const override { return 0.0; }

  void pose(const MovingFrame& frame) override {
    skin_ = &frame.skin;
    copy(frame.skin);
    rtcUpdateGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_);
    signs_.update(frame.skin);
  }

  void query(const Cloud& cloud, std::span<float> distance_m) override {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      Search search{skin_, cloud.at(i), bodice::geometry::kNoIndex, {}};
      RTCPointQuery query{cloud.x[i], cloud.y[i], cloud.z[i], 0.0f, reach_m_};
      RTCPointQueryContext context;
      rtcInitPointQueryContext(&context);
      rtcPointQuery(scene_, &query, &context, visit, &search);
      const bool inside = search.triangle != bodice::geometry::kNoIndex &&
                          signs_.is_inside(*skin_, search.triangle, search.closest, search.point);
      distance_m[i] = inside ? -query.radius : query.radius;
    }
  }

 private:
  struct Search {
    const TriMesh* skin;
    Vec3 point;
    bodice::geometry::Index triangle;
    TrianglePoint closest;
  };

  static bool visit(RTCPointQueryFunctionArguments* args) {
    auto& search = *static_cast<Search*>(args->userPtr);
    const TriMesh& skin = *search.skin;
    const TrianglePoint q =
        bodice::geometry::closest_point(skin.corner(args->primID, 0), skin.corner(args->primID, 1),
                                        skin.corner(args->primID, 2), search.point);
    const auto d = static_cast<float>((q.point - search.point).norm());
    if (d >= args->query->radius) return false;
    args->query->radius = d;
    search.triangle = args->primID;
    search.closest = q;
    return true;
  }

  void copy(const TriMesh& skin) {
    for (std::size_t v = 0; v < skin.positions.size(); ++v)
      for (std::size_t axis = 0; axis < 3; ++axis)
        vertices_[3 * v + axis] = static_cast<float>(skin.positions[v][static_cast<int>(axis)]);
  }

  SkinSigns signs_;
  float reach_m_;
  RTCDevice device_ = rtcNewDevice("threads=1");
  RTCScene scene_ = rtcNewScene(device_);
  RTCGeometry geometry_ = nullptr;
  std::vector<float> vertices_;
  std::vector<unsigned> indices_;
  const TriMesh* skin_ = nullptr;
};

}  // namespace

std::unique_ptr<MovingPeer> embree_refit(const TriMesh& rest, double reach_m) {
  return std::make_unique<EmbreeRefit>(rest, reach_m);
}

#else

std::unique_ptr<MovingPeer> embree_refit(const bodice::geometry::TriMesh&, double) {
  return nullptr;
}

#endif

}  // namespace bench
