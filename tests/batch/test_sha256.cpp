// Published values: FIPS 180-4 examples of NIST.
#include <doctest/doctest.h>

#include "manifest/sha256.hpp"

using bodice::batch::Sha256;

namespace {

std::string hash_of(const std::string& text, std::size_t step) {
  Sha256 hash;
  for (std::size_t i = 0; i < text.size(); i += step) hash.add(std::string_view(text).substr(i, step));
  return bodice::batch::hex(hash.finish());
}

}  // namespace

TEST_CASE("SHA-256 gives the published values, in whatever pieces the bytes come") {
  const std::pair<std::string, const char*> published[] = {
      {"", "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"},
      {"abc", "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"},
      {"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq",
       "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"},
      {std::string(1'000'000, 'a'), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0"}};
  for (const auto& [text, value] : published)
    for (const std::size_t step : {1, 7, 63, 64, 65, 1000}) {
      CAPTURE(text.size());
      CAPTURE(step);
      CHECK(hash_of(text, step) == value);
    }
}
