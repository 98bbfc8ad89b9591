#include <doctest/doctest.h>

#include <limits>

#include <bodice/cloth/fabric.hpp>

using namespace bodice;

TEST_CASE("fabric: every preset has its name and is valid, and known fabrics differ as they should") {
  const auto names = cloth::fabric_names();
  REQUIRE(names.size() == 5);
  for (const std::string& name : names) {
    const auto fabric = cloth::find_fabric(name);
    REQUIRE(fabric.ok());
    CHECK(fabric->name == name);
    CHECK(cloth::check(*fabric).ok());
  }
  // These orders are common knowledge, and hold for any exact choice of the constants.
  CHECK(cloth::find_fabric("silk")->density_kg_m2 < cloth::find_fabric("denim")->density_kg_m2);
  CHECK(cloth::find_fabric("jersey")->stretch_n_m < cloth::find_fabric("cotton")->stretch_n_m);
  CHECK(cloth::find_fabric("silk")->bend_n_m < cloth::find_fabric("leather")->bend_n_m);
}

TEST_CASE("fabric: an unknown name fails with a remedy that lists the names") {
  const auto none = cloth::find_fabric("steel");
  REQUIRE_FALSE(none.ok());
  CHECK(none.error().code == engine::ErrorCode::kNotFound);
  CHECK(none.error().remedy.find("denim") != std::string::npos);
}

TEST_CASE("fabric: a constant out of range fails with a message that names it") {
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    cloth::Fabric fabric;
    fabric.density_kg_m2 = bad;
    const auto checked = cloth::check(fabric);
    REQUIRE_FALSE(checked.ok());
    CHECK(checked.error().message.find("density_kg_m2") != std::string::npos);
  }
}
