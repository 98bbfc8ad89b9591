// One line of a manifest as a job.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <bodice/batch/job.hpp>
#include <bodice/engine/result.hpp>

namespace bodice::inline v0_1::batch {

/// Reads one JSON object with values that are text, numbers, true, false or lists of these; null counts as
/// left out. Fails with kUnreadable.
engine::Result<Job> job_from_json(std::string_view line);

/// The fields of one CSV line (RFC 4180, without line breaks inside quotes). Fails with kUnreadable where a
/// quote is not closed.
engine::Result<std::vector<std::string>> csv_fields(std::string_view line);

/// A field for each column, in order; empty fields count as left out. A field with `;` is a list. Fails with
/// kUnreadable where the number of fields is not that of the columns.
engine::Result<Job> job_from_csv(std::string_view line, const std::vector<std::string>& columns);

/// The job as one text, the same for equal jobs: names in the order of the alphabet, lengths before values.
std::string text_of(const Job& job);

}  // namespace bodice::batch
