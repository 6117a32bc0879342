// SPDX-License-Identifier: Apache-2.0
/// @file
/// What HTTP clients ask of a live world, and what they are told: docs/live.md, openapi.json.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "tagfield/live/live_estimates.h"
#include "tagfield/live/live_world.h"
#include "tagfield/world/scene.h"

namespace tagfield::http {

/// A request whose address, origin and length have been checked.
struct ApiRequest {
  std::string method;  ///< "GET", "POST", "DELETE".
  std::string target;  ///< As it came: "/api/tags/tag%201/move?x=1".
  std::string body;
};

struct ApiResponse {
  int status = 200;
  std::string body;  ///< JSON.
};

/// An answer, or what is still to be worked out, by a thread that holds up nobody.
using ApiAnswer = std::variant<ApiResponse, std::function<ApiResponse()>>;

/// Whether the request changes the world.
bool is_command(const ApiRequest& request);

class Api {
 public:
  /// `scene`: the scenario's world. `seed` as the live world's.
  Api(const Scene& scene, const Scenario& scenario, std::uint64_t seed);
  ~Api();
  Api(Api&&) noexcept;
  Api& operator=(Api&&) noexcept;

  /// Where tags are, as far as reads say; before it answers.
  void add(std::shared_ptr<const LiveEstimates> estimates);
  /// Where antennas were planned (plan_layer_to_json()); before it answers.
  void add_plan(std::string json);

  /// For the thread that runs `world`. Never throws: what is wrong is a response of its own, 4xx
  /// with {"error": "one line"}. `stop` ends what is being worked out.
  ApiAnswer answer(LiveWorld& world, const ApiRequest& request, const std::atomic<bool>& stop);

  /// "POST /api/tags/{id}/move", for all that there are.
  [[nodiscard]] static std::vector<std::string> routes();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// {"error": message}.
ApiResponse api_error(int status, const std::string& message);

}  // namespace tagfield::http
