// bodice.h for C++17: handles that release themselves, and results that hold a value or a failure. It throws
// nothing and needs neither exceptions nor run-time types; all of it is in this header. Each function calls
// that of its name in bodice.h, where shapes, units and failures are stated.
//
//     auto context = bodice::Context::create();
//     if (!context) return std::puts(context.error()), 1;
//     auto proxy = bodice::Proxy::from_bytes(*context, bytes.data(), bytes.size());
//     ...
//     bodice::Particles particles(vertices.size());
//     particles.position(&vertices[0].position[0], sizeof(Vertex));
//     auto report = collider->resolve(particles, *workspace);
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>

#include <bodice.h>

namespace bodice {
inline namespace v0_1 {

/// A value, or the status and the sentence of a failure. The sentence is that of the thread's last failure:
/// read it before the next call.
template <class T>
class Expected {
 public:
  Expected(T value) : value_(std::move(value)) {}
  Expected(bodice_status status) : status_(status) {}

  explicit operator bool() const noexcept { return status_ == BODICE_OK; }
  bodice_status status() const noexcept { return status_; }
  const char* error() const noexcept { return bodice_last_error(); }
  /// Precondition: not a failure.
  T& operator*() noexcept { return value_; }
  const T& operator*() const noexcept { return value_; }
  T* operator->() noexcept { return &value_; }
  const T* operator->() const noexcept { return &value_; }

 private:
  T value_{};
  bodice_status status_ = BODICE_OK;
};

namespace detail {

/// A handle of the C interface that one object owns.
template <class T, void (*Destroy)(T*)>
class Handle {
 public:
  Handle() = default;
  explicit Handle(T* handle) : handle_(handle) {}
  T* get() const noexcept { return handle_.get(); }

 private:
  struct Release {
    void operator()(T* handle) const noexcept { Destroy(handle); }
  };
  std::unique_ptr<T, Release> handle_;
};

template <class Scalar>
constexpr std::int32_t scalar_of() {
  using Number = std::remove_const_t<Scalar>;
  static_assert(std::is_same_v<Number, float> || std::is_same_v<Number, double>,
                "bodice reads float and double");
  return std::is_same_v<Number, double> ? BODICE_DOUBLE : BODICE_FLOAT;
}

template <class Scalar>
bodice_vectors vectors(Scalar* x, std::ptrdiff_t stride) {
  return {const_cast<std::remove_const_t<Scalar>*>(x), nullptr, nullptr, stride, scalar_of<Scalar>(), 0};
}

}  // namespace detail

/// See bodice_context.
class Context : public detail::Handle<bodice_context, bodice_context_destroy> {
 public:
  using Handle::Handle;
  static Expected<Context> create(const bodice_context_options& options = bodice_default_context_options()) {
    bodice_context* made = nullptr;
    const bodice_status status = bodice_context_create(&options, &made);
    if (status != BODICE_OK) return status;
    return Context(made);
  }
};

class Skin;

/// See bodice_proxy.
class Proxy : public detail::Handle<bodice_proxy, bodice_proxy_destroy> {
 public:
  using Handle::Handle;
  static Expected<Proxy> from_bytes(const Context& context, const void* bytes, std::size_t size) {
    bodice_proxy* made = nullptr;
    const bodice_status status = bodice_proxy_from_bytes(context.get(), bytes, size, &made);
    if (status != BODICE_OK) return status;
    return Proxy(made);
  }
  Expected<bodice_proxy_info> info() const {
    bodice_proxy_info info = bodice_default_proxy_info();
    const bodice_status status = bodice_proxy_get_info(get(), &info);
    if (status != BODICE_OK) return status;
    return info;
  }
  /// See bodice_proxy_bind(); with libbodice.
  Expected<Proxy> bind(const Context& context, const Skin& skin) const;
};

/// See bodice_skin; with libbodice.
class Skin : public detail::Handle<bodice_skin, bodice_skin_destroy> {
 public:
  using Handle::Handle;
  static Expected<Skin> from_mesh(const Context& context, const bodice_mesh& mesh,
                                  const bodice_skin_options& options = bodice_default_skin_options()) {
    bodice_skin* made = nullptr;
    const bodice_status status = bodice_skin_from_mesh(context.get(), &mesh, &options, &made);
    if (status != BODICE_OK) return status;
    return Skin(made);
  }
  static Expected<Skin> from_file(const Context& context, const char* path,
                                  const bodice_skin_options& options = bodice_default_skin_options()) {
    bodice_skin* made = nullptr;
    const bodice_status status = bodice_skin_from_file(context.get(), path, &options, &made);
    if (status != BODICE_OK) return status;
    return Skin(made);
  }
  Expected<bodice_skin_info> info() const {
    bodice_skin_info info = bodice_default_skin_info();
    const bodice_status status = bodice_skin_get_info(get(), &info);
    if (status != BODICE_OK) return status;
    return info;
  }
  /// See bodice_fit(); `report` may be null.
  Expected<Proxy> fit(const Context& context,
                      const bodice_fit_options& options = bodice_default_fit_options(),
                      bodice_fit_report* report = nullptr) const {
    bodice_proxy* made = nullptr;
    const bodice_status status = bodice_fit(context.get(), get(), &options, &made, report);
    if (status != BODICE_OK) return status;
    return Proxy(made);
  }
};

inline Expected<Proxy> Proxy::bind(const Context& context, const Skin& skin) const {
  bodice_proxy* made = nullptr;
  const bodice_status status = bodice_proxy_bind(context.get(), get(), skin.get(), &made);
  if (status != BODICE_OK) return status;
  return Proxy(made);
}

/// See bodice_session; with libbodice. Each function calls that of its name in bodice.h; others take get().
class Session : public detail::Handle<bodice_session, bodice_session_destroy> {
 public:
  using Handle::Handle;
  static Expected<Session> create(const Context& context,
                                  const bodice_session_options& options = bodice_default_session_options()) {
    bodice_session* made = nullptr;
    const bodice_status status = bodice_session_create(context.get(), &options, &made);
    if (status != BODICE_OK) return status;
    return Session(made);
  }
  bodice_status submit(const bodice_mesh& body) { return bodice_session_submit(get(), &body); }
  bodice_status dress(const bodice_garment* garments, std::size_t count) {
    return bodice_session_dress(get(), garments, count);
  }
  Expected<bodice_step_report> step(double dt_s) {
    bodice_step_report report = bodice_default_step_report();
    const bodice_status status = bodice_session_step(get(), dt_s, &report);
    if (status != BODICE_OK) return status;
    return report;
  }
};

/// See bodice_workspace.
class Workspace : public detail::Handle<bodice_workspace, bodice_workspace_destroy> {
 public:
  using Handle::Handle;
  static Expected<Workspace> create(const Context& context) {
    bodice_workspace* made = nullptr;
    const bodice_status status = bodice_workspace_create(context.get(), &made);
    if (status != BODICE_OK) return status;
    return Workspace(made);
  }
};

/// Positions that are read and never written, by pointer and stride: bytes from element to element, 0 for
/// packed triples. Queries take them.
struct Points : bodice_particles {
  template <class Scalar>
  Points(std::size_t number, const Scalar* x, std::ptrdiff_t stride = 0)
      : bodice_particles(bodice_default_particles()) {
    count = number;
    position = detail::vectors(x, stride);
  }
};

/// bodice_particles with arrays set by pointer and stride: bytes from element to element, 0 for packed
/// triples. Positions and velocities are written by a response.
struct Particles : bodice_particles {
  explicit Particles(std::size_t number) : bodice_particles(bodice_default_particles()) { count = number; }

  template <class Scalar>
  Particles& position(Scalar* x, std::ptrdiff_t stride = 0) {
    static_assert(!std::is_const_v<Scalar>, "a response writes this array; for queries take Points");
    bodice_particles::position = detail::vectors(x, stride);
    return *this;
  }
  template <class Scalar>
  Particles& velocity(Scalar* x, std::ptrdiff_t stride = 0) {
    static_assert(!std::is_const_v<Scalar>, "a response writes this array; for queries take Points");
    bodice_particles::velocity = detail::vectors(x, stride);
    return *this;
  }
  template <class Scalar>
  Particles& safe(Scalar* x, std::ptrdiff_t stride = 0) {
    bodice_particles::safe = detail::vectors(x, stride);
    return *this;
  }
  template <class Scalar>
  Particles& inverse_mass(const Scalar* first, std::ptrdiff_t stride = 0) {
    bodice_particles::inverse_mass = {const_cast<Scalar*>(first), stride, detail::scalar_of<Scalar>(), 0};
    return *this;
  }
};

/// See bodice_collider.
class Collider : public detail::Handle<bodice_collider, bodice_collider_destroy> {
 public:
  using Handle::Handle;
  static Expected<Collider> create(const Context& context, const Proxy& proxy) {
    bodice_collider* made = nullptr;
    const bodice_status status = bodice_collider_create(context.get(), proxy.get(), &made);
    if (status != BODICE_OK) return status;
    return Collider(made);
  }
  /// Poses a bound proxy by float matrices of `count` joints; see bodice_collider_pose().
  bodice_status pose(const float* matrices, std::size_t count, std::int32_t layout, double dt_s,
                     std::ptrdiff_t stride = 0) {
    bodice_pose pose = bodice_default_pose();
    pose.matrices = matrices;
    pose.count = static_cast<std::uint32_t>(count);
    pose.layout = layout;
    pose.dt_s = dt_s;
    pose.stride = stride;
    return bodice_collider_pose(get(), &pose);
  }
  /// Covers points of the posed skin, such as its vertices; returns how many were outside by more than
  /// `tolerance_m`. See bodice_collider_cover().
  Expected<std::size_t> cover(const Points& skin, float tolerance_m = 0.0007f) {
    std::size_t uncovered = 0;
    const bodice_status status = bodice_collider_cover(get(), &skin, tolerance_m, &uncovered);
    if (status != BODICE_OK) return status;
    return uncovered;
  }
  bodice_status query(const bodice_particles& particles, Workspace& workspace,
                      const bodice_contacts& contacts,
                      const bodice_query_options& options = bodice_default_query_options()) const {
    return bodice_query(get(), &particles, &options, workspace.get(), &contacts);
  }
  Expected<bodice_contact_report> resolve(
      const Points& points, Workspace& workspace,
      const bodice_resolve_options& options = bodice_default_resolve_options()) const = delete;
  Expected<bodice_contact_report> resolve(
      const bodice_particles& particles, Workspace& workspace,
      const bodice_resolve_options& options = bodice_default_resolve_options()) const {
    bodice_contact_report report = bodice_default_contact_report();
    const bodice_status status = bodice_resolve(get(), &particles, &options, workspace.get(), &report);
    if (status != BODICE_OK) return status;
    return report;
  }
};

}  // namespace v0_1
}  // namespace bodice
