#include "report.hpp"

#include <algorithm>
#include <cstdio>
#include <numeric>

namespace bench {
namespace {

constexpr double kMeanAgreement = 0.975, kLeastAgreement = 0.93, kMostSwapped = 0.001;

bool misses(const Score& s, double bar) {
  return (s.agreement >= 0.0 && s.agreement < kLeastAgreement) || s.swapped > kMostSwapped ||
         s.worst_landmark > bar;
}

std::string without_side(const std::string& landmark) {
  const bool sided = landmark.ends_with("_l") || landmark.ends_with("_r");
  return sided ? landmark.substr(0, landmark.size() - 2) : landmark;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) /
         static_cast<double>(std::max<std::size_t>(values.size(), 1));
}

void print_errors(const char* pose, double bar, std::vector<double> errors) {
  if (errors.empty()) return;
  std::sort(errors.begin(), errors.end());
  const auto over = errors.end() - std::upper_bound(errors.begin(), errors.end(), bar);
  std::printf("  %-5s mean %5.2f  p95 %5.2f  worst %5.2f  bar %.1f  over it %3td of %zu", pose,
              100.0 * mean(errors), 100.0 * errors[errors.size() * 95 / 100], 100.0 * errors.back(),
              100.0 * bar, over, errors.size());
}

}  // namespace

void Report::header() const {
  std::printf("%-42s %7s %7s %6s %6s %-12s %6s %7s\n", "body", "V", "agree%", "swap%", "worst%", "landmark",
              "height", "ms");
}

void Report::add(const Case& c, const bodice::anatomy::Anatomy& a) {
  const Score s = score(c, a);
  const bool missed = misses(s, c.rest ? kRestBar : kPosedBar);
  ++bodies_;
  missed_ += missed;
  missed_silently_ += missed && a.warnings.empty();
  if (s.agreement >= 0.0) agreement_.push_back(s.agreement);
  worst_swap_ = std::max(worst_swap_, s.swapped);
  for (const auto& [name, error] : s.error) {
    Errors& e = errors_[without_side(name)];
    (c.rest ? e.rest : e.posed).push_back(error);
  }
  if (!every_row_ && !missed) return;
  double ms = 0.0;
  for (const auto& stage : a.stages) ms += stage.ms;
  std::printf("%-42s %7zu %7.2f %6.2f %6.2f %-12s %6.3f %7.2f", c.name.c_str(), c.mesh.positions.size(),
              100.0 * s.agreement, 100.0 * s.swapped, 100.0 * s.worst_landmark, s.worst_name.c_str(),
              s.stature_ratio, ms);
  for (const auto& w : a.warnings) std::printf(" %s(%s)", w.code.c_str(), w.part.c_str());
  std::printf("\n");
  if (!every_landmark_) return;
  for (const auto& [name, error] : s.error) std::printf("    %s %.2f", name.c_str(), 100.0 * error);
  std::printf("\n");
}

void Report::add_refused(const Case& c, const std::string& sentence) {
  ++bodies_;
  ++refused_;
  std::printf("%-42s %s\n", c.name.c_str(), sentence.c_str());
}

void Report::summary() const {
  if (bodies_ == 0) return;
  std::printf("\nbodies %d, refused %d, with a bar missed %d, of them without a warning %d\n", bodies_,
              refused_, missed_, missed_silently_);
  if (!agreement_.empty())
    std::printf(
        "agreement, %% of the skin: mean %.2f (bar %.1f), least %.2f (bar %.0f); swapped %.2f (bar 0)\n",
        100.0 * mean(agreement_), 100.0 * kMeanAgreement,
        100.0 * *std::min_element(agreement_.begin(), agreement_.end()), 100.0 * kLeastAgreement,
        100.0 * worst_swap_);
  std::printf("landmarks, %% of the stature from the truth:\n");
  for (const auto& [name, e] : errors_) {
    std::printf("%-10s", name.c_str());
    print_errors("rest", kRestBar, e.rest);
    print_errors("posed", kPosedBar, e.posed);
    std::printf("\n");
  }
}

}  // namespace bench
