// A run as one page to look at: no server, no network, nothing beside it.
#pragma once

#include <string>

#include <bodice/engine/context.hpp>
#include <bodice/io/scene.hpp>
#include <bodice/tryon/drape.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::page {

/// What a page shows beside the body.
struct PageContent {
  const io::Scene* scene = nullptr;           ///< garments and frames of the body; null: the body alone
  const tryon::DrapeReport* drape = nullptr;  ///< null: nothing was draped
  std::string report;                         ///< tryon::report_json(), for download
};

/// The page as HTML: the skin colored by the proxy's error, parts, landmarks, ellipsoids, the relief's
/// surface, cloth over time, error and penetration, a histogram, the times of the stages and the warnings.
/// Skins of more than 60,000 vertices are thinned, and frames are left out beyond 4 MB of positions; the page
/// notes it. Cost: one query of the proxy a vertex.
std::string page_html(const engine::Context& context, const tryon::PreparedBody& body,
                      const PageContent& content);

}  // namespace bodice::page
