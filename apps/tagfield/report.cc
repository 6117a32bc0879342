#include <fmt/format.h>

#include <memory>

#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "tagfield/report/page.h"

namespace tagfield {

void add_report_command(CLI::App& app, Action& chosen) {
  const auto folder = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("report", "Draw report.html and figures/ again from a run's folder");
  command->add_option("DIR", *folder, "Folder of a run")->required();
  command->callback([folder, &chosen] {
    chosen = [folder] {
      write_report(*folder);
      fmt::print("page: {}/report.html\n", *folder);
      return kExitOk;
    };
  });
}

}  // namespace tagfield
