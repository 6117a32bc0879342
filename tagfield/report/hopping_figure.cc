// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "tagfield/base/units.h"
#include "tagfield/localization/holograms/wave_sums.h"
#include "tagfield/localization/pi_ambiguity.h"
#include "tagfield/report/figures.h"
#include "tagfield/report/internal/color_bands.h"
#include "tagfield/report/internal/figure_data.h"
#include "tagfield/report/internal/map_outline.h"
#include "tagfield/report/internal/map_view.h"

namespace tagfield {
namespace {

constexpr int kHologramCells = 64;  ///< Per side.
constexpr double kHologramCell_m = 0.02;
constexpr double kHologramTop = 46.0;  ///< Of the drawing, below the colour bar.

/// The antenna and the tag whose reads are shown.
struct Shown {
  const AntennaTrack* track = nullptr;
  std::string tag;
};

Shown shown_in(const RunFiles& run) {
  for (const bool moving : {true, false}) {
    const AntennaTrack* track = busiest_track(run, moving);
    const std::string tag = track == nullptr ? "" : busiest_tag(*track);
    if (!tag.empty()) return {track, tag};
  }
  return {};
}

std::size_t count_carriers(const Shown& shown) {
  std::set<long long> carriers_hz;
  for (const TagRead* read : reads_of(*shown.track, shown.tag)) {
    carriers_hz.insert(std::llround(read->frequency_hz));
  }
  return carriers_hz.size();
}

/// Reads of the antenna joined with its believed poses.
struct HoppingReads {
  std::vector<PhaseSample> samples;  ///< Of the tag.
  bool pi_ambiguity =
      false;  ///< If the phases have a π ambiguity, phases and carriers are doubled.
};

HoppingReads hopping_reads(const Shown& shown) {
  SamplesByTag samples = believed_samples(*shown.track, shown.track->reads);
  HoppingReads joined;
  joined.pi_ambiguity = has_pi_ambiguity(samples);
  if (joined.pi_ambiguity) double_phases(samples);
  const auto of_tag = samples.find(shown.tag);
  if (of_tag == samples.end() || of_tag->second.empty()) return joined;
  const std::vector<PhaseSample>& all = of_tag->second.begin()->second;
  const std::size_t step = thinning(all.size(), kMaxMarks);
  for (std::size_t i = 0; i < all.size(); i += step) joined.samples.push_back(all[i]);
  return joined;
}

/// Reads relative to `middle_W` in the search plane; one group per carrier, since phase offsets
/// differ between carriers.
std::vector<std::vector<SearchRead>> by_carrier(const std::vector<PhaseSample>& samples,
                                                const Eigen::Vector3d& middle_W) {
  std::map<long long, std::vector<SearchRead>> carriers;
  for (const PhaseSample& sample : samples) {
    const Eigen::Vector3f p = (sample.p_WA - middle_W).cast<float>();
    SearchRead read;
    read.x = p.x();
    read.y = p.y();
    read.z = p.z();
    read.height_squared = p.z() * p.z();
    const double turns = sample.phase_rad / (2.0 * std::numbers::pi);
    read.turns = static_cast<float>(turns - std::round(turns));
    read.turns_per_metre = static_cast<float>(2.0 * sample.frequency_hz / kSpeedOfLight);
    carriers[std::llround(sample.frequency_hz)].push_back(read);
  }
  std::vector<std::vector<SearchRead>> groups;
  groups.reserve(carriers.size());
  for (auto& [carrier, reads] : carriers) groups.push_back(std::move(reads));
  return groups;
}

/// Σ over the carriers of |Σ e^(j(φ − 4πr/λ))|, over the number of reads, at each cell.
std::vector<double> hologram_at(const std::vector<PhaseSample>& samples,
                                const Eigen::Vector3d& middle_W) {
  const std::vector<std::vector<SearchRead>> groups = by_carrier(samples, middle_W);
  std::vector<Eigen::Vector3d> cells;
  for (int row = 0; row < kHologramCells; ++row) {
    for (int column = 0; column < kHologramCells; ++column) {
      cells.emplace_back(kHologramCell_m * (column + 0.5 - 0.5 * kHologramCells),
                         kHologramCell_m * (row + 0.5 - 0.5 * kHologramCells), 0.0);
    }
  }
  return by_tiles(cells, [&](const Tile& x, const Tile& y, const Tile&) {
    Tile sum = Tile::Zero();
    for (const std::vector<SearchRead>& group : groups) {
      const WaveSums waves = wave_sums(group.data(), group.size(), x, y);
      const Tile power = waves.in_phase.square() + waves.quadrature.square();
      // Eigen's square root in single precision is not the same on all processors.
      for (int k = 0; k < kTile; ++k) sum[k] += std::sqrt(power[k]);
    }
    return Tile(sum / static_cast<float>(samples.size()));
  });
}

MapView hologram_map(const std::string& name, const Eigen::Vector3d& middle_W) {
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * kHologramCell_m * kHologramCells);
  MapView map;
  map.id = name;
  map.axes.x = tight_scale(middle_W.x() - half.x(), middle_W.x() + half.x(), 6);
  map.axes.y = tight_scale(middle_W.y() - half.y(), middle_W.y() + half.y(), 6);
  map.axes.x.from = 64.0;
  map.axes.x.to = 464.0;
  map.axes.y.to = kHologramTop + 30.0;
  map.axes.y.from = map.axes.y.to + 400.0;
  map.scale = 400.0 / (2.0 * half.x());
  return map;
}

void draw_hologram_cells(Svg& svg, const MapView& map, const std::vector<double>& values,
                         const ColorBands& bands) {
  OccupancyGrid grid;
  grid.resolution_m = kHologramCell_m;
  grid.width = kHologramCells;
  grid.height = kHologramCells;
  for (const double value : values) {
    grid.cells.push_back(static_cast<std::int8_t>(band_of(bands, value)));
  }
  const double size = map.scale * kHologramCell_m;
  begin_group(svg, fmt::format("shape-rendering=\"crispEdges\" "
                               "transform=\"matrix({:.5f} 0 0 {:.5f} {:.3f} {:.3f})\"",
                               size, -size, map.axes.x.from, map.axes.y.from));
  for (std::size_t i = 0; i < bands.colors.size(); ++i) {
    const std::string data =
        cell_outline(grid, [&](std::int8_t cell) { return cell == static_cast<int>(i); });
    if (!data.empty()) add_path(svg, data, band_look(bands.colors[i], words_of_band(bands, i)));
  }
  end_group(svg);
}

const TagOutcome* outcome_of_tag(const RunFiles& run, const std::string& tag) {
  for (const TagOutcome& outcome : run.summary.tags) {
    if (outcome.estimate.tag == tag) return &outcome;
  }
  return nullptr;
}

void draw_places(Svg& svg, const MapView& map, const TagOutcome& outcome) {
  const auto within = [&](const Place& place) {
    return place.x() > map.axes.x.from && place.x() < map.axes.x.to && place.y() > map.axes.y.to &&
           place.y() < map.axes.y.from;
  };
  if (outcome.truth_m && within(on_map(map, *outcome.truth_m))) {
    add_circle(svg, on_map(map, *outcome.truth_m), 11.0, styled("true-line"),
               clean_text(outcome.estimate.tag) + ", true position");
  }
  if (outcome.estimate.verdict != Verdict::kLocated || outcome.estimate.candidates.empty()) return;
  const Place place = on_map(map, outcome.estimate.candidates.front().p_WT);
  if (!within(place)) return;
  add_cross(svg, place, 6.5, styled("halo"));
  add_cross(svg, place, 6.0, styled("estimate"), clean_text(outcome.estimate.tag) + ", estimate");
}

std::string carriers_words(const Shown& shown) {
  return fmt::format("{} reads {} on {} carriers, between which the phase can’t be followed",
                     shortened(shown.track->antenna, 32), shortened(shown.tag, 32),
                     count_carriers(shown));
}

Figure hologram_figure(const Shown& shown, const HoppingReads& reads, const TagOutcome& outcome) {
  const Eigen::Vector3d middle = *known_place(outcome);
  Figure figure{"hologram", "", "Hologram of " + shortened(shown.tag, 24), "", {}, ""};
  const MapView map = hologram_map(figure.name, middle);
  const std::vector<double> values = hologram_at(reads.samples, middle);
  const ColorBands bands = agreement_bands(*std::max_element(values.begin(), values.end()));
  figure.svg.height = map.axes.y.from + 48.0;
  draw_band_bar(figure.svg, 2.0, bands);
  draw_axes(figure.svg, map.axes, "x [m]", "y [m]");
  draw_hologram_cells(figure.svg, map, values, bands);
  draw_places(figure.svg, map, outcome);
  figure.caption = fmt::format(
      "{}, so in place of Fig. 12: how well the phases of {} reads agree with each position at the "
      "tag’s height, each carrier with its own offset. 1 is full agreement, random phases give "
      "{:.1f}.",
      carriers_words(shown), grouped(reads.samples.size()),
      std::min(1.0, std::sqrt(std::numbers::pi / 4.0 * static_cast<double>(count_carriers(shown)) /
                              static_cast<double>(reads.samples.size()))));
  if (outcome.truth_m) figure.caption += " The circle is the true position.";
  if (outcome.estimate.verdict == Verdict::kLocated) {
    figure.caption += " The cross is the estimate.";
  }
  if (reads.pi_ambiguity) {
    figure.caption += " Phases are ambiguous by π, so fringes are twice as dense.";
  }
  figure.data = "x_m,y_m,agreement\n";
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto at = [&](std::size_t cell) {
      return kHologramCell_m * (static_cast<double>(cell) + 0.5 - 0.5 * kHologramCells);
    };
    add_data(figure.data, middle.x() + at(i % kHologramCells), middle.y() + at(i / kHologramCells),
             std::round(1e3 * values[i]) / 1e3);
  }
  return figure;
}

Figure carriers_figure(const Shown& shown) {
  Figure figure{
      "phase_by_carrier", "", "Phase by carrier, " + shortened(shown.tag, 24), "", {}, ""};
  const std::vector<const TagRead*> reads = reads_of(*shown.track, shown.tag);
  const auto [low, high] = std::minmax_element(
      reads.begin(), reads.end(),
      [](const TagRead* a, const TagRead* b) { return a->frequency_hz < b->frequency_hz; });
  Axes axes{round_scale(1e-6 * (*low)->frequency_hz, 1e-6 * (*high)->frequency_hz, 6),
            tight_scale(0.0, 2.0 * std::numbers::pi, 6)};
  axes.x.from = 58.0;
  axes.x.to = kDrawingWidth - 24.0;
  axes.y.to = 34.0;
  axes.y.from = 310.0;
  figure.svg.height = 358.0;
  draw_axes(figure.svg, axes, "carrier [MHz]", "phase [rad]");
  figure.data = "time_s,frequency_hz,phase_rad\n";
  const std::size_t step = thinning(reads.size(), kMaxMarks);
  for (std::size_t i = 0; i < reads.size(); i += step) {
    const double phase = wrap_to_two_pi(reads[i]->phase_rad);
    add_circle(figure.svg, place_in(axes, 1e-6 * reads[i]->frequency_hz, phase), 2.4,
               styled("measured"));
    add_data(figure.data, format_stamp(reads[i]->stamp),
             fmt::format("{:.0f}", reads[i]->frequency_hz), phase);
  }
  figure.caption = fmt::format(
      "{}, so in place of Fig. 12: every phase by its carrier. The phase of a tag at rest before "
      "an antenna at rest lies on a line that falls or rises with its distance, but for noise, "
      "reflections and the reader’s offsets.",
      carriers_words(shown));
  if (step > 1) figure.caption += fmt::format(" One read in {} is drawn.", step);
  return figure;
}

}  // namespace

bool hops(const RunFiles& run) {
  const Shown shown = shown_in(run);
  return shown.track != nullptr && count_carriers(shown) > 1;
}

Figure hopping_figure(const RunFiles& run) {
  const Shown shown = shown_in(run);
  const TagOutcome* outcome = outcome_of_tag(run, shown.tag);
  if (!shown.track->moving || outcome == nullptr || outcome->moved || !known_place(*outcome)) {
    return carriers_figure(shown);
  }
  const HoppingReads reads = hopping_reads(shown);
  return reads.samples.empty() ? carriers_figure(shown) : hologram_figure(shown, reads, *outcome);
}

}  // namespace tagfield
