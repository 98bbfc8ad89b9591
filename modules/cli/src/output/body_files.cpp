#include "output/body_files.hpp"

#include <bodice/anatomy/measure.hpp>
#include <bodice/engine/write_file.hpp>
#include <bodice/io/obj.hpp>
#include <bodice/io/scene.hpp>
#include <bodice/tryon/error_map.hpp>
#include <bodice/tryon/measurements.hpp>
#include <bodice/tryon/segmentation.hpp>

#include "output/outputs.hpp"

namespace bodice::inline v0_1::cli {

engine::Result<void> write_measurements(const tryon::SegmentedSkin& skin, tryon::TailorUnit unit,
                                        const std::string& file) {
  const body::Measurements measurements = anatomy::measure(skin.input.skin, skin.anatomy);
  const std::string text = extension_of(file) == ".json" ? tryon::measurements_json(measurements, unit)
                                                         : tryon::measurements_yaml(measurements, unit);
  return engine::write_file(file, std::string_view(text));
}

engine::Result<void> write_segmentation(const engine::Context& context, const tryon::SegmentedSkin& skin,
                                        const std::string& file) {
  const auto vertices = io::read_obj_positions(skin.input.file);
  if (!vertices) return vertices.error();
  const std::string text = tryon::segmentation_json(context, skin, *vertices);
  return engine::write_file(file, std::string_view(text));
}

engine::Result<double> write_heat_map(const engine::Context& context, const tryon::PreparedBody& body,
                                      const std::string& file) {
  tryon::ErrorMap map = tryon::error_map(context, body);
  const geometry::TriMesh& skin = body.skin.input.skin;
  io::Scene scene;
  const io::PictureOptions options{.legend = tryon::legend_of(map)};
  scene.garments.push_back({"skin", skin, {skin.positions}, {0.0}, std::move(map.colors)});
  const std::size_t frames[] = {0};
  if (auto saved = io::write_picture(scene, frames, file, options); !saved) return std::move(saved).error();
  return map.limit_m;
}

}  // namespace bodice::cli
