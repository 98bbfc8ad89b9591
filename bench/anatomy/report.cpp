#include "report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <numeric>

namespace bench {
namespace {

constexpr double kMeanAgreement = 0.975, kLeastAgreement = 0.93, kMostSwapped = 0.001;
constexpr double kFalseAlarms = 0.05;  // of the bodies

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

/// A share in percent; a dash where the truth is not known.
std::string percent(double share) {
  if (share < 0.0) return "-";
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%.2f", 100.0 * share);
  return text.data();
}

/// Whether a warning is about the answer; warnings about the input leave that as good as it was.
bool doubts_a_landmark(const bodice::engine::Warning& w) {
  constexpr std::array<const char*, 4> kOfInput{"holes", "extra-pieces", "skin-touches",
                                                "unusual-proportions"};
  return std::none_of(kOfInput.begin(), kOfInput.end(), [&](const char* code) { return w.code == code; });
}

/// The part that a warning about a landmark names.
std::string part_named_for(const std::string& landmark) {
  const std::string kind = without_side(landmark);
  if (kind == "crown" || kind == "neck") return "head";
  if (kind == "perineum") return "thigh_l";
  const std::string side = landmark.substr(kind.size());
  return (kind == "fingertip" ? "forearm"
          : kind == "knee"    ? "thigh"
          : kind == "toe"     ? "calf"
                              : "upper_arm") +
         side;
}

/// Whether some warning names what was missed, or doubts the whole body.
bool warned_of(const std::string& landmark, const std::vector<bodice::engine::Warning>& warnings) {
  return std::any_of(warnings.begin(), warnings.end(), [&](const bodice::engine::Warning& w) {
    return doubts_a_landmark(w) && (w.part.empty() || w.part == part_named_for(landmark));
  });
}

struct Bin {
  double from, to;
};
constexpr Bin kBins[] = {{0.0, 0.25}, {0.25, 0.5}, {0.5, 0.7}, {0.7, 0.8}, {0.8, 0.9}, {0.9, 1.001}};

}  // namespace

void Report::claim(const Case& c, const Score& s, const bodice::anatomy::Anatomy& a) {
  const double bar = c.rest ? kRestBar : kPosedBar;
  kinds_[c.kind].push_back(s.agreement);
  std::map<std::string, bool> over;
  for (const auto& mark : a.landmarks) {
    const auto error = s.error.find(std::string(bodice::body::name(mark.id)));
    if (error == s.error.end()) continue;
    claims_.push_back({mark.confidence, error->second / bar});
    if (error->second > bar) over[without_side(error->first)] = true;
  }
  for (const auto& [name, yes] : over) misses_[c.kind][name] += yes;
}

void Report::weigh_warnings(const Case& c, const Score& s, const bodice::anatomy::Anatomy& a, bool missed) {
  const double bar = c.rest ? kRestBar : kPosedBar;
  bool silent = missed && std::none_of(a.warnings.begin(), a.warnings.end(), doubts_a_landmark);
  for (const auto& [landmark, error] : s.error)
    silent = silent || (error > bar && !warned_of(landmark, a.warnings));
  missed_silently_ += silent;
  std::map<std::string, bool> codes;
  for (const auto& w : a.warnings) codes[w.code] = true;
  for (const auto& [code, yes] : codes) {
    ++warned_[code].bodies;
    warned_[code].rightly += missed;
  }
  if (std::none_of(a.warnings.begin(), a.warnings.end(), doubts_a_landmark)) return;
  ++doubted_.bodies;
  doubted_.rightly += missed;
}

double Report::false_alarms() const {
  return static_cast<double>(doubted_.wrongly()) / static_cast<double>(std::max(bodies_, 1));
}

void Report::print_warnings() const {
  const int wrongly = doubted_.wrongly();
  std::printf("%-22s %9s %9s\n%-22s %9d %9d\n%-22s %9d %9d\n", "", "doubted", "silent", "a bar missed",
              missed_ - missed_silently_, missed_silently_, "right", wrongly,
              bodies_ - refused_ - missed_ - wrongly);
  std::printf(
      "bodies with a landmark in doubt %d, of them rightly %d; false alarms %.1f %% of all (bar %.0f)\n",
      doubted_.bodies, doubted_.rightly, 100.0 * false_alarms(), 100.0 * kFalseAlarms);
  for (const auto& [code, w] : warned_)
    std::printf("  %-24s %4d bodies, %3d of them miss a bar\n", code.c_str(), w.bodies, w.rightly);
}

void Report::print_claims() const {
  std::printf("what a confidence is worth (all landmarks):\n%12s %8s %10s %10s\n", "confidence", "count",
              "mean/bar", "over bar %");
  for (const Bin& bin : kBins) {
    double sum = 0.0;
    std::size_t count = 0, over = 0;
    for (const Claim& claim : claims_) {
      if (!(claim.confidence >= bin.from && claim.confidence < bin.to)) continue;
      ++count;
      sum += claim.error_of_bar;
      over += claim.error_of_bar > 1.0;
    }
    if (count == 0) continue;
    const auto n = static_cast<double>(count);
    std::printf("  %.2f - %.2f %7zu %10.2f %10.1f\n", bin.from, std::min(bin.to, 1.0), count, sum / n,
                100.0 * static_cast<double>(over) / n);
  }
}

void Report::print_kinds() const {
  std::printf("by kind: bodies, their agreement, and how many are over a landmark's bar:\n%-14s %6s %6s %6s",
              "", "bodies", "mean%", "least%");
  for (const auto& [landmark, e] : errors_) std::printf(" %9s", landmark.c_str());
  std::printf("\n");
  for (const auto& [kind, all] : kinds_) {
    std::vector<double> known;
    std::copy_if(all.begin(), all.end(), std::back_inserter(known), [](double a) { return a >= 0.0; });
    const double least = known.empty() ? -1.0 : *std::min_element(known.begin(), known.end());
    std::printf("%-14s %6zu %6s %6s", kind.c_str(), all.size(),
                percent(known.empty() ? -1.0 : mean(known)).c_str(), percent(least).c_str());
    const auto row = misses_.find(kind);
    for (const auto& [landmark, e] : errors_) {
      const bool any = row != misses_.end() && row->second.contains(landmark);
      std::printf(" %9d", any ? row->second.at(landmark) : 0);
    }
    std::printf("\n");
  }
}

void Report::header() const {
  std::printf("%-42s %7s %7s %6s %6s %-12s %6s %7s\n", "body", "V", "agree%", "swap%", "worst%", "landmark",
              "height%", "ms");
}

void Report::add(const Case& c, const bodice::anatomy::Anatomy& a) {
  const Score s = score(c, a);
  const bool missed = misses(s, c.rest ? kRestBar : kPosedBar);
  ++bodies_;
  missed_ += missed;
  weigh_warnings(c, s, a, missed);
  if (s.agreement >= 0.0) agreement_.push_back(s.agreement);
  worst_swap_ = std::max(worst_swap_, s.swapped);
  if (c.stature > 0.0) height_.push_back(std::abs(s.stature_ratio - 1.0));
  for (const auto& [name, error] : s.error) {
    Errors& e = errors_[without_side(name)];
    (c.rest ? e.rest : e.posed).push_back(error);
  }
  claim(c, s, a);
  if (!every_row_ && !missed) return;
  double ms = 0.0;
  for (const auto& stage : a.stages) ms += stage.ms;
  std::printf("%-42s %7zu %7s %6.2f %6s %-12s %6s %7.2f", c.name.c_str(), c.mesh.positions.size(),
              percent(s.agreement).c_str(), 100.0 * s.swapped, percent(s.worst_landmark).c_str(),
              s.worst_name.c_str(), percent(s.stature_ratio).c_str(), ms);
  for (const auto& w : a.warnings) std::printf(" %s(%s)", w.code.c_str(), w.part.c_str());
  std::printf("\n");
  if (!every_landmark_) return;
  for (const auto& [name, error] : s.error) std::printf("    %s %.2f", name.c_str(), 100.0 * error);
  std::printf("\n");
}

void Report::add_refused(const Case& c, const std::string& sentence) {
  ++bodies_;
  ++refused_;
  refused_wrongly_ += c.kind != "awkward";
  std::printf("%-42s %s\n", c.name.c_str(), sentence.c_str());
}

void Report::summary() const {
  if (bodies_ == 0) return;
  std::printf("\nbodies %d, refused %d, with a bar missed %d, of them without a warning that names it %d\n",
              bodies_, refused_, missed_, missed_silently_);
  if (!agreement_.empty())
    std::printf(
        "agreement, %% of the skin: mean %.2f (bar %.1f), least %.2f (bar %.0f); swapped %.2f (bar 0)\n",
        100.0 * mean(agreement_), 100.0 * kMeanAgreement,
        100.0 * *std::min_element(agreement_.begin(), agreement_.end()), 100.0 * kLeastAgreement,
        100.0 * worst_swap_);
  if (!height_.empty())
    std::printf("height, %% off the true one: mean %.2f, worst %.2f\n", 100.0 * mean(height_),
                100.0 * *std::max_element(height_.begin(), height_.end()));
  std::printf("landmarks, %% of the stature from the truth:\n");
  for (const auto& [name, e] : errors_) {
    std::printf("%-10s", name.c_str());
    print_errors("rest", kRestBar, e.rest);
    print_errors("posed", kPosedBar, e.posed);
    std::printf("\n");
  }
  print_kinds();
  print_warnings();
  print_claims();
}

bool Report::holds_bars() const {
  const bool agree = agreement_.empty() || mean(agreement_) >= kMeanAgreement;
  return bodies_ > 0 && refused_wrongly_ == 0 && missed_ == 0 && agree && false_alarms() <= kFalseAlarms;
}

}  // namespace bench
