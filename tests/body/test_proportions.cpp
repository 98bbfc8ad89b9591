#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include <bodice/body/proportions.hpp>

using namespace bodice::body;
using bodice::engine::ErrorCode;

namespace {

constexpr const char* kSex =
    R"({"upper_arm":0.19,"forearm":0.15,"hand":0.11,"fingertip_to_elbow":0.26,"fingertip_to_armpit":0.38,
        "crotch_height":0.48,"knee_height":0.27,"lower_leg":0.22,"neck_height":0.86,"acromion_height":0.82,
        "axilla_height":0.76,"chest_height":0.73,"waist_height":0.6,"head_length":0.13,"foot_length":0.15})";

class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text)
      : path_(std::filesystem::temp_directory_path() / "bodice_test_profile.json") {
    std::ofstream(path_) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace

TEST_CASE("built-in profiles: a body's measures are in anatomical order and fit together") {
  REQUIRE(profile_names().size() == 2);
  for (const std::string& name : profile_names()) {
    CAPTURE(name);
    const auto profile = find_profile(name);
    REQUIRE(profile.ok());
    for (Sex sex : {Sex::kFemale, Sex::kMale}) {
      const Proportions& p = profile->of(sex);
      CHECK(p.neck_height > p.acromion_height);
      CHECK(p.acromion_height > p.axilla_height);
      CHECK(p.axilla_height > p.chest_height);
      CHECK(p.chest_height > p.waist_height);
      CHECK(p.waist_height > p.crotch_height);
      CHECK(p.crotch_height > p.knee_height);
      CHECK(p.fingertip_to_armpit > p.fingertip_to_elbow);
      // A length along the arm is the sum of its pieces, up to the slack of the joints' landmarks.
      CHECK(std::abs(p.fingertip_to_elbow - p.forearm - p.hand) < 0.01);
    }
  }
}

TEST_CASE("the values are the surveys'") {
  CHECK(find_profile("ansur2")->male.crotch_height == 0.481);
  CHECK(find_profile("ansur2")->female.forearm == 0.1478);
  CHECK(find_profile("gb10000-88")->female.upper_arm == 0.1809);
  CHECK(find_profile("gb10000-88")->male.neck_height == 0.850);
  CHECK(find_profile("ansur2")->either().knee_height == doctest::Approx(0.2675));
}

TEST_CASE("an unknown profile's error lists those that exist") {
  const auto missing = find_profile("ansur3");
  REQUIRE_FALSE(missing.ok());
  CHECK(missing.error().code == ErrorCode::kNotFound);
  for (const std::string& name : profile_names())
    CHECK(missing.error().sentence().find(name) != std::string::npos);
}

TEST_CASE("a custom profile is read, and each fault is named") {
  const std::string good = std::string(R"({"name":"mine","female":)") + kSex + R"(,"male":)" + kSex + "}";
  {
    const TemporaryFile file(good);
    const auto profile = load_profile(file.path());
    REQUIRE(profile.ok());
    CHECK(profile->name == "mine");
    CHECK(profile->male.lower_leg == 0.22);
  }
  struct Fault {
    std::string text, named;
  };
  const Fault faults[] = {{with(good, "\"knee_height\":0.27,", ""), "female.knee_height"},
                          {with(good, "\"hand\":0.11", "\"hand\":11.0"), "female.hand"},
                          {with(good, "\"hand\":0.11", "\"hand\":\"long\""), "female.hand"},
                          {with(good, "\"male\"", "\"man\""), "male"},
                          {"[1, 2", "not a JSON object"},
                          {"", "not a JSON object"}};
  for (const Fault& fault : faults) {
    const TemporaryFile file(fault.text);
    const auto profile = load_profile(file.path());
    REQUIRE_FALSE(profile.ok());
    CAPTURE(profile.error().message);
    CHECK(profile.error().message.find(fault.named) != std::string::npos);
  }
  CHECK(load_profile("/no/such/profile.json").error().code == ErrorCode::kNotFound);
}
