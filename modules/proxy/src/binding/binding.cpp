#include <bodice/proxy/binding.hpp>

namespace bodice::inline v0_1::proxy {

std::size_t Binding::bytes() const {
  const auto size = [](const auto& values) { return values.size() * sizeof(values[0]); };
  std::size_t names = 0;
  for (const std::string& name : joint_names) names += sizeof name + name.size();
  return names + size(bind) + size(first_term) + size(terms) + size(burial) + size(step_m) +
         size(first_bundle) + size(bundles) + size(first_entry) + size(entries) + size(first_follower) +
         size(followers);
}

}  // namespace bodice::proxy
