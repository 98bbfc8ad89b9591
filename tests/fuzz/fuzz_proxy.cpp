// Proxy files, JSON and binary: what is read is valid, survives being written and read, and can be queried
// and posed. Binary ones are read with the right checksum, too, which mutated bytes do not have.
#include <cmath>
#include <string_view>
#include <vector>

#include <bodice/binding/poser.hpp>
#include <bodice/collision/collider.hpp>
#include <bodice/proxy/proxy_file.hpp>

#include "bytes/bytes.hpp"
#include "harness.hpp"

using namespace bodice;

namespace {

void use(const proxy::BodyProxy& proxy) {
  const auto again = proxy::from_binary(proxy::to_binary(proxy));
  FUZZ_CHECK(again.ok() && again->hash() == proxy.hash());
  const auto text = proxy::from_json(proxy::to_json(proxy));
  FUZZ_CHECK(text.ok() && text->hash() == proxy.hash());
  const collision::Collider collider(proxy);
  const auto contact = collider.query({0.1f, 0.2f, 0.3f});
  FUZZ_CHECK(!std::isnan(contact.signed_distance));
  if (proxy.binding() == nullptr) return;
  auto poser = binding::Poser::make(proxy);
  FUZZ_CHECK(poser.ok());
  fuzz::check_reported(poser->pose({}, proxy.binding()->bind));
}

/// The bytes with the checksum that they should have, so that what lies before it is read.
std::vector<std::byte> sealed(std::span<const std::byte> bytes) {
  constexpr std::size_t kChecksumBytes = 8;
  std::vector<std::byte> out(bytes.begin(), bytes.end());
  if (out.size() < kChecksumBytes) return out;
  std::uint64_t sum = proxy::checksum(bytes.first(bytes.size() - kChecksumBytes));
  for (std::size_t i = out.size() - kChecksumBytes; i < out.size(); ++i, sum >>= 8)
    out[i] = static_cast<std::byte>(sum & 0xff);
  return out;
}

}  // namespace

FUZZ_TARGET(proxy) {
  const auto binary = proxy::from_binary(std::as_bytes(std::span(data, size)));
  fuzz::check_reported(binary);
  if (binary.ok()) use(*binary);
  const auto mended = proxy::from_binary(sealed(std::as_bytes(std::span(data, size))));
  fuzz::check_reported(mended);
  if (mended.ok()) use(*mended);
  const auto json = proxy::from_json(std::string_view(reinterpret_cast<const char*>(data), size));
  fuzz::check_reported(json);
  if (json.ok()) use(*json);
  return 0;
}
