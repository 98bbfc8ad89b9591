#include <doctest/doctest.h>

#include <map>
#include <optional>

#include <bodice/engine/json.hpp>

using bodice::engine::Json;
using bodice::engine::JsonError;
using bodice::engine::SortedJson;

TEST_CASE("json: braces make objects of pairs that begin with text, and arrays of anything else") {
  const std::vector<float> weights = {0.5f, 2.0f};
  const std::map<std::string, std::vector<std::string>> lists = {{"garment", {"a.obj", "b.obj"}}};
  Json line = {{"name", "skin"}, {"at", {0.0, -1, 3u}}, {"one", {7}}, {"of", {{"x", true}}}, {"w", weights}};
  line["lists"] = lists;
  line["words"] = {"two", "words"};
  line["list"].push_back({{"inner", Json()}});
  line["scenes"] = Json::array({Json{{"nodes", Json::array()}}});
  CHECK(line.dump() ==
        R"({"name":"skin","at":[0.0,-1,3],"one":[7],"of":{"x":true},"w":[0.5,2.0],)"
        R"("lists":{"garment":["a.obj","b.obj"]},"words":["two","words"],"list":[{"inner":null}],)"
        R"("scenes":[{"nodes":[]}]})");
  CHECK(Json(line["of"]).dump({.indent = 1}) == "{\n \"x\": true\n}");
}

TEST_CASE("json: members keep the order in which they were added, or are sorted by their keys") {
  const std::string text = R"({"b":1,"a":{"z":2,"y":3},"c":4})";
  CHECK(Json::parse(text).dump() == text);
  const std::string sorted = R"({"a":{"y":3,"z":2},"b":1,"c":4})";
  CHECK(SortedJson::parse(text).dump() == sorted);
  CHECK(SortedJson(Json::parse(text)) == SortedJson::parse(sorted));
}

TEST_CASE("json: values of a text are read with their kinds, and of equal keys the last one counts") {
  const Json read =
      Json::parse(R"({"k":[1,-2,3.5,18446744073709551615,"\u00e9\n",true,null],"m":1,"m":{"n":2}})");
  const Json& list = read["k"];
  REQUIRE(list.size() == 7);
  CHECK(list[0].is_number_unsigned());
  CHECK((list[1].is_number_integer() && !list[1].is_number_unsigned()));
  CHECK((list[2].is_number_float() && list[2].get<float>() == 3.5f));
  CHECK(list[3].get<std::uint64_t>() == 18446744073709551615u);
  CHECK(list[4].get<std::string>() == "\xc3\xa9\n");
  CHECK(list[5].get<bool>());
  CHECK(list[6].is_null());
  CHECK(read["m"]["n"].get<int>() == 2);
  CHECK(read.size() == 2);
  CHECK(read["absent"].is_null());
  CHECK(read.value("absent", 4.5) == 4.5);
  CHECK(read.value("absent", "text") == "text");
  CHECK(list[0] == Json(1.0));
  CHECK(list[1] != Json(2));
}

TEST_CASE("json: an error states what is wrong, and how many bytes were read") {
  const auto error_of = [](std::string_view text) -> std::optional<JsonError> {
    try {
      Json::parse(text);
    } catch (const JsonError& error) {
      return error;
    }
    return std::nullopt;
  };
  for (const auto& [text, byte] : {std::pair("{\"a\":1,}", 8u), {"", 1u}, {"[1", 3u}, {"{\"a\" 1}", 6u}}) {
    CAPTURE(text);
    const auto error = error_of(text);
    REQUIRE(error);
    CHECK(error->kind == JsonError::Kind::kSyntax);
    CHECK(error->byte == byte);
    CHECK(Json::parse_or_null(text).is_null());
  }
  REQUIRE(error_of("[1e999]"));
  CHECK(error_of("[1e999]")->kind == JsonError::Kind::kNumberRange);
  CHECK(!error_of("[1e99]"));
  const Json text = "text";
  CHECK_THROWS_AS(text.get<double>(), JsonError);
  CHECK_THROWS_AS(text.at("member"), JsonError);
  CHECK_THROWS_AS(Json(1).push_back(2), JsonError);
}

TEST_CASE("json: bytes that are not UTF-8 are an error, or replaced where the style permits it") {
  const Json name = "a\xff";
  CHECK_THROWS_AS(name.dump(), JsonError);
  CHECK(name.dump({.replaces_invalid = true}) == "\"a\xef\xbf\xbd\"");
  CHECK(Json("\xc3\xa9").dump({.ascii = true}) == "\"\\u00e9\"");
}

TEST_CASE("json: arrays of a million levels are read and released") {
  constexpr std::size_t kLevels = 1'000'000;
  const Json deep = Json::parse(std::string(kLevels, '[') + std::string(kLevels, ']'));
  std::size_t levels = 1;
  for (const Json* level = &deep; level->size() == 1; level = level->begin()) ++levels;
  CHECK(levels == kLevels);
}

TEST_CASE("json: members are removed and replaced") {
  SortedJson object = {{"a", 1}, {"b", {{"c", 2}}}, {"d", 3}};
  object.erase("a");
  object.erase("absent");
  object.erase_if([](SortedJson::Member& member) {
    if (member.value.is_object()) member.value["c"] = 5;
    return member.key == "d";
  });
  object.update({{"e", 6}, {"b", 7}});
  CHECK(object.dump() == R"({"b":7,"e":6})");
  SortedJson copy = object;
  copy["b"] = object;
  CHECK(copy.dump() == R"({"b":{"b":7,"e":6},"e":6})");
  CHECK(object != copy);
}
