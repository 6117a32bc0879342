// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/fixed/internal/fixed_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "tagfield/localization/fixed/internal/phase_field.h"
#include "tagfield/localization/fixed/internal/swapped_antennas.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

constexpr std::size_t kFewestAntennas = 3;
constexpr double kCoarseCells = 1200;  ///< Approximate number over the area.
constexpr int kAreas = 5;  ///< The smallest ends a sixteenth of the range from the antennas.

double furthest(const std::vector<FixedReads>& reads, const Eigen::Vector3d& place) {
  double most = 0.0;
  for (const FixedReads& of : reads) most = std::max(most, (of.p_WA - place).norm());
  return most;
}

/// What is near all antennas, up to their range from the bounding box of them, up to half of it,
/// and so on, as far as tags can be there.
std::vector<Eigen::AlignedBox2d> nested_areas(const LocalizationProblem& problem,
                                              double max_range_m) {
  Eigen::AlignedBox2d box;
  for (const auto& [tag, samples] : problem.samples) {
    for (const FixedReads& of : fixed_reads(problem, samples)) {
      box.extend(Eigen::Vector2d(of.p_WA.head<2>()));
    }
  }
  std::vector<Eigen::AlignedBox2d> areas;
  if (box.isEmpty()) return areas;
  for (int i = 0; i < kAreas; ++i) {
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(std::ldexp(max_range_m, -i));
    areas.emplace_back(box.min() - margin, box.max() + margin);
  }
  if (!problem.area.box) return areas;
  areas.front() = *problem.area.box;
  for (Eigen::AlignedBox2d& area : areas) area = area.intersection(*problem.area.box);
  return areas;
}

/// Area of the cells in each of the nested areas. One without a cell counts as the one around it.
Eigen::ArrayXd areas_of(const std::vector<Eigen::AlignedBox2d>& areas,
                        const std::vector<Eigen::Vector3d>& cells, double cell_m) {
  Eigen::ArrayXd sizes = Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(areas.size()));
  for (std::size_t k = 0; k < areas.size(); ++k) {
    const auto inside = std::count_if(cells.begin(), cells.end(), [&](const auto& cell) {
      return areas[k].contains(Eigen::Vector2d(cell.template head<2>()));
    });
    sizes[static_cast<Eigen::Index>(k)] = static_cast<double>(inside) * cell_m * cell_m;
  }
  return sizes;
}

double spread_of(const PossiblePlaces& places, const Eigen::ArrayXd& areas) {
  const Eigen::ArrayXd weights = log_prior(places, areas).exp();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double squares = 0.0;
  for (std::size_t i = 0; i < places.cells.size(); ++i) {
    mean += weights[static_cast<Eigen::Index>(i)] * places.cells[i];
    squares += weights[static_cast<Eigen::Index>(i)] * places.cells[i].squaredNorm();
  }
  mean /= weights.sum();
  return std::sqrt(std::max(squares / weights.sum() - mean.squaredNorm(), 0.0));
}

PathLine line_of(const std::vector<FixedReads>& reads) {
  std::vector<Eigen::Vector2d> places;
  places.reserve(reads.size());
  for (const FixedReads& of : reads) places.emplace_back(of.p_WA.head<2>());
  return path_line(places);
}

std::vector<Eigen::Vector3d> cells_of(const LocalizationProblem& problem,
                                      const Eigen::AlignedBox2d& area, const FixedTag& tag,
                                      const FixedOptions& options, double& cell_m) {
  const Eigen::Vector2d size = area.sizes();
  cell_m = std::sqrt(size.prod() / kCoarseCells);
  const double height = plane_height(problem, *tag.name);
  const PathLine line = line_of(tag.reads);
  std::vector<Eigen::Vector3d> cells;
  for (double x = area.min().x() + 0.5 * cell_m; x < area.max().x(); x += cell_m) {
    for (double y = area.min().y() + 0.5 * cell_m; y < area.max().y(); y += cell_m) {
      const Eigen::Vector3d place(x, y, height);
      const bool is_near = furthest(tag.reads, place) <= options.max_range_m;
      if (is_near && is_within(problem.area, line.middle, line.along, {x, y})) {
        cells.push_back(place);
      }
    }
  }
  return cells;
}

PossiblePlaces places_in(const std::vector<Eigen::AlignedBox2d>& areas,
                         const Eigen::ArrayXd& areas_m2, std::vector<Eigen::Vector3d> cells,
                         double cell_m) {
  PossiblePlaces places;
  places.density = densities_in(areas, areas_m2, cells);
  places.cells = std::move(cells);
  places.size_m = Eigen::ArrayXd::Constant(static_cast<Eigen::Index>(places.cells.size()), cell_m);
  return places;
}

std::size_t with_strength(const std::vector<FixedReads>& reads) {
  return static_cast<std::size_t>(std::count_if(
      reads.begin(), reads.end(), [](const FixedReads& of) { return of.strengths > 0.0; }));
}

FixedTag fixed_tag(const LocalizationProblem& problem, const FixedScene& scene,
                   const std::string& name, const SamplesOfTag& samples,
                   const FixedOptions& options) {
  FixedTag tag;
  tag.name = &name;
  tag.samples = &samples;
  tag.reads = fixed_reads(problem, samples);
  const std::size_t count = with_strength(tag.reads);
  if (count < kFewestAntennas) {
    tag.why_not = fmt::format(
        "RSSI by {} antenna{} at rest, at least {} are needed: more antennas, or one that moves, "
        "would locate the tag",
        count, count == 1 ? "" : "s", kFewestAntennas);
    return tag;
  }
  std::vector<Eigen::Vector3d> cells =
      cells_of(problem, scene.areas.front(), tag, options, tag.cell_m);
  if (cells.empty()) {
    tag.why_not = "no position is within range of all antennas that read it";
    return tag;
  }
  tag.areas_m2 = areas_of(scene.areas, cells, tag.cell_m);
  tag.grid = on_grid(scene.antennas, tag.reads,
                     places_in(scene.areas, tag.areas_m2, std::move(cells), tag.cell_m), options);
  return tag;
}

std::vector<std::string> antennas_of(const LocalizationProblem& problem) {
  std::set<std::string> names;
  for (const auto& [tag, samples] : problem.samples) {
    for (const auto& [antenna, series] : samples) names.insert(antenna);
  }
  return {names.begin(), names.end()};
}

/// The area of a reference tag is its known position alone.
void put_at_reference(const LocalizationProblem& problem, const FixedOptions& options,
                      FixedTag& tag) {
  const auto known = problem.reference_tags.find(*tag.name);
  if (known == problem.reference_tags.end() || !tag.why_not.empty()) return;
  put_on(known_place(known->second, tag.areas_m2.size()), options, tag.grid);
}

}  // namespace

Eigen::ArrayXXd densities_in(const std::vector<Eigen::AlignedBox2d>& areas,
                             const Eigen::ArrayXd& areas_m2,
                             const std::vector<Eigen::Vector3d>& places) {
  Eigen::ArrayXXd densities(static_cast<Eigen::Index>(places.size()), areas_m2.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    for (Eigen::Index k = 0; k < areas_m2.size(); ++k) {
      const Eigen::AlignedBox2d& area = areas[static_cast<std::size_t>(k)];
      const bool is_inside = k == 0 || area.contains(Eigen::Vector2d(places[i].head<2>()));
      densities(row, k) = is_inside ? 1.0 / areas_m2[k] : 0.0;
      if (areas_m2[k] == 0.0) densities(row, k) = densities(row, k - 1);
    }
  }
  return densities;
}

FixedScene fixed_scene(const LocalizationProblem& problem, int threads,
                       const FixedOptions& options) {
  FixedScene scene;
  scene.antennas = antennas_of(problem);
  scene.areas = nested_areas(problem, options.max_range_m);
  for (const auto& [name, samples] : problem.samples) {
    scene.tags.push_back(fixed_tag(problem, scene, name, samples, options));
    put_at_reference(problem, options, scene.tags.back());
  }
  std::vector<TagOnGrid> grids;
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < scene.tags.size(); ++i) {
    if (!scene.tags[i].why_not.empty()) continue;
    grids.push_back(scene.tags[i].grid);
    numbers.push_back(i);
  }
  LearnedLaw learned = learn_law(grids, scene.antennas.size(), options);
  scene.law = learned;
  scene.law.of_tag.assign(scene.tags.size(), learned.of_all);
  scene.law.areas_of_tag.resize(scene.tags.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    FixedTag& tag = scene.tags[numbers[i]];
    scene.law.of_tag[numbers[i]] = learned.of_tag[i];
    scene.law.areas_of_tag[numbers[i]] = learned.areas_of_tag[i];
    tag.spread_m = spread_of(tag.grid.places, learned.areas_of_tag[i]);
  }
  scene.swapped = swapped_antennas(scene, numbers, options, threads);
  std::vector<std::vector<FixedReads>> reads;
  for (const FixedTag& tag : scene.tags) reads.push_back(tag.reads);
  scene.out_of_order = problem.has_phases && is_out_of_order(reads);
  if (!scene.out_of_order) scene.offsets = channel_offsets(problem);
  if (scene.offsets.empty()) return scene;
  scene.field = likeliest_field(scene, problem, options, threads);
  scene.trust = trust_of(scene, problem, options, threads);
  return scene;
}

}  // namespace tagfield
