// SPDX-License-Identifier: Apache-2.0
/// @file
/// The HTTP API of a live world: docs/live.md, openapi.json.
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
  std::string target;  ///< As received: "/api/tags/tag%201/move?x=1".
  std::string body;
};

struct ApiResponse {
  int status = 200;
  std::string body;  ///< JSON.
};

/// A response, or a function that computes it and may take long, to be run where it blocks nothing
/// else.
using ApiAnswer = std::variant<ApiResponse, std::function<ApiResponse()>>;

/// Whether the request changes the world.
bool is_command(const ApiRequest& request);

class Api {
 public:
  /// `scene`: the scenario's world. `seed`: that of the live world.
  Api(const Scene& scene, const Scenario& scenario, std::uint64_t seed);
  ~Api();
  Api(Api&&) noexcept;
  Api& operator=(Api&&) noexcept;

  /// Adds the tag positions estimated from reads; to be called before the first answer().
  void add(std::shared_ptr<const LiveEstimates> estimates);
  /// Adds planned antennas (plan_layer_to_json()); to be called before the first answer().
  void add_plan(std::string json);

  /// To be called on the thread that runs `world`. Never throws: an invalid request yields a 4xx
  /// response with {"error": "one line"}. `stop` cancels a pending computation.
  ApiAnswer answer(LiveWorld& world, const ApiRequest& request, const std::atomic<bool>& stop);

  /// All routes, such as "POST /api/tags/{id}/move".
  [[nodiscard]] static std::vector<std::string> routes();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Response with {"error": message}.
ApiResponse api_error(int status, const std::string& message);

}  // namespace tagfield::http
