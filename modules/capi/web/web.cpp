// The part of bodice.h that a page needs, with nothing but numbers and addresses in each call, since a script
// has no structures. A handle is an address; a call that returns one returns 0 on failure, and one that
// returns a status does so as bodice.h does. web_error() has the sentence.
#include <cstddef>
#include <cstdint>

#include <bodice.h>
#include <emscripten.h>

#define BODICE_WEB extern "C" EMSCRIPTEN_KEEPALIVE

namespace {

const bodice_context* context() {
  static const bodice_context* const made = [] {
    bodice_context* context = nullptr;
    bodice_context_options options = bodice_default_context_options();
    options.workers = 1;
    return bodice_context_create(&options, &context) == BODICE_OK ? context : nullptr;
  }();
  return made;
}

bodice_mesh mesh_at(double* positions, std::size_t vertices, const std::uint32_t* faces,
                    std::size_t triangles) {
  bodice_mesh mesh = bodice_default_mesh();
  mesh.position = {positions, nullptr, nullptr, 0, BODICE_DOUBLE, 0};
  mesh.vertices = vertices;
  mesh.index = faces;
  mesh.triangles = triangles;
  return mesh;
}

bodice_particles particles_at(float* positions, std::size_t count) {
  bodice_particles particles = bodice_default_particles();
  particles.count = count;
  particles.position = {positions, nullptr, nullptr, 0, BODICE_FLOAT, 0};
  return particles;
}

/// A body in use: its collider and the memory of its calls.
struct Body {
  bodice_proxy* proxy = nullptr;
  bodice_collider* collider = nullptr;
  bodice_workspace* workspace = nullptr;

  ~Body() {
    bodice_workspace_destroy(workspace);
    bodice_collider_destroy(collider);
    bodice_proxy_destroy(proxy);
  }
};

/// Takes the proxy; 0 on failure.
Body* make_body(bodice_proxy* proxy) {
  auto* body = new Body{proxy};
  if (bodice_collider_create(context(), proxy, &body->collider) == BODICE_OK &&
      bodice_workspace_create(context(), &body->workspace) == BODICE_OK)
    return body;
  delete body;
  return nullptr;
}

}  // namespace

BODICE_WEB const char* web_error() {
  return bodice_last_error();
}
BODICE_WEB const char* web_build() {
  return bodice_build();
}
BODICE_WEB const char* web_part_name(int part) {
  return bodice_part_name(part);
}

// The module's function onStage hears the stages of long work, and cancels it by a result other than 0.
EM_JS(int, report_stage, (const char* stage),
      { return Module["onStage"] ? Module["onStage"](UTF8ToString(stage)) : 0; });

/// Positions are 3 numbers a vertex, faces 3 indices; `thing`: not a person. Returns 0 on failure.
BODICE_WEB bodice_skin* web_skin(double* positions, std::size_t vertices, const std::uint32_t* faces,
                                 std::size_t triangles, int thing, int find_rig) {
  const bodice_mesh mesh = mesh_at(positions, vertices, faces, triangles);
  bodice_skin_options options = bodice_default_skin_options();
  options.shape = thing ? BODICE_SHAPE_ANY : BODICE_SHAPE_PERSON;
  options.find_rig = find_rig;
  options.progress = [](void*, const char* stage) -> std::int32_t { return report_stage(stage); };
  bodice_skin* skin = nullptr;
  bodice_skin_from_mesh(context(), &mesh, &options, &skin);
  return skin;
}
BODICE_WEB bodice_skin* web_skin_built_in(int female, double stature_m) {
  bodice_skin* skin = nullptr;
  bodice_skin_built_in(context(), female, stature_m, nullptr, &skin);
  return skin;
}
BODICE_WEB void web_skin_destroy(bodice_skin* skin) {
  bodice_skin_destroy(skin);
}
/// out: stature, up (3), #vertices, #triangles, #vertices that were given, #joints, #warnings
BODICE_WEB bodice_status web_skin_info(const bodice_skin* skin, double* out) {
  bodice_skin_info info = bodice_default_skin_info();
  const bodice_status status = bodice_skin_get_info(skin, &info);
  *out++ = info.stature_m;
  for (const double x : info.up) *out++ = x;
  for (const std::uint32_t count :
       {info.vertices, info.triangles, info.input_vertices, info.joints, info.warnings})
    *out++ = count;
  return status;
}
BODICE_WEB const char* web_skin_joint_name(const bodice_skin* skin, std::uint32_t joint) {
  return bodice_skin_joint_name(skin, joint);
}
BODICE_WEB int web_skin_joint_parent(const bodice_skin* skin, std::uint32_t joint) {
  return bodice_skin_joint_parent(skin, joint);
}
BODICE_WEB const char* web_skin_warning(const bodice_skin* skin, std::uint32_t warning) {
  return bodice_skin_warning(skin, warning);
}
BODICE_WEB bodice_status web_skin_mesh(const bodice_skin* skin, double* positions, std::size_t vertices,
                                       std::uint32_t* faces, std::size_t triangles) {
  return bodice_skin_get_mesh(skin, positions, vertices, faces, triangles);
}
BODICE_WEB bodice_status web_skin_parts(const bodice_skin* skin, std::uint8_t* part, std::size_t vertices) {
  return bodice_skin_get_parts(skin, part, vertices);
}
BODICE_WEB bodice_status web_skin_vertex_of_input(const bodice_skin* skin, std::uint32_t* vertex,
                                                  std::size_t count) {
  return bodice_skin_get_vertex_of_input(skin, vertex, count);
}
BODICE_WEB const char* web_landmark_name(int landmark) {
  return bodice_landmark_name(landmark);
}
/// out: position (3) and confidence of each landmark
BODICE_WEB bodice_status web_skin_landmarks(const bodice_skin* skin, double* out) {
  bodice_landmark marks[BODICE_LANDMARKS] = {};
  const bodice_status status = bodice_skin_get_landmarks(skin, marks, BODICE_LANDMARKS);
  for (const bodice_landmark& mark : marks) {
    for (const double x : mark.position) *out++ = x;
    *out++ = mark.confidence;
  }
  return status;
}
BODICE_WEB const char* web_measurement_name(int measurement) {
  return bodice_measurement_name(measurement);
}
BODICE_WEB bodice_status web_skin_measurements(const bodice_skin* skin, double* out) {
  return bodice_skin_get_measurements(skin, out, BODICE_MEASUREMENTS);
}

/// report: mean, 95 % and largest gap in meters, share of the interior that is covered, seconds. Returns 0 on
/// failure.
BODICE_WEB Body* web_fit(const bodice_skin* skin, int tier, int max_ellipsoids, double target_error_m,
                         double* report) {
  bodice_fit_options options = bodice_default_fit_options();
  options.tier = tier;
  options.max_ellipsoids = max_ellipsoids;
  options.target_error_m = target_error_m;
  options.progress = [](void*, const char* stage) -> std::int32_t { return report_stage(stage); };
  bodice_fit_report made = bodice_default_fit_report();
  bodice_proxy* proxy = nullptr;
  if (bodice_fit(context(), skin, &options, &proxy, &made) != BODICE_OK) return nullptr;
  for (const double value :
       {made.gap_mean_m, made.gap_p95_m, made.gap_max_m, made.interior_covered, made.seconds})
    *report++ = value;
  return make_body(proxy);
}
BODICE_WEB Body* web_load(const void* bytes, std::size_t size) {
  bodice_proxy* proxy = nullptr;
  return bodice_proxy_from_bytes(context(), bytes, size, &proxy) == BODICE_OK ? make_body(proxy) : nullptr;
}
BODICE_WEB void web_body_destroy(Body* body) {
  delete body;
}
/// out: #ellipsoids, #joints, tier, stature, the two halves of the hash
BODICE_WEB bodice_status web_body_info(const Body* body, double* out) {
  bodice_proxy_info info = bodice_default_proxy_info();
  const bodice_status status = bodice_proxy_get_info(body->proxy, &info);
  const double values[] = {static_cast<double>(info.ellipsoids), static_cast<double>(info.joints),
                           static_cast<double>(info.tier),       info.stature_m,
                           static_cast<double>(info.hash >> 32), static_cast<double>(info.hash & 0xFFFFFFFF)};
  for (const double value : values) *out++ = value;
  return status;
}
BODICE_WEB const char* web_joint_name(const Body* body, std::uint32_t joint) {
  return bodice_proxy_joint_name(body->proxy, joint);
}
/// The length of the bytes, or 0; writes as many as `capacity`.
BODICE_WEB std::size_t web_body_bytes(const Body* body, void* bytes, std::size_t capacity) {
  std::size_t size = 0;
  const bodice_status status = bodice_proxy_to_bytes(body->proxy, 0, bytes, capacity, &size);
  return status == BODICE_OK ? size : 0;
}
/// out: center (3), axes (9, an axis a row), radii (3), part of each ellipsoid, at rest
BODICE_WEB bodice_status web_ellipsoids(const Body* body, double* out, std::size_t count) {
  auto* all = new bodice_ellipsoid[count];
  const bodice_status status = bodice_proxy_get_ellipsoids(body->proxy, all, count);
  for (std::size_t i = 0; status == BODICE_OK && i < count; ++i) {
    for (const double x : all[i].center) *out++ = x;
    for (const auto& axis : all[i].axes)
      for (const double x : axis) *out++ = x;
    for (const double x : all[i].radii) *out++ = x;
    *out++ = all[i].part;
  }
  delete[] all;
  return status;
}
BODICE_WEB bodice_status web_bind_matrix(const Body* body, std::uint32_t joint, double* matrix) {
  return bodice_proxy_get_bind(body->proxy, joint, matrix);
}
/// matrices: 3 x 4 a joint, rows
BODICE_WEB bodice_status web_pose(Body* body, const float* matrices, std::uint32_t joints, double dt_s) {
  bodice_pose pose = bodice_default_pose();
  pose.matrices = matrices;
  pose.count = joints;
  pose.dt_s = dt_s;
  return bodice_collider_pose(body->collider, &pose);
}
/// point, normal, ellipsoid and part may be 0.
BODICE_WEB bodice_status web_query(Body* body, float* positions, std::size_t count, float within_m,
                                   int first_order, float* distance, float* point, float* normal,
                                   std::uint32_t* ellipsoid, std::uint8_t* part) {
  const bodice_particles particles = particles_at(positions, count);
  bodice_query_options options = bodice_default_query_options();
  options.within_m = within_m;
  options.first_order = first_order;
  bodice_contacts contacts = bodice_default_contacts();
  contacts.distance = {distance, 0, BODICE_FLOAT, 0};
  if (point) contacts.point = {point, nullptr, nullptr, 0, BODICE_FLOAT, 0};
  if (normal) contacts.normal = {normal, nullptr, nullptr, 0, BODICE_FLOAT, 0};
  contacts.ellipsoid = ellipsoid;
  contacts.part = part;
  return bodice_query(body->collider, &particles, &options, body->workspace, &contacts);
}
/// velocities and inverse_mass may be 0. Returns the number of contacts, or a negative status.
BODICE_WEB int web_resolve(Body* body, float* positions, float* velocities, float* inverse_mass,
                           std::size_t count, float thickness_m, float friction) {
  bodice_particles particles = particles_at(positions, count);
  if (velocities) particles.velocity = {velocities, nullptr, nullptr, 0, BODICE_FLOAT, 0};
  if (inverse_mass) particles.inverse_mass = {inverse_mass, 0, BODICE_FLOAT, 0};
  bodice_resolve_options options = bodice_default_resolve_options();
  options.thickness_m = thickness_m;
  options.friction = friction;
  bodice_contact_report report = bodice_default_contact_report();
  const bodice_status status = bodice_resolve(body->collider, &particles, &options, body->workspace, &report);
  return status == BODICE_OK ? static_cast<int>(report.contacts) : -static_cast<int>(status);
}
/// The exact signed distance to a mesh in double precision: positions are 3 numbers a vertex, faces 3
/// indices.
BODICE_WEB bodice_status web_exact(double* positions, std::size_t vertices, const std::uint32_t* faces,
                                   std::size_t triangles, double* points, std::size_t count,
                                   double* distance) {
  const bodice_mesh mesh = mesh_at(positions, vertices, faces, triangles);
  bodice_exact* exact = nullptr;
  bodice_status status = bodice_exact_create(context(), &mesh, &exact);
  if (status != BODICE_OK) return status;
  bodice_particles particles = bodice_default_particles();
  particles.count = count;
  particles.position = {points, nullptr, nullptr, 0, BODICE_DOUBLE, 0};
  bodice_contacts contacts = bodice_default_contacts();
  contacts.distance = {distance, 0, BODICE_DOUBLE, 0};
  status = bodice_exact_query(exact, &particles, &contacts);
  bodice_exact_destroy(exact);
  return status;
}
