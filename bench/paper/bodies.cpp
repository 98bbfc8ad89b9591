#include "bodies.hpp"

#include <bodice/io/import.hpp>
#include <bodice/synth/body.hpp>

namespace paper_bench {
namespace {

using namespace bodice;

/// A body for a row of Table 2: a file of the data folder, and the measures by which synth makes one.
struct Recipe {
  const char* file;  ///< decimated to exactly the paper's count
  body::Sex sex;
  double stature_m, mass_kg;
};

constexpr Recipe kRecipes[] = {{"m_avg_rest_04508v.obj", body::Sex::kMale, 1.75, 72.0},
                               {"f_avg_rest_08650v.obj", body::Sex::kFemale, 1.61, 55.0},
                               {"m_tall_thin_rest_08750v.obj", body::Sex::kMale, 1.89, 73.0},
                               {"f_tall_muscle_rest_08850v.obj", body::Sex::kFemale, 1.74, 66.0}};

engine::Result<Subject> from_file(const PaperRow& row, const std::filesystem::path& file) {
  auto found = io::import_body({}, file);
  if (!found) return found.error();
  return Subject{row, file.filename().string(), std::move(found->skin)};
}

engine::Result<Subject> from_synth(const PaperRow& row, const Recipe& recipe) {
  synth::BodyOptions options;
  options.sex = recipe.sex;
  options.stature_m = recipe.stature_m;
  options.mass_kg = recipe.mass_kg;
  options.vertices = row.vertices;
  auto made = synth::make_body({}, options);
  if (!made) return made.error();
  return Subject{row, "synth", std::move(made->mesh)};
}

}  // namespace

engine::Result<std::vector<Subject>> four_bodies(const std::filesystem::path& data) {
  std::vector<Subject> bodies;
  for (std::size_t i = 0; i < std::size(kRecipes); ++i) {
    auto body = data.empty() ? from_synth(kTable2[i], kRecipes[i])
                             : from_file(kTable2[i], data / "counts" / kRecipes[i].file);
    if (!body) return body.error();
    bodies.push_back(std::move(*body));
  }
  return bodies;
}

}  // namespace paper_bench
