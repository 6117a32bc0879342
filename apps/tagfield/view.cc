// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <thread>

#include "adapters/bags/bag_recording.h"
#include "adapters/http/http_server.h"
#include "adapters/http/run_json.h"
#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/json_line.h"
#include "apps/tagfield/json_option.h"
#include "apps/tagfield/progress_bar.h"
#include "apps/tagfield/scenario_arguments.h"
#include "tagfield/files/staged_folder.h"

namespace tagfield {
namespace {

struct ViewArguments {
  std::string run;  ///< A folder, or a ROS recording.
  std::string scenario;
  std::uint16_t port = 8080;
  std::string listen = "127.0.0.1";
  bool as_json = false;
};

/// Answers for a finished run, which can only be viewed.
class RunAnswerer final : public http::Answerer {
 public:
  explicit RunAnswerer(std::string run) : run_(std::move(run)) {}

  void ask(const http::ApiRequest& request, const std::atomic<bool>& /*stop*/,
           Answered answered) override {
    if (request.method != "GET") {
      answered(http::api_error(405, "a finished run can't be changed"));
    } else if (request.target == "/api/run") {
      answered(http::ApiResponse{200, run_});
    } else if (request.target == "/api/status") {
      answered(http::ApiResponse{200, R"({"mode":"recorded"})"});
    } else {
      answered(http::api_error(404, "a finished run offers only /api/run and /api/status"));
    }
  }

 private:
  std::string run_;
};

/// JSON of a run's folder, with the folder's own scene.
std::string run_in_folder(const ViewArguments& arguments) {
  if (!arguments.scenario.empty()) {
    throw Error("--scenario can only be used with a recording: a run's folder has its world");
  }
  finish_commit(arguments.run);
  return http::run_json(read_run_files(arguments.run), http::read_surroundings(arguments.run));
}

std::string run_in_recording(const ViewArguments& arguments, Diagnostics& diagnostics) {
  ProgressBar bar("reading");
  BagOptions options;
  options.on_progress = [&bar](double share) { bar.show(share); };
  BagRecording bag = read_bag(arguments.run, options, diagnostics);
  http::Surroundings around;
  if (!arguments.scenario.empty()) {
    ScenarioArguments of_scenario;
    of_scenario.scenario = arguments.scenario;
    around.scene = http::scene_json(load(of_scenario, diagnostics));
  }
  around.robot_poses = bag.truth.robot_poses;
  if (bag.truth.tag_positions.empty()) {
    diagnostics.warn({arguments.run, 0},
                     "has no positions of tags, so no tag is drawn: 'tagfield localize' estimates "
                     "them, and 'tagfield view' shows its folder");
  }
  const std::string name = std::filesystem::path(arguments.run).filename().string();
  const RunFiles run = recorded_run(name, std::move(bag.reads), bag.believed.poses, bag.truth);
  return http::run_json(run, around);
}

int view(const ViewArguments& arguments) {
  Diagnostics diagnostics;
  const bool is_recording = is_bag(arguments.run);
  RunAnswerer answerer(is_recording ? run_in_recording(arguments, diagnostics)
                                    : run_in_folder(arguments));
  print_warnings(diagnostics);
  catch_interrupts();  // Before the server announces its address.
  const http::HttpServer server(answerer, nullptr, {arguments.listen, arguments.port, ""});
  if (arguments.as_json) {
    print_json_line({{"http", server.url()}});
  } else {
    fmt::print("http: {}\n", server.url());
  }
  flush_output();
  while (!interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  return kExitOk;
}

}  // namespace

void add_view_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<ViewArguments>();
  CLI::App* command =
      app.add_subcommand("view", "Look at a run in the browser, with a slider over its time");
  command
      ->add_option("RUN", arguments->run,
                   "Folder of a run, or a recording of ROS (.mcap, .db3, .bag, a folder of them)")
      ->required();
  command->add_option(
      "--scenario", arguments->scenario,
      "Scenario that a recording was made from: its world and its antennas' beams are drawn");
  command->add_option("--http", arguments->port, "Port of the page; 0 for any (default 8080)")
      ->check(CLI::Range(std::uint16_t{0}, std::uint16_t{65535}));
  add_json_option(*command, arguments->as_json, "a line {\"http\": URL}");
  command->add_option("--listen", arguments->listen,
                      "IP address to be reached at (default 127.0.0.1, by this machine alone)");
  command->footer(
      "report.html in a run's folder shows the same without a server. A recording shows more with\n"
      "the scenario that it was made from:\n"
      "  tagfield run SCENARIO.yaml --mcap run.mcap\n"
      "  tagfield view run.mcap --scenario SCENARIO.yaml\n"
      "What is happening now is shown by 'tagfield serve'.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return view(*arguments); }; });
}

}  // namespace tagfield
