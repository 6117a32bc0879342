// SPDX-License-Identifier: Apache-2.0
// Requests to the API of a live world: a line "METHOD TARGET", a line with the body, and so on.
#include <nlohmann/json.hpp>
#include <variant>

#include "adapters/http/api.h"
#include "fuzz/input.h"
#include "fuzz/small_world.h"

namespace tagfield::fuzz {
namespace {

constexpr std::size_t kMaxRequests = 50;
constexpr std::size_t kMaxBody = std::size_t{1} << 16U;

std::string line_of(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string line(text.substr(0, std::min(end, kMaxBody)));
  text.remove_prefix(std::min(text.size(), end + 1));
  return line;
}

void ask(std::string_view text) {
  const Scenario hall = small_hall();
  LiveWorld world(hall, 1, {}, {0.0, false, true});
  const auto steps = std::make_shared<Steps>();
  world.attach(steps);
  http::Api api({}, hall, 1);
  const std::atomic<bool> stop{true};  // Long computations are skipped.
  for (std::size_t i = 0; i < kMaxRequests && !text.empty(); ++i) {
    const std::string request = line_of(text);
    const std::string body = line_of(text);
    const std::size_t space = std::min(request.find(' '), request.size());
    const std::string target = space < request.size() ? request.substr(space + 1) : "";
    http::ApiAnswer answer = api.answer(world, {request.substr(0, space), target, body}, stop);
    if (const auto* work = std::get_if<std::function<http::ApiResponse()>>(&answer)) {
      answer = (*work)();
    }
    const auto& response = std::get<http::ApiResponse>(answer);
    const auto json = nlohmann::json::parse(response.body, nullptr, false);
    if (json.is_discarded()) std::abort();
    if (response.status != 200 && !json.contains("error")) std::abort();
    if (!world.is_paused()) steps->go_on(world, 1);
  }
}

}  // namespace
}  // namespace tagfield::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return tagfield::fuzz::refused_or_taken(
      [&] { tagfield::fuzz::ask(tagfield::fuzz::text_of(data, size)); });
}
