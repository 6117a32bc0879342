// SPDX-License-Identifier: Apache-2.0
#include "adapters/http/api.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "adapters/http/embedded.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/simulator/test/recorded.h"

namespace tagfield::http {
namespace {

Scenario hall(bool is_physical) {
  Scenario scenario;
  scenario.name = "hall";
  scenario.duration_s = 1.0;
  AntennaSpec antenna;
  antenna.parameters.name = "gate";
  if (is_physical) {
    auto model = std::make_shared<RadioModel>();
    model->plan = fixed_plan(866e6);
    antenna.parameters.model = std::shared_ptr<const RadioModel>(std::move(model));
  }
  scenario.antennas = {antenna};
  scenario.tags = {tag_at("tag 1", {1.0, 0.0, 0.0})};
  return scenario;
}

class ApiTest : public testing::Test {
 protected:
  explicit ApiTest(bool is_physical = true)
      : world_(hall(is_physical), 1, {}, {0.0, true, true}), api_({}, hall(is_physical), 1) {}

  ApiResponse ask(const std::string& method, const std::string& target,
                  const std::string& body = "") {
    const ApiAnswer answer = api_.answer(world_, {method, target, body}, stop_);
    if (const auto* work = std::get_if<std::function<ApiResponse()>>(&answer)) return (*work)();
    return std::get<ApiResponse>(answer);
  }
  std::string error(const std::string& method, const std::string& target,
                    const std::string& body = "") {
    const ApiResponse response = ask(method, target, body);
    EXPECT_EQ(response.status, 400) << response.body;
    return nlohmann::json::parse(response.body)["error"];
  }
  LiveWorld world_;
  Api api_;
  std::atomic<bool> stop_{false};
};

class PaperApiTest : public ApiTest {
 protected:
  PaperApiTest() : ApiTest(false) {}
};

TEST_F(ApiTest, EveryAddressIsDescribedAndEveryDescribedOneIsThere) {
  const auto described = nlohmann::json::parse(openapi_file());
  std::vector<std::string> said;
  for (const auto& [path, methods] : described["paths"].items()) {
    for (const auto& [method, what] : methods.items()) {
      std::string upper = method;
      std::transform(upper.begin(), upper.end(), upper.begin(),
                     [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
      said.push_back(upper + " " + path);
    }
  }
  std::vector<std::string> served = Api::routes();
  served.emplace_back("GET /api/reads");  // handled by the server, as it is endless
  std::sort(said.begin(), said.end());
  std::sort(served.begin(), served.end());
  EXPECT_EQ(said, served);
}

TEST_F(ApiTest, CommandsChangeTheWorld) {
  EXPECT_EQ(ask("POST", "/api/tags", R"({"id": "new", "position": [1, 2, 3]})").status, 200);
  EXPECT_EQ(world_.tags().size(), 2U);
  EXPECT_EQ(ask("POST", "/api/tags/tag%201/move", R"({"position": [4, 5, 6]})").status, 200);
  EXPECT_EQ(world_.tags()[0].X_W.translation, Eigen::Vector3d(4.0, 5.0, 6.0));
  EXPECT_EQ(ask("POST", "/api/tags/new/detune", R"({"db": 2.5})").status, 200);
  EXPECT_EQ(world_.scenario().tags.back().model->detuning_db, 2.5);
  EXPECT_EQ(ask("DELETE", "/api/tags/new").status, 200);
  EXPECT_EQ(world_.tags().size(), 1U);
  EXPECT_EQ(ask("POST", "/api/antennas",
                R"({"name": "second", "like": "gate", "pose": [1, 0, 2, 0, 0, 1.5]})")
                .status,
            200);
  EXPECT_EQ(world_.antennas().size(), 2U);
  EXPECT_EQ(ask("POST", "/api/antennas/gate/disconnect").status, 200);
  EXPECT_TRUE(world_.antennas()[0].is_faulty);
  EXPECT_EQ(ask("POST", "/api/antennas/gate/connect").status, 200);
  EXPECT_TRUE(world_.antennas()[0].is_on);
  EXPECT_EQ(ask("POST", "/api/antennas/gate/move", R"({"pose": [0, 0, 3, 0, 0, 0]})").status, 200);
  EXPECT_EQ(world_.antenna_pose(world_.antennas()[0]).translation.z(), 3.0);
  EXPECT_EQ(ask("DELETE", "/api/antennas/second").status, 200);
  EXPECT_EQ(
      ask("POST", "/api/obstacles", R"({"name": "pallet", "position": [1, 1], "radius": 0.4})")
          .status,
      200);
  EXPECT_EQ(world_.scenario().obstacles.size(), 1U);
  EXPECT_EQ(ask("DELETE", "/api/obstacles/pallet").status, 200);
  EXPECT_EQ(ask("POST", "/api/speed", R"({"speed": 10})").status, 200);
  EXPECT_EQ(world_.speed(), 10.0);
  EXPECT_EQ(ask("POST", "/api/resume").status, 200);
  EXPECT_FALSE(world_.is_paused());
  EXPECT_EQ(ask("POST", "/api/pause").status, 200);
  EXPECT_TRUE(world_.is_paused());
  EXPECT_EQ(world_.revision(), 11U);
}

TEST_F(ApiTest, WhatIsWrongIsOneLine) {
  EXPECT_EQ(error("DELETE", "/api/tags/nobody"), "there is no tag with the ID 'nobody'");
  EXPECT_EQ(error("POST", "/api/tags", "{}"), "'id' is missing");
  EXPECT_EQ(error("POST", "/api/tags", R"({"id": "x", "position": [1, 2, 1e9]})"),
            "each number of 'position' must be from -100000 to 100000, is 1e+09");
  EXPECT_EQ(error("POST", "/api/tags", R"({"id": "x", "position": [1, 2, 3], "z": 1})"),
            "'z' is not known here");
  EXPECT_EQ(error("POST", "/api/tags", R"({"id": "x", "position": [1, 2, 3], "lik": "tag 1"})"),
            "'lik' is not known here (did you mean 'like'?)");
  EXPECT_EQ(error("POST", "/api/tags", R"({"id": "tag 1", "position": [1, 2, 3]})"),
            "there is a tag with the ID 'tag 1' already");
  EXPECT_EQ(error("POST", "/api/antennas/nobody/connect"), "there is no antenna called 'nobody'");
  EXPECT_EQ(error("POST", "/api/step", R"({"seconds": -1})").substr(0, 22),
            "'seconds' must be from");
  EXPECT_EQ(error("GET", "/api/explain?antenna=gate"), "'?tag=…' is missing");
  EXPECT_EQ(error("GET", "/api/coverage?antenna=gate&cell=0"), "'cell' must be from 0.01 to 10");
  EXPECT_EQ(ask("GET", "/api/nothing").status, 404);
  EXPECT_EQ(ask("DELETE", "/api/status").status, 405);
  EXPECT_EQ(world_.tags().size(), 1U);
}

TEST_F(ApiTest, AStepIsNotReplacedByAnother) {
  EXPECT_EQ(ask("POST", "/api/step", R"({"seconds": 2})").status, 200);
  const ApiResponse second = ask("POST", "/api/step", R"({"seconds": 0.5})");
  EXPECT_EQ(second.status, 409);
  EXPECT_EQ(nlohmann::json::parse(second.body)["error"],
            "a step is running, to 2 s: wait until the world is paused, or pause it");
  EXPECT_EQ(world_.step_end(), time_from_seconds(2.0));
  EXPECT_EQ(ask("POST", "/api/pause").status, 200);
  EXPECT_EQ(ask("POST", "/api/step", R"({"seconds": 0.5})").status, 200);
  EXPECT_EQ(world_.step_end(), time_from_seconds(0.5));
  EXPECT_EQ(ask("POST", "/api/resume").status, 200);  // without end: a step may end it
  EXPECT_EQ(world_.step_end(), std::nullopt);
  EXPECT_EQ(ask("POST", "/api/step", R"({"seconds": 0.5})").status, 200);
}

TEST_F(ApiTest, ParametersThatAreNotKnownAreRefused) {
  EXPECT_EQ(error("GET", "/api/explain?antena=gate&tag=tag%201"),
            "'?antena' is not a parameter here (did you mean 'antenna'?)");
  EXPECT_EQ(error("GET", "/api/coverage?antenna=gate&zz=1"),
            "'?zz' is not a parameter here (known: antenna, height, cell)");
  EXPECT_EQ(error("POST", "/api/pause?x=1"), "'?x' is not a parameter here: expected none");
  EXPECT_TRUE(world_.is_paused());
  const auto described = nlohmann::json::parse(openapi_file());
  for (const std::string& route : Api::routes()) {
    const std::string method = route.substr(0, route.find(' '));
    const std::string path = route.substr(route.find(' ') + 1);
    EXPECT_NE(error(method, path + "?zz=1").find("'?zz' is not a parameter"), std::string::npos);
    const auto& operation = described["paths"][path][method == "GET"    ? "get"
                                                     : method == "POST" ? "post"
                                                                        : "delete"];
    if (!operation.contains("parameters")) continue;
    for (const auto& parameter : operation["parameters"]) {
      if (parameter["in"] != "query") continue;
      const std::string name = parameter["name"];
      EXPECT_EQ(ask(method, path + "?" + name + "=").body.find("not a parameter"),
                std::string::npos)
          << path << " " << name;
    }
  }
}

TEST_F(ApiTest, AnObstacleIsOfMetalUnlessItSaysOtherwise) {
  const auto material = [&](const std::string& body) -> std::string {
    const ApiResponse added = ask("POST", "/api/obstacles", body);
    EXPECT_EQ(added.status, 200) << added.body;
    std::string answered = nlohmann::json::parse(added.body)["material"];
    EXPECT_EQ(world_.scenario().obstacles.back().body->material.name, answered);
    return answered;
  };
  EXPECT_EQ(material(R"({"name": "a", "position": [1, 1], "radius": 1})"), "metal");
  EXPECT_EQ(material(R"({"name": "b", "position": [1, 1], "radius": 1, "material": "wood"})"),
            "wood");
  const auto described = nlohmann::json::parse(openapi_file());
  EXPECT_EQ(described["paths"]["/api/obstacles"]["post"]["requestBody"]["content"]
                     ["application/json"]["schema"]["properties"]["material"]["default"],
            "metal");
}

TEST_F(ApiTest, CoverageAgreesWithTheLink) {
  const auto json = nlohmann::json::parse(ask("GET", "/api/coverage?antenna=gate&height=0").body);
  const double x0 = json["x0"];
  const double cell = json["cell"];
  const auto columns = json["columns"].get<std::size_t>();
  ASSERT_EQ(json["margin_db"].size(), columns * json["rows"].get<std::size_t>());
  // On the boresight, in free space, twice the distance is 6.02 dB less at the tag.
  const auto at = [&](double x, double y) {
    const auto column = static_cast<std::size_t>((x - x0) / cell);
    const auto row = static_cast<std::size_t>((y - json["y0"].get<double>()) / cell);
    return std::pair(x0 + cell * (static_cast<double>(column) + 0.5),
                     json["margin_db"][row * columns + column].get<double>());
  };
  const auto [near_m, near_db] = at(2.0, 0.1);
  const auto [far_m, far_db] = at(4.0, 0.1);
  EXPECT_NEAR(near_db - far_db, 20.0 * std::log10(far_m / near_m), 0.1);
}

TEST_F(PaperApiTest, WhatHasNoEffectIsRefused) {
  EXPECT_NE(error("POST", "/api/tags/tag%201/detune", R"({"db": 3})").find("paper's model"),
            std::string::npos);
  EXPECT_NE(error("POST", "/api/obstacles", R"({"name": "p", "position": [1, 1], "radius": 1})")
                .find("paper's model"),
            std::string::npos);
  EXPECT_TRUE(world_.scenario().obstacles.empty());
}

}  // namespace
}  // namespace tagfield::http
