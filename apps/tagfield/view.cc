#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <thread>

#include "adapters/http/http_server.h"
#include "adapters/http/run_json.h"
#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"

namespace tagfield {
namespace {

struct ViewArguments {
  std::string folder;
  std::uint16_t port = 8080;
  std::string listen = "127.0.0.1";
};

/// A run that is over: it is looked at, and nothing changes it.
class RunAnswerer final : public http::Answerer {
 public:
  explicit RunAnswerer(std::string run) : run_(std::move(run)) {}

  void ask(const http::ApiRequest& request, const std::atomic<bool>& /*stop*/,
           Answered answered) override {
    if (request.method != "GET") {
      answered(http::api_error(405, "a run that is over can't be changed"));
    } else if (request.target == "/api/run") {
      answered(http::ApiResponse{200, run_});
    } else if (request.target == "/api/status") {
      answered(http::ApiResponse{200, R"({"mode":"recorded"})"});
    } else {
      answered(http::api_error(404, "of a run that is over there is /api/run and /api/status"));
    }
  }

 private:
  std::string run_;
};

int view(const ViewArguments& arguments) {
  const RunFiles run = read_run_files(arguments.folder);
  RunAnswerer answerer(http::run_json(run, arguments.folder));
  const http::HttpServer server(answerer, nullptr, {arguments.listen, arguments.port, ""});
  fmt::print("http: {}\n", server.url());
  std::fflush(stdout);
  catch_interrupts();
  while (!interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  return kExitOk;
}

}  // namespace

void add_view_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<ViewArguments>();
  CLI::App* command =
      app.add_subcommand("view", "Look at a run in the browser, with a slider over its time");
  command->add_option("DIR", arguments->folder, "Folder of a run")->required();
  command->add_option("--http", arguments->port, "Port of the page; 0 for any (default 8080)")
      ->check(CLI::Range(std::uint16_t{0}, std::uint16_t{65535}));
  command->add_option("--listen", arguments->listen,
                      "IP address to be reached at (default 127.0.0.1, by this machine alone)");
  command->footer(
      "report.html in a run's folder shows the same without a server.\n"
      "What is happening now is shown by 'tagfield serve'.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return view(*arguments); }; });
}

}  // namespace tagfield
