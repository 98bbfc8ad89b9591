#pragma once

#include <string>
#include <vector>

#include <bench_support/stopwatch.hpp>

#include "stage.hpp"

namespace bodice_bench {

using bench::Stopwatch;

/// A stage at one size with one number of workers.
struct Sample {
  std::string stage, element;
  bool weak = false;  ///< the size grew with the workers
  std::size_t size = 0;
  int workers = 1;
  double min_ms = 0.0;      ///< wall time of a run; one worker runs on each processor, and this is the mean
  double median_ms = 0.0;   ///< wall time of a run
  double cpu_ms = 0.0;      ///< processor time of this process, in the median run's round
  double imbalance = 0.0;   ///< busiest worker over the mean of all, in the bodies of loops
  double processors = 0.0;  ///< processors that the machine gave meanwhile; see capacity.hpp
  bool same_bits = true;    ///< whether the result has the bits of the first run with one worker
  int repeats = 0;
};

/// How long samples are measured.
struct Effort {
  int max_workers = 2;
  double seconds_per_sample = 1.0;
  double patience = 5.0;  ///< factor by which a sample may take longer while the machine is busy
};

/// Worker counts from 1 to the maximum: each one up to 4, then doubling.
std::vector<int> worker_counts(int max_workers);

std::vector<Sample> strong_scaling(const Stage& stage, std::size_t size, const Effort& effort);
std::vector<Sample> weak_scaling(const Stage& stage, std::size_t size, const Effort& effort);

/// The serial fraction s in Amdahl's formula, min_ms(n) / min_ms(1) = s + (1 - s) / n, by least squares over
/// one stage's samples.
double serial_fraction(const std::vector<Sample>& samples);

}  // namespace bodice_bench
