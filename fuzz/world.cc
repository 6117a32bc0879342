// SPDX-License-Identifier: Apache-2.0
// A world as SDF; or, depending on the first byte, a mesh or heightmap image that a world refers
// to.
#include "fuzz/input.h"
#include "tagfield/sdf/load_world.h"

namespace {

constexpr const char* kMeshes[] = {"mesh.dae", "mesh.stl", "mesh.obj"};
constexpr std::uint8_t kHeightmap = 255;

std::string world_of(const std::string& shape, const std::string& file) {
  return "<sdf version='1.7'><world name='w'><model name='m'><static>1</static><link name='l'>"
         "<collision name='c'><geometry><" +
         shape + "><uri>" + file + "</uri></" + shape +
         "></geometry></collision></link></model></world></sdf>";
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tagfield;
  if (size == 0) return 0;
  const std::string_view text = fuzz::text_of(data + 1, size - 1);
  const unsigned kind = data[0] % 4U;
  std::string sdf(text);
  if (kind < 3) {
    fuzz::folder().write(kMeshes[kind], text);
    sdf = world_of("mesh", kMeshes[kind]);
  } else if (data[0] == kHeightmap) {
    fuzz::folder().write("heights.png", text);
    sdf = world_of("heightmap", "heights.png");
  }
  const std::string path = fuzz::folder().write("world.sdf", sdf);
  return fuzz::refused_or_taken([&] {
    Diagnostics unheard;
    load_world(path, {}, unheard);
  });
}
