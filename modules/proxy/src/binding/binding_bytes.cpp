#include "binding/binding_bytes.hpp"

#include <string>
#include <utility>

namespace bodice::inline v0_1::proxy {
namespace {

constexpr std::uint64_t kTermBytes = 2 + 16 * 8, kBundleBytes = 2 * kBundle * 7 + 4;
constexpr std::uint64_t kEntryBytes = 2 + 2 * kBundle, kCarriedBytes = 16;
constexpr std::uint64_t kLeastJointBytes = 2 + 12 * 8;

void put(ByteWriter& out, std::int16_t value) {
  out.put(static_cast<std::uint16_t>(value));
}

void put_bundle(ByteWriter& out, const SkinBundle& bundle, std::uint32_t first_entry) {
  for (const std::uint16_t texel : bundle.texel) out.put(texel);
  for (const auto& axis : bundle.position)
    for (const std::int16_t value : axis) put(out, value);
  for (const auto& axis : bundle.direction)
    for (const std::int16_t value : axis) put(out, value);
  for (const std::int16_t value : bundle.height) put(out, value);
  out.put(first_entry);
}

std::int16_t get_i16(ByteReader& in) {
  return static_cast<std::int16_t>(in.get<std::uint16_t>());
}

SkinBundle get_bundle(ByteReader& in, std::uint32_t& first_entry) {
  SkinBundle bundle;
  for (std::uint16_t& texel : bundle.texel) texel = in.get<std::uint16_t>();
  for (auto& axis : bundle.position)
    for (std::int16_t& value : axis) value = get_i16(in);
  for (auto& axis : bundle.direction)
    for (std::int16_t& value : axis) value = get_i16(in);
  for (std::int16_t& value : bundle.height) value = get_i16(in);
  first_entry = in.get<std::uint32_t>();
  return bundle;
}

bool get_joint(ByteReader& in, Binding& binding) {
  const std::size_t length = in.get<std::uint16_t>();
  if (length > in.left()) return false;
  std::string name;
  for (std::size_t i = 0; i < length; ++i) name += static_cast<char>(in.get<std::uint8_t>());
  JointMatrix bind;
  for (int i = 0; i < 12; ++i) bind.data()[i] = in.get_double();
  binding.joint_names.push_back(std::move(name));
  binding.bind.push_back(bind);
  return in.ok();
}

/// The numbers of things in a binding, as its bytes begin with them.
struct Counts {
  std::uint64_t joints, ellipsoids, terms, texels, bundles, entries, followers;

  /// All that follows the joints.
  std::uint64_t bytes() const {
    return ellipsoids * kCarriedBytes + 8 + terms * kTermBytes + texels + bundles * kBundleBytes + 4 +
           entries * kEntryBytes + 2 * followers;
  }
};

void get_ellipsoids(ByteReader& in, const Counts& counts, Binding& binding) {
  for (std::uint64_t i = 0; i < counts.ellipsoids; ++i) {
    binding.first_term.push_back(in.get<std::uint32_t>());
    binding.first_bundle.push_back(in.get<std::uint32_t>());
    binding.first_follower.push_back(in.get<std::uint32_t>());
    binding.step_m.push_back(in.get_float());
  }
  binding.first_term.push_back(in.get<std::uint32_t>());
  binding.first_bundle.push_back(in.get<std::uint32_t>());
}

}  // namespace

void put_binding(ByteWriter& out, const Binding& b) {
  for (const std::size_t count : {b.joint_names.size(), b.step_m.size(), b.terms.size(), b.burial.size(),
                                  b.bundles.size(), b.entries.size(), b.followers.size()})
    out.put(static_cast<std::uint32_t>(count));
  out.put(b.burial_step_m);
  for (std::size_t j = 0; j < b.joint_names.size(); ++j) {
    out.put(static_cast<std::uint16_t>(b.joint_names[j].size()));
    for (const char c : b.joint_names[j]) out.put(static_cast<std::uint8_t>(c));
    for (int i = 0; i < 12; ++i) out.put(b.bind[j].data()[i]);
  }
  for (std::size_t k = 0; k < b.step_m.size(); ++k) {
    for (const auto* first : {&b.first_term, &b.first_bundle, &b.first_follower}) out.put((*first)[k]);
    out.put(b.step_m[k]);
  }
  out.put(b.first_term.back());
  out.put(b.first_bundle.back());
  for (const CarryTerm& term : b.terms) {
    out.put(term.joint);
    for (const double value : term.matrix) out.put(value);
  }
  for (const std::uint8_t depth : b.burial) out.put(depth);
  for (std::size_t i = 0; i < b.bundles.size(); ++i) put_bundle(out, b.bundles[i], b.first_entry[i]);
  out.put(b.first_entry.back());
  for (const SkinEntry& entry : b.entries) {
    out.put(entry.term);
    for (const std::uint16_t weight : entry.weight) out.put(weight);
  }
  for (const std::uint16_t texel : b.followers) out.put(texel);
}

bool get_binding(ByteReader& in, Binding& b) {
  Counts counts{};
  for (std::uint64_t* count : {&counts.joints, &counts.ellipsoids, &counts.terms, &counts.texels,
                               &counts.bundles, &counts.entries, &counts.followers})
    *count = in.get<std::uint32_t>();
  b.burial_step_m = in.get_float();
  if (!in.ok() || counts.joints * kLeastJointBytes > in.left()) return false;
  for (std::uint64_t j = 0; j < counts.joints; ++j)
    if (!get_joint(in, b)) return false;
  if (in.left() != counts.bytes()) return false;
  get_ellipsoids(in, counts, b);
  for (std::uint64_t i = 0; i < counts.terms; ++i) {
    CarryTerm term;
    term.joint = in.get<std::uint16_t>();
    for (double& value : term.matrix) value = in.get_double();
    b.terms.push_back(term);
  }
  for (std::uint64_t i = 0; i < counts.texels; ++i) b.burial.push_back(in.get<std::uint8_t>());
  for (std::uint64_t i = 0; i < counts.bundles; ++i) {
    std::uint32_t first = 0;
    b.bundles.push_back(get_bundle(in, first));
    b.first_entry.push_back(first);
  }
  b.first_entry.push_back(in.get<std::uint32_t>());
  for (std::uint64_t i = 0; i < counts.entries; ++i) {
    SkinEntry entry;
    entry.term = in.get<std::uint16_t>();
    for (std::uint16_t& weight : entry.weight) weight = in.get<std::uint16_t>();
    b.entries.push_back(entry);
  }
  for (std::uint64_t i = 0; i < counts.followers; ++i) b.followers.push_back(in.get<std::uint16_t>());
  return in.ok();
}

void add_to_hash(engine::Hasher& hasher, const Binding& binding) {
  ByteWriter bytes;
  put_binding(bytes, binding);
  const auto written = bytes.written();
  hasher.add(written.size());
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < written.size(); ++i) {
    word = word << 8 | std::to_integer<std::uint64_t>(written[i]);
    if (i % 8 == 7 || i + 1 == written.size()) hasher.add(std::exchange(word, 0));
  }
}

}  // namespace bodice::proxy
