// One job of a manifest.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <bodice/engine/version.hpp>

namespace bodice::inline v0_1::batch {

/// A job as text: the values of each name that its line gives, in the order of the line. Names are unique and
/// in the order of the alphabet, so that equal jobs are equal objects, in whatever order a line has them.
struct Job {
  std::size_t line = 0;  ///< in the manifest, from 1
  std::map<std::string, std::vector<std::string>> values;

  /// The only value of a name, or its first; empty where the line does not give the name.
  std::string value(const std::string& name) const {
    const auto found = values.find(name);
    return found == values.end() || found->second.empty() ? std::string() : found->second.front();
  }
  bool has(const std::string& name) const { return values.contains(name); }
};

}  // namespace bodice::batch
