// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/resource_path.h"

#include <cstdlib>
#include <filesystem>

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

  [[nodiscard]] static std::string find(const std::string& uri, const std::string& naming_file,
                                        const ResourcePaths& paths) {
    return find_resource(uri, naming_file, paths).path;
  }

  static constexpr const char* kVariables[] = {"SDF_PATH",
                                               "GAZEBO_MODEL_PATH",
                                               "GAZEBO_RESOURCE_PATH",
                                               "IGN_GAZEBO_RESOURCE_PATH",
                                               "GZ_SIM_RESOURCE_PATH",
                                               "GZ_FUEL_CACHE_PATH",
                                               "IGN_FUEL_CACHE_PATH",
                                               "HOME"};
};

TEST_F(ResourcePath, FoldersAreInTheDocumentedOrder) {
  const std::string world = write("home/worlds/w.sdf", "");
  for (const char* folder : {"mine", "home/worlds/models", "home/models", "e1", "e2", "e3", "e4"}) {
    write(std::string(folder) + "/x", "");
  }
  setenv("GZ_SIM_RESOURCE_PATH", path_of("e4").c_str(), 1);
  setenv("SDF_PATH", (path_of("e1") + "::" + path_of("nosuch")).c_str(), 1);
  setenv("GAZEBO_MODEL_PATH", (path_of("e2") + ":" + path_of("e3")).c_str(), 1);
  std::vector<std::string> expected;
  for (const char* folder :
       {"mine", "home/worlds", "home/worlds/models", "home/models", "e1", "e2", "e3", "e4"}) {
    expected.push_back(path_of(folder));
  }
  const std::string of_gazebo = "/usr/share/gazebo-11/models";
  if (std::filesystem::exists(of_gazebo)) expected.push_back(of_gazebo);
  EXPECT_EQ(resource_paths(world, {path_of("nosuch"), path_of("mine")}).folders, expected);
}

TEST_F(ResourcePath, ModelAndPackageUrisAreSoughtInEachFolder) {
  const std::string world = write("w.sdf", "");
  const std::string first = write("a/crate/mesh.dae", "");
  write("b/crate/mesh.dae", "");
  const std::string second = write("b/shelf/mesh.dae", "");
  const ResourcePaths paths = resource_paths(world, {path_of("a"), path_of("b")});
  EXPECT_EQ(find("model://crate/mesh.dae", world, paths), first);
  EXPECT_EQ(find("package://crate/mesh.dae", world, paths), first);
  EXPECT_EQ(find("model://shelf/mesh.dae", world, paths), second);
  EXPECT_EQ(find("model://crate", world, paths), path_of("a/crate"));
}

TEST_F(ResourcePath, FileUrisAndAbsolutePathsAreTaken) {
  const std::string file = write("x/mesh.dae", "");
  const std::string world = path_of("x/w.sdf");
  EXPECT_EQ(find("file://" + file, world, {}), file);
  EXPECT_EQ(find(file, world, {}), file);
}

TEST_F(ResourcePath, RelativePathsAreBesideTheirFileFirst) {
  const std::string model = write("crate/model.sdf", "");
  const std::string beside = write("crate/meshes/a.dae", "");
  write("lib/meshes/a.dae", "");
  const std::string elsewhere = write("lib/meshes/b.dae", "");
  const ResourcePaths paths{{path_of("lib"), path_of("crate")}};
  EXPECT_EQ(find("meshes/a.dae", model, paths), beside);
  EXPECT_EQ(find("meshes/b.dae", model, paths), elsewhere);
  EXPECT_EQ(find("../crate/meshes/a.dae", model, paths), path_of("crate/../crate/meshes/a.dae"));
}

TEST_F(ResourcePath, NothingIsFoundForWhatIsNotThere) {
  const ResourcePaths paths{{path_of("")}};
  for (const char* uri : {"", "model://", "model://nosuch", "nosuch.dae", "file://",
                          "file:///nosuch", "http://example.org/a.dae", "://"}) {
    EXPECT_EQ(find(uri, path_of("w.sdf"), paths), "") << uri;
  }
}

TEST_F(ResourcePath, FilesOutsideOfAllFoldersAreNotTaken) {
  const std::string file = write("secret", "");
  write("home/models/x", "");
  ResourcePaths paths{{path_of("home/models")}};
  for (const std::string& uri :
       {file, "file://" + file, std::string("../secret"), std::string("model://../../secret")}) {
    const FoundResource found = find_resource(uri, path_of("home/w.sdf"), paths);
    EXPECT_EQ(found.path, "") << uri;
    EXPECT_NE(found.oddity.find("lies outside of all folders"), std::string::npos) << uri;
  }
  std::filesystem::create_symlink(file, path_of("home/link"));
  EXPECT_EQ(find("link", path_of("home/w.sdf"), paths), "");
  paths.allow_outside = true;
  EXPECT_EQ(find(file, path_of("home/w.sdf"), paths), file);
}

TEST_F(ResourcePath, RelativePathsAboveAFolderOfWorlds) {
  const std::string world = write("home/worlds/w.sdf", "");
  const std::string mesh = write("home/models/crate/a.dae", "");
  EXPECT_EQ(find("file://models/crate/a.dae", world, resource_paths(world, {})), mesh);
}

TEST_F(ResourcePath, PathsThatBeginWithTheNameOfAFolderOfModels) {
  write("home/secret", "");
  const std::string mesh = write("home/models/crate/a.dae", "");
  const ResourcePaths paths{{path_of("other"), path_of("home/models")}};
  const std::string world = path_of("elsewhere/w.sdf");
  EXPECT_EQ(find("file://models/crate/a.dae", world, paths), mesh);
  EXPECT_EQ(find("models/crate/a.dae", world, paths), mesh);
  EXPECT_EQ(find("file://models/../secret", world, paths), "");
  EXPECT_EQ(find("model://models/crate/a.dae", world, paths), "");
}

/// As Gazebo 11 does.
TEST_F(ResourcePath, RelativePathsInGazebosResourceFolders) {
  const std::string world = write("elsewhere/w.sdf", "");
  setenv("GAZEBO_RESOURCE_PATH", (path_of("nosuch") + ":" + path_of("res")).c_str(), 1);
  for (const std::string folder : {"", "models/", "media/models/", "Media/models/"}) {
    const std::string mesh = write("res/" + folder + "a.dae", "");
    const ResourcePaths paths = resource_paths(world, {});
    EXPECT_EQ(find("file://a.dae", world, paths), mesh);
    EXPECT_EQ(find("a.dae", world, paths), mesh);
    EXPECT_EQ(find("model://a.dae", world, paths), "");
    std::filesystem::remove(mesh);
  }
  write("res/worlds/a.dae", "");
  EXPECT_EQ(find("file://a.dae", world, resource_paths(world, {})), "");
}

TEST_F(ResourcePath, NamesInAnotherCaseAreFoundWithAWord) {
  const std::string mesh = write("models/Crate/meshes/A.DAE", "");
  const ResourcePaths paths{{path_of("models")}};
  const FoundResource found = find_resource("model://crate/Meshes/a.dae", path_of("w.sdf"), paths);
  EXPECT_EQ(found.path, mesh);
  EXPECT_EQ(found.oddity, "found with a different case, as '" + mesh + "'");
}

TEST_F(ResourcePath, FuelsModelsAreFoundInItsCachesAndByTheirNames) {
  write("home/w.sdf", "");
  for (const char* version : {"2", "10", "9"}) {
    write("home/.gz/fuel/fuel.gazebosim.org/openrobotics/models/shelf/" + std::string(version) +
              "/model.sdf",
          "");
  }
  write("home/models/ground_plane/model.sdf", "");
  setenv("HOME", path_of("home").c_str(), 1);
  const ResourcePaths paths = resource_paths(path_of("home/w.sdf"), {});
  const std::string fuel = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/";
  const std::string cache = path_of("home/.gz/fuel/fuel.gazebosim.org/openrobotics/models/shelf/");
  EXPECT_EQ(find(fuel + "Shelf", path_of("home/w.sdf"), paths), cache + "10");
  EXPECT_EQ(find(fuel + "shelf/2", path_of("home/w.sdf"), paths), cache + "2");
  EXPECT_EQ(find(fuel + "shelf/tip/files/model.sdf", path_of("home/w.sdf"), paths),
            cache + "10/model.sdf");
  const FoundResource plane = find_resource(fuel + "Ground Plane", path_of("home/w.sdf"), paths);
  EXPECT_EQ(plane.path, path_of("home/models/ground_plane"));
  EXPECT_NE(plane.oddity.find("not in Fuel's caches"), std::string::npos);
}

TEST_F(ResourcePath, MessageNamesTheUriAndTheFolders) {
  EXPECT_EQ(not_found("model://a", {{"/x", "/y"}}), "can't find 'model://a' (looked in /x, /y)");
  EXPECT_EQ(not_found("a", {}), "can't find 'a' (looked in no folder)");
}

}  // namespace
}  // namespace tagfield
