// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "adapters/bags/bag_recording.h"
#include "adapters/http/run_json.h"
#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/json_line.h"
#include "apps/tagfield/json_option.h"
#include "apps/tagfield/localize.h"
#include "tagfield/report/page.h"

namespace tagfield {
namespace {

int report(const LocalizeArguments& arguments) {
  if (is_bag(arguments.recording)) return localize(arguments);
  if (!arguments.out.empty()) throw Error("report: --out can only be used with a bag");
  write_report(arguments.recording, http::view_of(arguments.recording));
  const std::string page = arguments.recording + "/report.html";
  if (arguments.as_json) {
    print_json_line({{"page", page}});
  } else {
    fmt::print("page: {}\n", page);
  }
  return kExitOk;
}

}  // namespace

void add_report_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<LocalizeArguments>();
  CLI::App* command = app.add_subcommand(
      "report", "Draw report.html and figures/ again from a run's folder, or from a rosbag");
  command
      ->add_option("DIR", arguments->recording,
                   "Folder of a run, or a rosbag (RUN.bag), then as 'localize' without options")
      ->required();
  command->add_option("--out", arguments->out,
                      "Folder for the results of a bag (default runs/NAME)");
  add_json_option(*command, arguments->as_json, "{\"page\": FILE}; of a bag, summary.json");
  command->callback([arguments, &chosen] { chosen = [arguments] { return report(*arguments); }; });
}

}  // namespace tagfield
