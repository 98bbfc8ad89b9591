// Proxy files, JSON and binary: what is read is valid, survives being written and read, and can be queried.
#include <cmath>
#include <string_view>

#include <bodice/collision/collider.hpp>
#include <bodice/proxy/proxy_file.hpp>

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
}

}  // namespace

FUZZ_TARGET(proxy) {
  const auto binary = proxy::from_binary(std::as_bytes(std::span(data, size)));
  fuzz::check_reported(binary);
  if (binary.ok()) use(*binary);
  const auto json = proxy::from_json(std::string_view(reinterpret_cast<const char*>(data), size));
  fuzz::check_reported(json);
  if (json.ok()) use(*json);
  return 0;
}
