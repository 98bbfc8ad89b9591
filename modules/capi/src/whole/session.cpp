// Sessions of the C interface.
#include <cmath>
#include <utility>

#include <bodice/tryon/session.hpp>

#include "arrays/mesh.hpp"
#include "base/context.hpp"
#include "base/handles.hpp"
#include "base/structures.hpp"
#include "frame/proxy.hpp"
#include "whole/fit.hpp"
#include "whole/garments.hpp"

using namespace bodice;
using capi::invalid;
using capi::Outcome;

struct bodice_session {
  bodice_session(capi::SharedContext shared, tryon::SessionOptions options)
      : context(std::move(shared)),
        moves(options.moves),
        session(context->engine_context(), std::move(options)) {}

  capi::SharedContext context;
  bool moves;
  tryon::Session session;
  bool submitted = false;
  engine::Ticket body, motion;
  std::vector<geometry::Vec3> positions;  ///< room for those of all garments
};

namespace {

Outcome read_options(const bodice_session_options* given, tryon::SessionOptions& out) {
  bodice_session_options options;
  BODICE_CHECK(capi::read(given, options, true));
  BODICE_CHECK(capi::read_tier(options.tier, "bodice_session_options.tier", out.fit.tier));
  if (options.max_ellipsoids < 0 || options.substeps < 1 || options.substeps > cloth::kMaxSubsteps)
    return invalid("bodice_session_options has " + std::to_string(options.max_ellipsoids) +
                       " ellipsoids at most and " + std::to_string(options.substeps) + " substeps.",
                   "Give 0 or more ellipsoids, and 1 to 128 substeps.");
  if (options.max_ellipsoids > 0) out.fit.max_ellipsoids = options.max_ellipsoids;
  if (!(options.thickness_m >= 0.0 && options.thickness_m <= 0.1))
    return invalid("bodice_session_options.thickness_m is " + std::to_string(options.thickness_m) + ".",
                   "Give 0 to 0.1 meters.");
  BODICE_CHECK(capi::read_fabric(options.fabric, out.fabric));
  out.moves = options.moves != 0;
  out.solver.substeps = options.substeps;
  out.solver.thickness_m = options.thickness_m;
  return {};
}

}  // namespace

bodice_status bodice_session_create(const bodice_context* context, const bodice_session_options* given,
                                    bodice_session** out) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::begin_result(out, "the session"));
    BODICE_CHECK(capi::check_handle(context, "The context"));
    tryon::SessionOptions options;
    BODICE_CHECK(read_options(given, options));
    *out = new bodice_session(context->state, std::move(options));
    return {};
  });
}

void bodice_session_destroy(bodice_session* session) {
  delete session;
}

bodice_status bodice_session_submit(bodice_session* session, const bodice_mesh* given) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(session, "The session"));
    geometry::TriMesh mesh;
    BODICE_CHECK(capi::read_mesh(given, mesh));
    auto body = tryon::repair_body(session->context->engine_context(), mesh);
    if (!body) return body.error();
    session->body = session->session.submit(std::move(body).value());
    session->submitted = true;
    return {};
  });
}

bodice_status bodice_session_submit_file(bodice_session* session, const char* path) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(session, "The session"));
    if (!path) return invalid("The path is null.", "Pass the name of a body file.");
    session->body =
        session->session.submit(tryon::BodyFile{std::u8string_view(reinterpret_cast<const char8_t*>(path))});
    session->submitted = true;
    return {};
  });
}

bodice_status bodice_session_poll(bodice_session* session, int32_t* state) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(session, "The session"));
    if (!state) return invalid("The pointer to the state is null.", "Pass one.");
    *state = BODICE_IDLE;
    if (session->submitted) *state = session->body.done() ? BODICE_READY : BODICE_WORKING;
    if (session->motion.done()) {
      // A clip that is not found is reported once. A search is canceled where the next body needs its own.
      const auto found = std::exchange(session->motion, {}).wait();
      if (!found && found.error().code != engine::ErrorCode::kCanceled) return found.error();
    }
    return session->submitted && session->body.done() ? Outcome(session->body.wait()) : Outcome();
  });
}

bodice_status bodice_session_dress(bodice_session* session, const bodice_garment* garments, size_t count) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(session, "The session"));
    std::vector<tryon::WornGarment> worn;
    BODICE_CHECK(capi::read_garments(garments, count, worn));
    BODICE_CHECK(Outcome(session->session.dress(worn)));
    session->positions.resize(session->session.vertices());
    return {};
  });
}

bodice_status bodice_session_play(bodice_session* session, const char* motion, const char* clip) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(session, "The session"));
    if (!motion) return invalid("The motion is null.", "Pass a name such as \"walk\".");
    if (!session->moves)
      return invalid("The session's bodies do not move.", "Set bodice_session_options.moves to 1.");
    session->motion = session->session.play({.motion = motion, .clip = clip ? clip : ""});
    return {};
  });
}

bodice_status bodice_session_pause(bodice_session* session) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(session, "The session"));
    session->session.pause();
    return {};
  });
}

bodice_status bodice_session_resume(bodice_session* session) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(session, "The session"));
    session->session.resume();
    return {};
  });
}

bodice_status bodice_session_seek(bodice_session* session, double time_s, double ramp_s) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(session, "The session"));
    if (!(std::isfinite(time_s) && time_s >= 0.0 && std::isfinite(ramp_s) && ramp_s >= 0.0))
      return invalid("The session cannot seek to " + std::to_string(time_s) + " s over " +
                         std::to_string(ramp_s) + " s.",
                     "Give seconds, zero or more.");
    session->session.seek(time_s, ramp_s);
    return {};
  });
}

bodice_status bodice_session_step(bodice_session* session, double dt_s, bodice_step_report* report) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(session, "The session"));
    if (!(std::isfinite(dt_s) && dt_s >= 0.0))
      return invalid("The step takes " + std::to_string(dt_s) + " seconds.", "Give zero or more.");
    auto value = capi::with_defaults<bodice_step_report>();
    BODICE_CHECK(capi::write(value, report, true));
    const tryon::FrameOutcome outcome = session->session.frame(dt_s);
    value.has_body = outcome.has_body;
    value.refinement = session->session.body() ? session->session.body()->refinement : 0;
    value.proxy_hash = outcome.proxy_hash;
    value.vertices = session->session.vertices();
    value.contacts = outcome.cloth.contacts.contacts;
    value.step_ms = 1e-6 * static_cast<double>(outcome.timing.boundary_ns + outcome.timing.body_ns);
    value.clip_s = outcome.clip_s;
    return capi::write(value, report, true);
  });
}

bodice_status bodice_session_get_positions(bodice_session* session, const bodice_vectors* given,
                                           size_t count) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(session, "The session"));
    if (count > session->positions.size())
      return invalid("There are " + std::to_string(session->positions.size()) + " vertices, not " +
                         std::to_string(count) + ".",
                     "See bodice_step_report.vertices.");
    capi::StridedVectors to;
    BODICE_CHECK(capi::read_positions(given, count, to));
    if (count > 0) session->session.positions(session->positions);
    for (std::size_t v = 0; v < count; ++v) {
      const geometry::Vec3& p = session->positions[v];
      to.set(v, {p.x(), p.y(), p.z()});
    }
    return {};
  });
}

bodice_status bodice_session_get_proxy(bodice_session* session, bodice_proxy** out) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::begin_result(out, "the proxy"));
    BODICE_CHECK(capi::check_handle(session, "The session"));
    const tryon::LiveBody* body = session->session.body();
    if (!body)
      return {BODICE_NOT_FOUND, "The session has no body yet. Submit one and step until has_body is 1."};
    *out = new bodice_proxy{session->context, body->proxy};
    return {};
  });
}

bodice_status bodice_session_get_hash(bodice_session* session, uint64_t* hash) {
  return capi::guarded([&]() -> Outcome {
    BODICE_CHECK(capi::check_handle(session, "The session"));
    if (!hash) return invalid("The pointer to the hash is null.", "Pass one.");
    *hash = session->session.hash();
    return {};
  });
}
