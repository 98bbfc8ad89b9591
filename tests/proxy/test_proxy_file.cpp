#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include <bodice/engine/hash.hpp>
#include <bodice/proxy/proxy_file.hpp>
#include <bodice_test/extremes.hpp>
#include <bodice_test/temp_folder.hpp>

#include "sample_proxy.hpp"

using namespace bodice::proxy;
using bodice::engine::Random;
using bodice::geometry::Axis;
using bodice_test::sample_data;

namespace {

void check_equal(const BodyProxy& a, const BodyProxy& b) {
  CHECK(a.hash() == b.hash());
  CHECK(a.source_hash() == b.source_hash());
  CHECK(a.frame().meters_per_unit == b.frame().meters_per_unit);
  CHECK(a.frame().up == b.frame().up);
  CHECK(a.stature_m() == b.stature_m());
  REQUIRE(a.ellipsoids().size() == b.ellipsoids().size());
  for (std::size_t i = 0; i < a.ellipsoids().size(); ++i) {
    CHECK(a.ellipsoids()[i].shape.axes == b.ellipsoids()[i].shape.axes);
    CHECK(a.ellipsoids()[i].shape.center == b.ellipsoids()[i].shape.center);
    CHECK(a.ellipsoids()[i].shape.radii == b.ellipsoids()[i].shape.radii);
    CHECK(a.ellipsoids()[i].bone == b.ellipsoids()[i].bone);
  }
}

/// Feeds the bytes to both readers. What they accept must be a proxy that survives another round.
void feed(std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (const auto& result : {from_json(text), from_binary(bytes)}) {
    if (!result.ok()) {
      REQUIRE_FALSE(result.error().message.empty());
      continue;
    }
    REQUIRE(from_binary(to_binary(*result))->hash() == result->hash());
    REQUIRE(from_json(to_json(*result))->hash() == result->hash());
  }
}

/// Corrects the checksum, so that mutations reach the fields before it.
void repair_checksum(std::vector<std::byte>& bytes) {
  if (bytes.size() < 8) return;
  bodice::engine::Hasher hasher;
  hasher.add(bytes.size() - 8);
  for (std::size_t i = 0; i + 8 < bytes.size(); ++i) hasher.add(std::to_integer<std::uint8_t>(bytes[i]));
  for (int i = 0; i < 8; ++i) bytes[bytes.size() - 8 + i] = static_cast<std::byte>(hasher.value() >> (8 * i));
}

std::vector<std::byte> mutated(std::vector<std::byte> bytes, Random& random) {
  const int edits = 1 + static_cast<int>(random.below(4));
  for (int i = 0; i < edits && !bytes.empty(); ++i) {
    const std::size_t at = random.below(bytes.size());
    const auto kind = random.below(5);
    if (kind == 0) bytes[at] ^= static_cast<std::byte>(1u << random.below(8));
    if (kind == 1) bytes[at] = static_cast<std::byte>(random.below(256));
    if (kind == 2) bytes.resize(at);
    if (kind == 3)
      bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes[random.below(bytes.size())]);
    if (kind == 4) bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at));
  }
  return bytes;
}

std::vector<std::byte> bytes_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

}  // namespace

TEST_CASE("both forms give every bit back, in any unit and up axis") {
  std::uint64_t seed = 0;
  for (double unit : {1.0, 0.01, 0.001, 0.1, 0.0254, 0.3048, 1.0 / 3.0, 1e-6, 1e6, 3.4380541234567891})
    for (Axis up : {Axis::kX, Axis::kY, Axis::kZ})
      for (bool relief : {false, true}) {
        CAPTURE(unit);
        auto data = sample_data(++seed, 12, relief);
        data.frame = {unit, up};
        const auto proxy = BodyProxy::make(data);
        REQUIRE(proxy.ok());
        const auto json = from_json(to_json(*proxy));
        REQUIRE_MESSAGE(json.ok(), (json.ok() ? "" : json.error().message));
        check_equal(*json, *proxy);
        const auto binary = from_binary(to_binary(*proxy));
        REQUIRE(binary.ok());
        check_equal(*binary, *proxy);
      }
}

TEST_CASE("the hostile ellipsoids survive both forms") {
  for (const auto& extreme : bodice_test::extreme_ellipsoids()) {
    CAPTURE(extreme.name);
    BodyProxy::Data data;
    data.ellipsoids.push_back({extreme.shape});
    data.frame = {0.01, Axis::kZ};
    const auto proxy = BodyProxy::make(data);
    REQUIRE(proxy.ok());
    CHECK(from_json(to_json(*proxy))->hash() == proxy->hash());
    CHECK(from_binary(to_binary(*proxy))->hash() == proxy->hash());
  }
}

TEST_CASE("JSON is in the file's unit and axes") {
  BodyProxy::Data data;
  data.ellipsoids.push_back({{bodice::geometry::Vec3(0.0, 1.5, 0.25)}});
  data.frame = {0.01, Axis::kZ};  // centimeters, z up: y (height) is the file's z
  const std::string json = to_json(*BodyProxy::make(data));
  CHECK(json.find("\"center\":[0.0,-25.0,150.0]") != std::string::npos);
}

TEST_CASE("10,000 mutations of the binary form never crash, with and without a valid checksum") {
  Random random(1);
  const auto whole = to_binary(*BodyProxy::make(sample_data(1, 3)));
  for (int i = 0; i < 10000; ++i) {
    auto bytes = mutated(whole, random);
    if (i % 2 == 0) repair_checksum(bytes);
    feed(bytes);
  }
}

TEST_CASE("10,000 mutations of the JSON form never crash") {
  Random random(2);
  const auto whole = bytes_of(to_json(*BodyProxy::make(sample_data(2, 3))));
  for (int i = 0; i < 10000; ++i) feed(mutated(whole, random));
}

TEST_CASE("every single flipped bit of the binary form is noticed") {
  auto bytes = to_binary(*BodyProxy::make(sample_data(3, 2)));
  for (std::size_t i = 0; i < 8 * bytes.size(); ++i) {
    bytes[i / 8] ^= static_cast<std::byte>(1u << (i % 8));
    REQUIRE_FALSE(from_binary(bytes).ok());
    bytes[i / 8] ^= static_cast<std::byte>(1u << (i % 8));
  }
  CHECK(from_binary(bytes).ok());
}

TEST_CASE("every truncation of either form is refused") {
  const auto proxy = BodyProxy::make(sample_data(4, 2));
  const auto binary = to_binary(*proxy);
  for (std::size_t n = 0; n < binary.size(); ++n) CHECK_FALSE(from_binary(std::span(binary).first(n)).ok());
  const std::string json = to_json(*proxy);
  for (std::size_t n = 0; n + 2 < json.size(); ++n) CHECK_FALSE(from_json(json.substr(0, n)).ok());
}

TEST_CASE("hostile JSON is refused: depth, huge numbers, wrong types, huge counts") {
  const std::string good = to_json(*BodyProxy::make(sample_data(5, 1)));
  CHECK_FALSE(from_json(std::string(1'000'000, '[')).ok());
  CHECK_FALSE(from_json("{\"format\":\"bodice-proxy\",\"version\":1e999}").ok());
  CHECK_FALSE(from_json("{\"format\":\"bodice-proxy\",\"version\":2}").ok());
  CHECK_FALSE(from_json("null").ok());
  CHECK_FALSE(from_json("").ok());
  CHECK_FALSE(from_json("\xff\xfe\x00").ok());
  auto replaced = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  CHECK_FALSE(from_json(replaced("\"tier\": \"relief\"", "\"tier\": 3")).ok());
  CHECK_FALSE(from_json(replaced("\"metres_per_unit\": 1.0", "\"metres_per_unit\": -1e300")).ok());
  CHECK_FALSE(from_json(replaced("\"center\":[", "\"center\":[1e308,")).ok());
  CHECK_FALSE(from_json(replaced("\"nodes\":0", "\"nodes\":18446744073709551615")).ok());
}

TEST_CASE("a slip in a hand-edited JSON is found by line and column") {
  const std::string good = to_json(*BodyProxy::make(sample_data(6, 1)));
  std::string edited = good;
  edited.replace(edited.find("\"stature\": "), 11, "\"stature\"= ");
  const auto refused = from_json(edited);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().message.find("up to line 7, column 11 is not JSON") != std::string::npos);
  CHECK(from_json("").error().message.find("line 1, column 0 ") != std::string::npos);
  CHECK(from_json("nope").error().message.find("line 1, column ") != std::string::npos);
  CHECK(from_json("[1e999]").error().message.find("range of numbers") != std::string::npos);
}

TEST_CASE("a hand-edited JSON is refused while it carries its old hash, and read without it") {
  const std::string good = to_json(*BodyProxy::make(sample_data(6, 1)));
  std::string edited = good;
  const std::size_t at = edited.find("\"stature\": 1.") + 13;
  edited[at] = edited[at] == '9' ? '8' : '9';
  const auto refused = from_json(edited);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().sentence().find("'hash'") != std::string::npos);
  const std::size_t line = edited.find(" \"hash\"");
  edited.erase(line, edited.find('\n', line) + 1 - line);
  CHECK(from_json(edited).ok());
}

TEST_CASE(
    "save and load: the form is chosen by name and recognized by content, and files appear whole or not at "
    "all") {
  namespace fs = std::filesystem;
  const bodice_test::TempFolder temp;
  const fs::path folder = temp.path();
  const auto proxy = BodyProxy::make(sample_data(7));
  for (const char* file : {"a.json", "a.bodice", "B.BODICE"}) {
    REQUIRE(save(*proxy, folder / file).ok());
    CHECK(load(folder / file)->hash() == proxy->hash());
  }
  CHECK(fs::file_size(folder / "a.bodice") < fs::file_size(folder / "a.json"));
  const auto files = std::distance(fs::directory_iterator(folder), fs::directory_iterator());
  CHECK(files == 3);  // no temporary file is left beside them
  CHECK(fs::file_size(folder / "B.BODICE") == fs::file_size(folder / "a.bodice"));
  fs::create_directory(folder / "taken.json");
  std::ofstream(folder / "taken.json" / "x") << "x";
  CHECK_FALSE(save(*proxy, folder / "taken.json").ok());
  CHECK_FALSE(save(*proxy, folder / "missing" / "a.json").ok());
  CHECK_FALSE(load(folder / "none.json").ok());
  CHECK_FALSE(load(folder).ok());
  std::ofstream(folder / "empty.json");
  const auto empty = load(folder / "empty.json");
  REQUIRE_FALSE(empty.ok());
  CHECK(empty.error().message.find("empty.json") != std::string::npos);
}
