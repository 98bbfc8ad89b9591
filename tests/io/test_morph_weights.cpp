#include <doctest/doctest.h>

#include <assimp/scene.h>
#include <assimp/Importer.hpp>
#include <bodice/io/scene.hpp>
#include <bodice_test/shapes.hpp>
#include <bodice_test/temp_folder.hpp>

using namespace bodice;
using bodice_test::TempFolder;

TEST_CASE("frames beyond 128 store the weights that are one alone, and assimp plays them") {
  const TempFolder folder;
  io::Scene scene;
  io::GarmentTrack& track = scene.garments.emplace_back();
  track.name = "cloth";
  track.mesh = bodice_test::sheet(1.0, 1.0, 1, 1);
  constexpr std::size_t kFrames = 400;
  for (std::size_t f = 0; f < kFrames; ++f) {
    track.frames.push_back(track.mesh.positions);
    track.time_s.push_back(static_cast<double>(f) / 30.0);
  }
  REQUIRE(io::write_glb(scene, folder / "long.glb").ok());
  CHECK(std::filesystem::file_size(folder / "long.glb") <
        kFrames * 700);  // the square takes 1600 a frame more
  Assimp::Importer importer;
  const aiScene* read = importer.ReadFile((folder / "long.glb").string(), 0);
  REQUIRE(read);
  REQUIRE(read->mNumAnimations == 1);
  REQUIRE(read->mAnimations[0]->mNumMorphMeshChannels == 1);
  const aiMeshMorphAnim& channel = *read->mAnimations[0]->mMorphMeshChannels[0];
  REQUIRE(channel.mNumKeys == kFrames);
  for (std::size_t f = 0; f < kFrames; ++f) {
    const aiMeshMorphKey& key = channel.mKeys[f];
    REQUIRE(key.mNumValuesAndWeights == kFrames);
    for (std::size_t k = 0; k < kFrames; ++k) REQUIRE(key.mWeights[k] == (k == f ? 1.0 : 0.0));
  }
}
