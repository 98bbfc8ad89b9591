// Skins of the C interface.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <bodice/tryon/prepare.hpp>

#include "base/context.hpp"
#include "whole/progress.hpp"

struct bodice_skin {
  bodice_skin(bodice::capi::SharedContext shared, bodice::tryon::SegmentedSkin made);

  bodice::capi::SharedContext context;
  bodice::tryon::SegmentedSkin skin;
  std::vector<std::string> warnings;  ///< a sentence each
};

namespace bodice::inline v0_1::capi {

/// A mesh of the host with its bones, copied and checked.
struct HostBody {
  geometry::TriMesh mesh;
  std::optional<rig::Rig> rig;  ///< weights of the mesh's vertices
  bool find_rig = false;
  io::Shape shape = io::Shape::kPerson;
};

/// Copies body and bones; names the element at fault.
Outcome read_body(const bodice_mesh* mesh, const bodice_skin_options& options, HostBody& out);

/// Segments a body of the host.
Outcome make_skin(const engine::Context& context, Progress& progress, HostBody body,
                  tryon::SegmentedSkin& out);

}  // namespace bodice::capi
