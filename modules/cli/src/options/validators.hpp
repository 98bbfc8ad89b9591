// Checks of option values. A refusal reads "--name: VALUE is not WHAT", before any work; --help shows WHAT.
#pragma once

#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>

namespace bodice::inline v0_1::cli {

/// Finite numbers: NaN and infinities are refused.
CLI::Validator finite();
CLI::Validator above_zero();
CLI::Validator zero_or_more();
CLI::Validator between(double low, double high);
/// A whole number in decimal digits.
CLI::Validator whole(std::uint64_t low, std::uint64_t high);

/// Text that is not empty: the value of an unset shell variable does not count as an option left out.
CLI::Validator not_empty(const std::string& remedy = "give it a value or leave it out");

/// The name of a built-in profile of proportions, or a JSON file.
CLI::Validator profile();

}  // namespace bodice::cli
