// Files have decimal points even if the host has called setlocale().
#include <doctest/doctest.h>

#include <fstream>
#include <iterator>
#include <string>

#include <bodice/io/import.hpp>
#include <bodice/io/obj.hpp>
#include <bodice_test/comma_locale.hpp>
#include <bodice_test/temp_folder.hpp>

#include "figure.hpp"

using namespace bodice;
using namespace io_test;
using bodice_test::CommaLocale;
using bodice_test::TempFolder;

namespace {

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

bool skipped(const CommaLocale& locale) {
  if (!locale.active()) MESSAGE("skipped: no locale with a decimal comma is installed");
  return !locale.active();
}

}  // namespace

TEST_CASE("an OBJ is written with points where the host's locale has commas") {
  const TempFolder folder;
  REQUIRE(io::write_obj(figure(), folder / "plain.obj").ok());
  const CommaLocale locale;
  if (skipped(locale)) return;
  REQUIRE(io::write_obj(figure(), folder / "comma.obj").ok());
  CHECK(content(folder / "comma.obj") == content(folder / "plain.obj"));
}

TEST_CASE("bodies are read the same where the host's locale has commas") {
  const TempFolder folder;
  const TriMesh truth = figure();
  const TriMesh far = mapped(truth, [](const Vec3& p) { return Vec3(p + Vec3(10'000.0, 0.0, 7'000.0)); });
  REQUIRE(io::write_obj(far, folder / "far.obj").ok());
  folder.write("a.ply", to_ply(truth, false));
  folder.write("a.stl", to_stl(truth, false));
  folder.write("a.dae", to_collada({{"body", truth}}, 1.0, "Y_UP"));
  const CommaLocale locale;
  if (skipped(locale)) return;
  for (const char* name : {"a.ply", "a.stl", "a.dae", "far.obj"}) {
    CAPTURE(name);
    const auto body = io::import_body(kContext, folder / name);
    REQUIRE_MESSAGE(body.ok(), (body.ok() ? std::string() : body.error().sentence()));
    const bool is_far = std::string_view(name) == "far.obj";
    // With nine digits, coordinates of 10,000 m end at the tenth of a millimeter.
    CHECK(vertex_distance(body->skin, is_far ? far : truth) < (is_far ? 6e-5 : 2e-6));
  }
}
