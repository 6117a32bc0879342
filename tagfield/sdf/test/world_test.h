// SPDX-License-Identifier: Apache-2.0
/// @file
/// Fixture shared by the tests of load_world: a folder with files of its own.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tagfield/base/test/temporary_folder.h"
#include "tagfield/sdf/load_world.h"

namespace tagfield {

class WorldTest : public testing::Test {
 protected:
  [[nodiscard]] std::string path_of(const std::string& name) const { return folder_.file(name); }

  std::string write(const std::string& name, const std::string& text) {
    return folder_.with(name, text);
  }

  /// models/NAME/ with a model of that name, whose `inside` starts on line 2 of model.sdf.
  void write_model(const std::string& name, const std::string& inside) {
    write("models/" + name + "/model.config",
          "<model><name>" + name + "</name><sdf version='1.6'>model.sdf</sdf></model>");
    write("models/" + name + "/model.sdf",
          "<sdf version='1.6'><model name='" + name + "'>\n" + inside + "\n</model></sdf>\n");
  }

  /// Loads a world whose first two lines are <sdf> and <world>, so that `inside` starts on line 3.
  Scene load(const std::string& inside, const std::string& version = "1.9") {
    return load_file(write("world.sdf", world(inside, version)));
  }

  Scene load_file(const std::string& path, const std::vector<std::string>& search_paths = {}) {
    return load_world(path, search_paths, diagnostics_);
  }

  /// The message of the Error thrown when loading `path`, or "".
  std::string error_of_file(const std::string& path) {
    try {
      load_file(path);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  /// Same for a world made as in load(), without the file's folder.
  std::string error_of(const std::string& inside, const std::string& version = "1.9") {
    const std::string message = error_of_file(write("world.sdf", world(inside, version)));
    const std::string prefix = path_of("");
    return message.rfind(prefix, 0) == 0 ? message.substr(prefix.size()) : message;
  }

  static std::string world(const std::string& inside, const std::string& version = "1.9") {
    return "<sdf version='" + version + "'>\n<world name='test'>\n" + inside + "\n</world></sdf>\n";
  }

  /// A model "m" with a link "l" with a collision "c", each on its own line: 3, 4 and 5.
  static std::string model_with(const std::string& geometry) {
    return "<model name='m'>\n<link name='l'>\n<collision name='c'>\n<geometry>" + geometry +
           "</geometry></collision></link></model>";
  }

  [[nodiscard]] const std::vector<std::string>& warnings() const { return diagnostics_.warnings(); }

  Diagnostics diagnostics_;

 private:
  TemporaryFolder folder_;
};

/// A triangle with corners at the origin, (1, 0, 0) and (0, 1, 0).
inline const char* const kTriangleObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

}  // namespace tagfield
