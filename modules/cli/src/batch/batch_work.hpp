// The jobs of a batch: what `drape` does, or a fit alone, with options by their long names.
#pragma once

#include <set>
#include <string>

#include <bodice/batch/work.hpp>

#include "run/drape_steps.hpp"

namespace bodice::inline v0_1::cli {

class DrapeWork : public batch::Work {
 public:
  /// `threads`: workers of a drape. Fits take one, since a process with threads cannot be copied.
  explicit DrapeWork(int threads);

  std::string version() const override;
  bool is_file(const std::string& name, const std::string& value) const override;
  std::vector<std::filesystem::path> files_beside(const std::filesystem::path& file) const override;
  std::string shared(const batch::Job& job) const override;
  engine::Result<void> check(const batch::Job& job) const override;
  engine::Result<std::unique_ptr<batch::PreparedJobs>> prepare(const batch::Job& first) override;

 private:
  int threads_;
  std::set<std::string> of_fits_;  ///< names of the options that a fit has as well
};

}  // namespace bodice::cli
