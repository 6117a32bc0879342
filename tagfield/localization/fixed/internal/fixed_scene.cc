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

double furthest(const std::vector<FixedReads>& reads, const Eigen::Vector3d& place) {
  double most = 0.0;
  for (const FixedReads& of : reads) most = std::max(most, (of.p_WA - place).norm());
  return most;
}

/// Area in which a tag may be: the given one, or the bounding box of the antennas that read it plus
/// their range.
Eigen::AlignedBox2d area_of(const LocalizationProblem& problem,
                            const std::vector<FixedReads>& reads, double max_range_m) {
  if (problem.area.box) return *problem.area.box;
  Eigen::AlignedBox2d box;
  for (const FixedReads& of : reads) box.extend(Eigen::Vector2d(of.p_WA.head<2>()));
  const Eigen::Vector2d margin(max_range_m, max_range_m);
  return {box.min() - margin, box.max() + margin};
}

double spread_of(const std::vector<Eigen::Vector3d>& cells) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& cell : cells) mean += cell;
  mean /= static_cast<double>(cells.size());
  double squares = 0.0;
  for (const Eigen::Vector3d& cell : cells) squares += (cell - mean).squaredNorm();
  return std::sqrt(squares / static_cast<double>(cells.size()));
}

PathLine line_of(const std::vector<FixedReads>& reads) {
  std::vector<Eigen::Vector2d> places;
  places.reserve(reads.size());
  for (const FixedReads& of : reads) places.emplace_back(of.p_WA.head<2>());
  return path_line(places);
}

std::vector<Eigen::Vector3d> cells_of(const LocalizationProblem& problem, const FixedTag& tag,
                                      const FixedOptions& options, double& cell_m) {
  const Eigen::AlignedBox2d area = area_of(problem, tag.reads, options.max_range_m);
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

std::size_t with_strength(const std::vector<FixedReads>& reads) {
  return static_cast<std::size_t>(std::count_if(
      reads.begin(), reads.end(), [](const FixedReads& of) { return of.strengths > 0.0; }));
}

FixedTag fixed_tag(const LocalizationProblem& problem, const std::vector<std::string>& antennas,
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
  std::vector<Eigen::Vector3d> cells = cells_of(problem, tag, options, tag.cell_m);
  if (cells.empty()) {
    tag.why_not = "no position is within range of all antennas that read it";
    return tag;
  }
  tag.spread_m = spread_of(cells);
  tag.grid = on_grid(antennas, tag.reads, std::move(cells), options);
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
void put_at_reference(const LocalizationProblem& problem, const std::vector<std::string>& antennas,
                      const FixedOptions& options, FixedTag& tag) {
  const auto known = problem.reference_tags.find(*tag.name);
  if (known == problem.reference_tags.end() || !tag.why_not.empty()) return;
  tag.grid = on_grid(antennas, tag.reads, {known->second}, options);
}

}  // namespace

FixedScene fixed_scene(const LocalizationProblem& problem, int threads,
                       const FixedOptions& options) {
  FixedScene scene;
  scene.antennas = antennas_of(problem);
  for (const auto& [name, samples] : problem.samples) {
    scene.tags.push_back(fixed_tag(problem, scene.antennas, name, samples, options));
    put_at_reference(problem, scene.antennas, options, scene.tags.back());
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
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    scene.law.of_tag[numbers[i]] = learned.of_tag[i];
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
