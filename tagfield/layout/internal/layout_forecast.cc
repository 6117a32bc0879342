// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/internal/layout_forecast.h"

#include <algorithm>
#include <map>

#include "tagfield/base/parallel.h"
#include "tagfield/layout/internal/link_reads.h"
#include "tagfield/planning/local_link.h"

namespace tagfield {
namespace {

/// The states reduced by `less_db`, to a quarter of a dB.
LinkStates weaker(const LinkStates& states, double less_db) {
  if (less_db == 0.0 || states.is_empty()) return states;
  std::vector<double> margins;
  for (std::size_t place = 0; place < kFadingPositions; ++place) {
    for (std::size_t carrier = 0; carrier < states.carriers(); ++carrier) {
      margins.push_back(states.margin_db(place, carrier) - less_db);
    }
  }
  return LinkStates(margins);
}

ExpectedCount expected(const std::vector<double>& samples, double most) {
  const Forecasted range = range_of(samples, most);
  return {range.mean, range.low, range.high};
}

double count_of(const std::vector<char>& flags) {
  return static_cast<double>(
      std::count_if(flags.begin(), flags.end(), [](char flag) { return flag != 0; }));
}

}  // namespace

LayoutForecast::LayoutForecast(const PlanSpec& plan, const LinkMatrix& matrix,
                               const PlanProblem& problem, const PlanRequest& request)
    : plan_(plan),
      matrix_(matrix),
      problem_(problem),
      request_(request),
      duration_s_(plan.dwell_s) {
  for (std::size_t sample = 0; sample < request.samples; ++sample) {
    tags_.push_back(tags_of_sample(plan, request.seed, sample));
  }
  first_rows_.resize(plan.tags.size());
  for (std::size_t row = 0; row < matrix.rows.size(); ++row) {
    if (matrix.rows[row].stop == 0) first_rows_[matrix.rows[row].group].push_back(row);
  }
  for (const PlanTags& tags : plan.tags) {
    stops_.push_back(stops_of(tags, plan.dwell_s));
    duration_s_ = std::max(duration_s_, stops_.back().back().end_s);
  }
}

std::vector<ForecastPort> LayoutForecast::ports_of(const OptionSet& choice) const {
  const std::vector<PlannedAntenna> antennas = antennas_of(plan_, matrix_, problem_, choice);
  std::vector<ForecastPort> ports;
  for (std::size_t i = 0; i < choice.size(); ++i) {
    ForecastPort port{mount_of(choice[i]).antenna, antennas[i].reader};
    port.antenna.name = antennas[i].name;
    port.antenna.reader = antennas[i].reader;
    ports.push_back(std::move(port));
  }
  return ports;
}

std::size_t LayoutForecast::first_row_of(const PlanTag& tag) const {
  const std::size_t orientations = plan_.tags[tag.group].orientations.size();
  return first_rows_[tag.group][tag.place * orientations + tag.orientation];
}

std::vector<std::vector<RangeInformation>> LayoutForecast::ranges_of(
    const OptionSet& choice, const std::vector<std::vector<LinkStates>>& states,
    double less_db) const {
  if (!plan_.aim.position_error_m) return {};
  std::vector<std::vector<RangeInformation>> ranges(choice.size());
  parallel_for(choice.size(), request_.threads, [&](std::size_t port) {
    const PlanMount& mount = mount_of(choice[port]);
    const Eigen::Vector3d p_WA = place_of(choice[port]);
    for (std::size_t row = 0; row < matrix_.rows.size(); ++row) {
      const double distance_m = (matrix_.rows[row].X_WT.translation - p_WA).norm();
      ranges[port].push_back(
          range_information(*physical(mount.antenna), states[port][row], less_db, distance_m));
    }
  });
  return ranges;
}

const PlanMount& LayoutForecast::mount_of(std::size_t option) const {
  return plan_.mounts[matrix_.columns[problem_.options[option].column].mount];
}

Eigen::Vector3d LayoutForecast::place_of(std::size_t option) const {
  const LinkColumn& column = matrix_.columns[problem_.options[option].column];
  return plan_.mounts[column.mount].X_WA[column.look].translation;
}

bool LayoutForecast::has_enough(const std::vector<CountedReads>& reads, const OptionSet& choice,
                                const std::vector<std::vector<RangeInformation>>& ranges,
                                std::size_t row) const {
  if (plan_.aim.dwell_reads) {
    double sum = 0.0;
    for (const CountedReads& of_port : reads) sum += of_port.reads;
    return sum >= *plan_.aim.dwell_reads;
  }
  std::vector<PositionInformation> information;
  for (std::size_t port = 0; port < reads.size(); ++port) {
    information.push_back(position_information(ranges[port][row], reads[port].reads,
                                               reads[port].spread(), place_of(choice[port]),
                                               matrix_.rows[row].X_WT.translation));
  }
  return error_bound_m(information) <= *plan_.aim.position_error_m;
}

// NOLINTNEXTLINE(readability-function-size): what all samples share is gathered once.
std::vector<LayoutForecast::Sample> LayoutForecast::samples(const OptionSet& choice,
                                                            double less_db) const {
  const std::vector<ForecastPort> ports = ports_of(choice);
  // Compute each link only once, by port and row.
  std::vector<std::vector<LinkStates>> states(choice.size());
  parallel_for(choice.size(), request_.threads, [&](std::size_t port) {
    const PlanOption& option = problem_.options[choice[port]];
    for (std::size_t row = 0; row < matrix_.rows.size(); ++row) {
      states[port].push_back(weaker(matrix_.states(option.column, row), option.less_db));
    }
  });
  const std::vector<PlannedAntenna> antennas = antennas_of(plan_, matrix_, problem_, choice);
  std::map<std::string, std::string> zone_of_reader;
  for (const PlannedAntenna& antenna : antennas) zone_of_reader[antenna.reader] = antenna.zone;
  const std::vector<std::vector<RangeInformation>> ranges = ranges_of(choice, states, less_db);
  std::vector<Sample> samples(tags_.size());
  parallel_for(tags_.size(), request_.threads, [&](std::size_t number) {
    ForecastRequest request;
    request.counts_reads = plan_.aim.dwell_reads || plan_.aim.position_error_m;
    request.ports = ports;
    request.duration_s = duration_s_;
    request.less_db = less_db;
    request.samples = 1;
    request.first_sample = number;
    request.seed = request_.seed;
    for (const PlanTag& tag : tags_[number]) {
      ForecastTag& of_tag = request.tags.emplace_back();
      const std::size_t first = first_row_of(tag);
      const std::vector<PlanStop>& stops = stops_[tag.group];
      for (std::size_t port = 0; port < ports.size(); ++port) {
        for (std::size_t stop = 0; stop < stops.size(); ++stop) {
          const LinkStates& link = states[port][first + stop];
          if (link.is_empty()) continue;
          // The pallet stands at the start of its path before, and at the end of it afterwards.
          ForecastLink forecast_link{port, stops[stop].begin_s, stops[stop].end_s, &link};
          if (stop == 0) forecast_link.begin_s = 0.0;
          if (stop + 1 == stops.size()) forecast_link.end_s = duration_s_;
          of_tag.links.push_back(forecast_link);
        }
      }
    }
    const Forecast made = forecast(request);
    Sample& sample = samples[number];
    sample.read = made.read.front();
    for (std::size_t tag = 0; request.counts_reads && tag < sample.read.size(); ++tag) {
      const std::vector<CountedReads>& reads = made.reads.front()[tag];
      sample.read[tag] =
          has_enough(reads, choice, ranges, first_row_of(tags_[number][tag])) ? 1 : 0;
    }
    sample.crossed.assign(sample.read.size(), 0);
    for (std::size_t group = 0; group < made.groups.size(); ++group) {
      const std::string& zone = zone_of_reader[made.groups[group]];
      for (std::size_t tag = 0; tag < sample.crossed.size(); ++tag) {
        const std::string& own = plan_.tags[tags_[number][tag].group].zone;
        if (is_crossing(zone, own) && made.read_by_group.front()[group][tag] != 0)
          sample.crossed[tag] = 1;
      }
    }
  });
  return samples;
}

ExpectedCount LayoutForecast::read(const OptionSet& choice, double less_db) const {
  std::vector<double> counts;
  for (const Sample& sample : samples(choice, plan_.margin_db + less_db)) {
    counts.push_back(count_of(sample.read));
  }
  return expected(counts, static_cast<double>(tags_.front().size()));
}

void LayoutForecast::fill(const OptionSet& choice, PlannedLayout& layout) const {
  const std::vector<Sample> all = samples(choice, plan_.margin_db);
  // Cross reads must not be reduced by a margin that links may not need.
  const bool is_same = plan_.margin_db == 0.0 || problem_.zones.size() < 2;
  const std::vector<Sample> as_they_are = is_same ? all : samples(choice, 0.0);
  std::vector<double> counts;
  std::vector<double> crossings;
  for (std::size_t number = 0; number < all.size(); ++number) {
    counts.push_back(count_of(all[number].read));
    crossings.push_back(count_of(as_they_are[number].crossed));
  }
  layout.read = expected(counts, static_cast<double>(tags_.front().size()));
  layout.cross = expected(crossings, static_cast<double>(tags_.front().size()));
  for (const std::string& zone : problem_.zones) {
    PlannedZone row;
    row.zone = zone;
    for (const PlanTags& tags : plan_.tags) {
      if (tags.zone == zone) row.tags += tags.count;
    }
    std::vector<double> read;
    std::vector<double> crossed;
    for (std::size_t number = 0; number < all.size(); ++number) {
      read.push_back(0.0);
      crossed.push_back(0.0);
      for (std::size_t tag = 0; tag < tags_[number].size(); ++tag) {
        if (plan_.tags[tags_[number][tag].group].zone != zone) continue;
        read.back() += all[number].read[tag] != 0 ? 1.0 : 0.0;
        crossed.back() += as_they_are[number].crossed[tag] != 0 ? 1.0 : 0.0;
      }
    }
    row.read = expected(read, static_cast<double>(row.tags));
    row.cross = expected(crossed, static_cast<double>(row.tags));
    layout.zones.push_back(std::move(row));
  }
}

}  // namespace tagfield
