// SPDX-License-Identifier: Apache-2.0
#include "tagfield/planning/coverage.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tagfield/base/parallel.h"
#include "tagfield/field/antenna_facts.h"
#include "tagfield/planning/internal/antenna_place.h"
#include "tagfield/planning/internal/tag_coverage.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {
namespace {

/// Fraction of the progress bar for the grid; the rest is for the tags.
constexpr double kGridShare = 0.9;

/// The poses in an order that soon has one near every cell, so that the far ones can be skipped:
/// each pass halves the gaps.
std::vector<std::size_t> halving_order(const std::vector<std::size_t>& places) {
  std::vector<std::size_t> order;
  std::vector<char> taken(places.size(), 0);
  for (std::size_t step = std::size_t{1} << 20U; step > 0; step /= 2) {
    for (std::size_t i = 0; i < places.size(); i += step) {
      if (taken[i] == 0) order.push_back(places[i]);
      taken[i] = 1;
    }
  }
  return order;
}

class GridRun {
 public:
  GridRun(const Scenario& scenario, const std::vector<DriveSample>& samples,
          const CoverageRequest& request, Coverage& coverage)
      : scenario_(scenario),
        samples_(samples),
        request_(request),
        coverage_(coverage),
        world_(radio_world_of(scenario)) {}

  void run() {
    std::size_t all = 0;
    std::size_t done = 0;
    for (const std::size_t antenna : request_.antennas) all += places_of(samples_, antenna).size();
    for (std::size_t i = 0; i < request_.antennas.size(); ++i) {
      const std::size_t antenna = request_.antennas[i];
      for (const std::size_t sample : halving_order(places_of(samples_, antenna))) {
        add(antenna, static_cast<int>(i), samples_[sample]);
        throw_if_stopped(request_);
        ++done;
        if (request_.on_progress) {
          request_.on_progress(kGridShare * static_cast<double>(done) / static_cast<double>(all));
        }
      }
    }
  }

 private:
  void add(std::size_t antenna, int number, const DriveSample& sample) {
    const AntennaAtPose place(scenario_, scenario_.antennas[antenna], *world_, sample.X_WA[antenna],
                              request_.bodies, request_.seed);
    const std::size_t rows = coverage_.grid.rows;
    parallel_for(rows * coverage_.layers.size(), request_.threads, [&](std::size_t i) {
      add_row(place, number, coverage_.layers[i / rows], i % rows, i);
    });
  }

  void add_row(const AntennaAtPose& place, int number, CoverageLayer& layer, std::size_t row,
               std::size_t key) const {
    thread_local std::vector<RadioPath> paths;
    const CoverageGrid& grid = coverage_.grid;
    if (request_.stop != nullptr && *request_.stop) return;
    for (std::size_t column = 0; column < grid.columns; ++column) {
      CoverageCell& cell = layer.cells[row * grid.columns + column];
      const Eigen::Vector2d middle = grid.middle(column, row);
      const Eigen::Vector3d p_WT(middle.x(), middle.y(), layer.height_m);
      // No result for this pose could change the cell.
      if (cell.probability >= 1.0 && cell.margin_db >= place.max_margin_db(*request_.tag, p_WT)) {
        continue;
      }
      const TagEnd tag{*request_.tag, from_translation(p_WT), key * grid.columns + column};
      merge(place.look(tag, request_.orientations, paths), number, cell);
    }
  }

  const Scenario& scenario_;
  const std::vector<DriveSample>& samples_;
  const CoverageRequest& request_;
  Coverage& coverage_;
  std::shared_ptr<const RadioWorld> world_;
};

CoverageAntenna antenna_of(const Scenario& scenario, const std::vector<DriveSample>& samples,
                           std::size_t index) {
  const AntennaParameters& parameters = scenario.antennas[index].parameters;
  CoverageAntenna antenna;
  antenna.name = parameters.name;
  antenna.by_paper = !meets_world(parameters);
  for (const std::size_t i : places_of(samples, index)) {
    antenna.places_W.push_back(samples[i].X_WA[index].translation);
  }
  return antenna;
}

}  // namespace

void throw_if_stopped(const CoverageRequest& request) {
  if (request.stop != nullptr && *request.stop) throw Error("coverage: interrupted");
}

void warn_of_effects_left_out(const Scenario& scenario, Diagnostics& diagnostics) {
  std::set<std::string> readers;
  bool interferes = false;
  bool couples = false;
  bool captures = false;
  for (const AntennaSpec& antenna : scenario.antennas) {
    const RadioModel* const model = physical(antenna.parameters);
    if (model == nullptr) continue;
    readers.insert(antenna.parameters.reader);
    interferes = interferes || is_disturbed(*model);
    couples = couples || couples_tags(*model);
    captures = captures || (takes_inventory(*model) && model->gen2->inventory.capture_db);
  }
  std::vector<std::string> left_out;
  if (interferes && readers.size() > 1) left_out.emplace_back("interference of other readers");
  if (couples && scenario.tags.size() > 1) left_out.emplace_back("coupling of tags");
  if (captures) left_out.emplace_back("capture of colliding replies (capture_db)");
  if (left_out.empty()) return;
  diagnostics.warn(fmt::format("left out of coverage and forecast, unlike in a run: {}",
                               fmt::join(left_out, ", ")));
}

Coverage cover(const Scenario& scenario, const std::vector<DriveSample>& samples,
               const CoverageRequest& request) {
  Coverage coverage;
  coverage.scenario = scenario.name;
  coverage.description = scenario.description;
  coverage.tag_kind = request.tag->name;
  coverage.grid = request.grid;
  for (const std::size_t index : request.antennas) {
    coverage.antennas.push_back(antenna_of(scenario, samples, index));
  }
  for (const double height_m : request.heights_m) {
    coverage.layers.push_back({height_m, std::vector<CoverageCell>(request.grid.size())});
  }
  GridRun(scenario, samples, request, coverage).run();
  cover_tags(scenario, samples, request, coverage, [&](double share) {
    if (request.on_progress) request.on_progress(kGridShare + (1.0 - kGridShare) * share);
  });
  return coverage;
}

CoverageGrid grid_over(const Eigen::AlignedBox2d& region, double step_m, std::size_t max_cells) {
  // Rounding must not add a cell to a region that is an integer number of steps wide.
  const Eigen::Vector2d counts = (region.sizes().array() / step_m - 1e-9).ceil().max(1.0);
  if (!(counts.x() * counts.y() <= static_cast<double>(max_cells))) {
    throw Error(
        fmt::format("a grid of {:g} by {:g} cells is more than {}: expected a greater "
                    "step or a smaller region",
                    counts.x(), counts.y(), max_cells));
  }
  CoverageGrid grid;
  grid.step_m = step_m;
  grid.columns = static_cast<std::size_t>(counts.x());
  grid.rows = static_cast<std::size_t>(counts.y());
  grid.corner_m = region.center() - 0.5 * step_m * counts;
  return grid;
}

double links_of(const std::vector<DriveSample>& samples, const CoverageRequest& request) {
  double places = 0.0;
  for (const std::size_t antenna : request.antennas) {
    places += static_cast<double>(places_of(samples, antenna).size());
  }
  return places * static_cast<double>(request.grid.size() * request.heights_m.size());
}

}  // namespace tagfield
