// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/page.h"

#include <fmt/format.h>

#include "tagfield/base/error.h"
#include "tagfield/base/file_kind.h"
#include "tagfield/files/staged_folder.h"
#include "tagfield/report/figures.h"
#include "tagfield/report/internal/inventory_section.h"
#include "tagfield/report/internal/tables.h"
#include "tagfield/report/page_script.h"
#include "tagfield/report/page_text.h"
#include "tagfield/report/passings_figure.h"
#include "tagfield/report/run_files.h"
#include "tagfield/report/style_sheet.h"
#include "tagfield/report/text.h"

namespace tagfield {
namespace {

/// Content security policy: only the page's own style, the scripts with these hashes, and the
/// images that they make are allowed.
std::string policy(const std::vector<std::string>& script_hashes) {
  std::string sources;
  for (const std::string& hash : script_hashes) {
    if (!hash.empty()) sources += (sources.empty() ? "'" : " '") + hash + "'";
  }
  const std::string script =
      sources.empty() ? "" : "script-src " + sources + "; img-src data: blob:; ";
  return "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; " + script +
         "style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'\">\n";
}

std::string figures_html(const std::vector<Figure>& figures) {
  std::string drawn;
  std::string missing;
  for (const Figure& figure : figures) {
    (figure.missing.empty() ? drawn : missing) += figure_html(figure);
  }
  return "<div class=\"figures\">\n" + drawn + "</div>\n" + missing;
}

/// A note if not all reads fit in memory.
std::string left_out_note(const RunFiles& run) {
  if (run.reads.size() == run.reads_in_table) return "";
  return fmt::format(
      "<p class=\"muted\">Figures and the run over time show {} of {} reads: all of the tag that "
      "an "
      "antenna reads most often, as far as they fit in memory, and a share of the others.</p>\n",
      grouped(run.reads.size()), grouped(run.reads_in_table));
}

std::string view_section(const std::optional<RunView>& view) {
  if (!view) return "";
  return "<section class=\"screen\">\n<h2>The run over time</h2>\n" + view->html + "</section>\n";
}

/// The result comes first, with the run over time; then figures, and then all tables.
std::string page_of(const RunFiles& run, const std::vector<Figure>& figures,
                    const std::optional<RunView>& view) {
  const Summary& summary = run.summary;
  const bool is_inventory = is_inventory_alone(summary);
  return page_head(summary.scenario + " – Tagfield report",
                   {view ? view->script_hash : "", table_script().hash, figure_script().hash,
                    link_script().hash}) +
         "<body>\n" + page_header(summary, run.tracked) + "<main>\n" +
         (is_inventory ? inventory_numbers(*summary.inventory) : key_numbers(summary)) +
         run_facts(summary) + view_section(view) + "<h2>Figures</h2>\n" + left_out_note(run) +
         figures_html(figures) + inventory_tables(summary) + methods_table(summary) +
         navigation_table(summary) + effects_table(summary) +
         (run.tracked ? passings_table(run.tracked->orders) : "") +
         (is_inventory ? "" : "<h2>Tags</h2>\n" + tag_table(summary)) + "</main>\n" +
         page_footer() + script_html(table_script()) + script_html(figure_script()) +
         script_html(link_script()) + "</body>\n</html>\n";
}

/// Throws Error if there is no folder, so that none is created.
void require_run_folder(const std::string& folder) {
  if (!is_folder(folder)) fail({folder, 0}, "no such folder");
}

}  // namespace

std::string page_head(const std::string& title, const std::vector<std::string>& script_hashes) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n" +
         policy(script_hashes) +
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta name=\"color-scheme\" content=\"light dark\">\n<title>" +
         escaped(title) + "</title>\n<style>\n" + page_style() + "</style>\n</head>\n";
}

void stage_report(const std::string& run_folder, const MakeView& make_view, StagedFolder& folder) {
  const RunFiles run = read_run_files(run_folder);
  const std::optional<RunView> view = make_view ? make_view(run) : std::nullopt;
  const std::vector<Figure> figures = all_figures(run);
  for (const Figure& figure : figures) {
    if (!figure.missing.empty()) continue;
    folder.add("figures/" + figure.name + ".svg",
               standalone_svg(figure.svg, figure.title, figure.caption));
  }
  folder.add("report.html", page_of(run, figures, view));
}

void write_report(const std::string& run_folder, const MakeView& make_view) {
  require_run_folder(run_folder);
  StagedFolder folder(run_folder);
  stage_report(run_folder, make_view, folder);
  folder.commit({"figures"});
}

}  // namespace tagfield
