#pragma once

#include <string>
#include <vector>

#include <bodice/tryon/drape.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::inline v0_1::cli {

/// The main results of a run in about ten lines.
std::string summary_text(const tryon::PreparedBody& body, const tryon::DrapeReport* drape,
                         const std::vector<std::string>& files, bool cropped);

}  // namespace bodice::cli
