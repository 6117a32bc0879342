#include "tagfield/sdf/resource_path.h"

#include <cstdlib>

#include "tagfield/sdf/test/world_test.h"

namespace tagfield {
namespace {

class ResourcePath : public WorldTest {
 protected:
  ResourcePath() {
    for (const char* variable : kVariables) unsetenv(variable);
  }
  ~ResourcePath() override {
    for (const char* variable : kVariables) unsetenv(variable);
  }

  static constexpr const char* kVariables[] = {"SDF_PATH", "GAZEBO_MODEL_PATH",
                                               "IGN_GAZEBO_RESOURCE_PATH", "GZ_SIM_RESOURCE_PATH"};
};

TEST_F(ResourcePath, FoldersAreInTheDocumentedOrder) {
  const std::string world = write("home/worlds/w.sdf", "");
  for (const char* folder : {"mine", "home/worlds/models", "home/models", "e1", "e2", "e3", "e4"}) {
    write(std::string(folder) + "/x", "");
  }
  setenv("GZ_SIM_RESOURCE_PATH", path_of("e4").c_str(), 1);
  setenv("SDF_PATH", (path_of("e1") + "::" + path_of("nosuch")).c_str(), 1);
  setenv("GAZEBO_MODEL_PATH", (path_of("e2") + ":" + path_of("e3")).c_str(), 1);
  EXPECT_EQ(resource_paths(world, {path_of("nosuch"), path_of("mine")}).folders,
            (std::vector<std::string>{path_of("mine"), path_of("home/worlds"),
                                      path_of("home/worlds/models"), path_of("home/models"),
                                      path_of("e1"), path_of("e2"), path_of("e3"), path_of("e4")}));
}

TEST_F(ResourcePath, ModelAndPackageUrisAreSoughtInEachFolder) {
  const std::string world = write("w.sdf", "");
  const std::string first = write("a/crate/mesh.dae", "");
  write("b/crate/mesh.dae", "");
  const std::string second = write("b/shelf/mesh.dae", "");
  const ResourcePaths paths = resource_paths(world, {path_of("a"), path_of("b")});
  EXPECT_EQ(find_resource("model://crate/mesh.dae", world, paths), first);
  EXPECT_EQ(find_resource("package://crate/mesh.dae", world, paths), first);
  EXPECT_EQ(find_resource("model://shelf/mesh.dae", world, paths), second);
  EXPECT_EQ(find_resource("model://crate", world, paths), path_of("a/crate"));
}

TEST_F(ResourcePath, FileUrisAndAbsolutePathsAreTaken) {
  const std::string file = write("x/mesh.dae", "");
  EXPECT_EQ(find_resource("file://" + file, "", {}), file);
  EXPECT_EQ(find_resource(file, "/somewhere/w.sdf", {}), file);
}

TEST_F(ResourcePath, RelativePathsAreBesideTheirFileFirst) {
  const std::string model = write("crate/model.sdf", "");
  const std::string beside = write("crate/meshes/a.dae", "");
  write("lib/meshes/a.dae", "");
  const std::string elsewhere = write("lib/meshes/b.dae", "");
  const ResourcePaths paths{{path_of("lib")}};
  EXPECT_EQ(find_resource("meshes/a.dae", model, paths), beside);
  EXPECT_EQ(find_resource("meshes/b.dae", model, paths), elsewhere);
  EXPECT_EQ(find_resource("../crate/meshes/a.dae", model, paths),
            path_of("crate/../crate/meshes/a.dae"));
}

TEST_F(ResourcePath, NothingIsFoundForWhatIsNotThere) {
  const ResourcePaths paths{{path_of("")}};
  for (const char* uri : {"", "model://", "model:///etc", "model://nosuch", "nosuch.dae", "file://",
                          "file:///nosuch", "http://example.org/a.dae", "://"}) {
    EXPECT_EQ(find_resource(uri, path_of("w.sdf"), paths), "") << uri;
  }
}

TEST_F(ResourcePath, MessageNamesTheUriAndTheFolders) {
  EXPECT_EQ(not_found("model://a", {{"/x", "/y"}}), "can't find 'model://a' (looked in /x, /y)");
  EXPECT_EQ(not_found("a", {}), "can't find 'a' (looked in no folder)");
}

}  // namespace
}  // namespace tagfield
