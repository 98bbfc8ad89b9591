/* The C interface of bodice: body proxies and what collides with them, for programs in any language.
 *
 *     bodice_context* context;
 *     bodice_context_options options = bodice_default_context_options();
 *     if (bodice_context_create(&options, &context) != BODICE_OK) return puts(bodice_last_error());
 *     bodice_proxy_from_bytes(context, bytes, size, &proxy);         a file that `bodice fit` wrote, or
 *     bodice_skin_from_mesh(context, &mesh, NULL, &skin);            your own mesh, with libbodice:
 *     bodice_fit(context, skin, NULL, &proxy, NULL);
 *     bodice_collider_create(context, proxy, &collider);
 *     bodice_workspace_create(context, &workspace);
 *     each frame:
 *         bodice_collider_pose(collider, &pose);                     the matrices of your bones
 *         bodice_resolve(collider, &particles, NULL, workspace, &report);
 *
 * Rules that hold for every function:
 * - Units are meters, seconds and radians. Coordinates are those of the mesh that the proxy was fitted to.
 * - A function that can fail returns a bodice_status; bodice_last_error() then has one sentence with the
 * remedy. What it should have made is then null, and nothing has changed, unless the function states
 * otherwise.
 * - No C++ exception, abort or signal leaves a function, and none may leave a callback of the host.
 * - Handles are made by ..._create and the like, and are released by ..._destroy, which takes null, too. The
 * order does not matter: a handle keeps alive what it needs of others, its context included.
 * - Structures that a pointer is passed of begin with a bodice_head. Fill them with their
 * bodice_default_...() function first, then change members. Newer versions only add members at the end.
 * - "Const use" of a handle may overlap from any number of threads; every other use must not overlap another
 * one of the same handle. Different handles never meet: there is no global state but the sentence of the last
 * error, which each thread has for itself.
 * - BODICE_STABLE functions keep their meaning until the next BODICE_ABI. BODICE_EXPERIMENTAL ones may change
 * in any version; a library that was built with BODICE_ONLY_STABLE does not export them. */
#ifndef BODICE_H
#define BODICE_H

/* In libbodice_frame and libbodice: */
#include <bodice/c/base.h>
#include <bodice/c/collider.h>
#include <bodice/c/exact.h>
#include <bodice/c/particles.h>
#include <bodice/c/proxy.h>
/* In libbodice alone: */
#include <bodice/c/fit.h>
#include <bodice/c/session.h>
#include <bodice/c/skin.h>

#endif
