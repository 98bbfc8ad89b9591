#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include <bodice/tryon/measurements.hpp>

using namespace bodice;
using body::MeasurementId;

namespace {

body::Measurements two_known() {
  body::Measurements m;
  m[MeasurementId::kWaist] = 0.71234567;
  m[MeasurementId::kShoulderInclination] = 0.5235987755982988;
  return m;
}

}  // namespace

TEST_CASE("measurements are written in millimeters and degrees, and null where they are not known") {
  const auto json = nlohmann::json::parse(tryon::measurements_json(two_known()));
  CHECK(json["units"]["length"] == "mm");
  CHECK(json["units"]["angle"] == "degree");
  CHECK(json["body"].size() == body::kMeasurementCount);
  CHECK(json["body"]["waist"].get<double>() == doctest::Approx(712.35));
  CHECK(json["body"]["shoulder_incl"].get<double>() == doctest::Approx(30.0));
  CHECK(json["body"]["hips"].is_null());
}

TEST_CASE("lengths in centimeters are those in millimeters, and angles stay") {
  using enum tryon::TailorUnit;
  const auto json = nlohmann::json::parse(tryon::measurements_json(two_known(), kCentimeter));
  CHECK(json["units"]["length"] == "cm");
  CHECK(json["body"]["waist"].get<double>() == doctest::Approx(71.235));
  const std::string yaml = tryon::measurements_yaml(two_known(), kCentimeter);
  CHECK(yaml.find("units:\n  length: cm\n") == 0);
  CHECK(yaml.find("\n  waist: 71.235\n") != std::string::npos);
  CHECK(yaml.find("\n  shoulder_incl: 30.0\n") != std::string::npos);
}

TEST_CASE("the YAML form holds the same names and numbers as the JSON form") {
  const auto json = nlohmann::json::parse(tryon::measurements_json(two_known()));
  const std::string yaml = tryon::measurements_yaml(two_known());
  CHECK(yaml.find("units:\n  length: mm\n") == 0);
  CHECK(yaml.find("\n  waist: 712.35\n") != std::string::npos);
  CHECK(yaml.find("\n  shoulder_incl: 30.0\n") != std::string::npos);
  for (const auto& [name, value] : json["body"].items()) {
    CAPTURE(name);
    CHECK(yaml.find("\n  " + name + (value.is_null() ? ": null\n" : ": ")) != std::string::npos);
  }
}
