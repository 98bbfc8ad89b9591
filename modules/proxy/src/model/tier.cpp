#include <array>

#include <bodice/proxy/body_proxy.hpp>

namespace bodice::inline v0_1::proxy {
namespace {

constexpr std::array<std::string_view, 4> kTierNames = {"paper", "solid", "tight", "relief"};

}  // namespace

std::string_view name(Tier tier) {
  return kTierNames[static_cast<std::size_t>(tier)];
}

std::optional<Tier> tier_from_name(std::string_view text) {
  for (std::size_t i = 0; i < kTierNames.size(); ++i)
    if (kTierNames[i] == text) return static_cast<Tier>(i);
  return std::nullopt;
}

}  // namespace bodice::proxy
