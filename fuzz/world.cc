// A world as SDF; or, by the first byte, a mesh that one names.
#include "fuzz/input.h"
#include "tagfield/sdf/load_world.h"

namespace {

constexpr const char* kMeshes[] = {"mesh.dae", "mesh.stl", "mesh.obj"};

std::string world_of(const std::string& mesh) {
  return "<sdf version='1.7'><world name='w'><model name='m'><static>1</static><link name='l'>"
         "<collision name='c'><geometry><mesh><uri>" +
         mesh + "</uri></mesh></geometry></collision></link></model></world></sdf>";
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
    sdf = world_of(kMeshes[kind]);
  }
  const std::string path = fuzz::folder().write("world.sdf", sdf);
  return fuzz::refused_or_taken([&] {
    Diagnostics unheard;
    load_world(path, {}, unheard);
  });
}
