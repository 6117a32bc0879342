// SPDX-License-Identifier: Apache-2.0
#include "tagfield/planning/forecast.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include "tagfield/base/error.h"
#include "tagfield/base/parallel.h"
#include "tagfield/base/random.h"
#include "tagfield/base/student.h"
#include "tagfield/base/time.h"
#include "tagfield/base/units.h"
#include "tagfield/field/port_turns.h"
#include "tagfield/gen2/inventory.h"
#include "tagfield/planning/local_link.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield {
namespace {

constexpr double kReply_dbm = -50.0;
/// Longest interval between updates of which tags are heard, and by which reader first.
constexpr double kPiece_s = 0.25;

/// An interval in which one antenna transmits and the set of powered tags does not change.
struct Turn {
  std::size_t port = 0;
  double begin_s = 0.0;
  double end_s = 0.0;
  double carrier_s = 0.0;  ///< Time that determines the carrier.
};

std::size_t port_named(const ForecastRequest& request, const std::string& name) {
  std::size_t port = 0;
  while (request.ports[port].antenna.name != name) ++port;
  return port;
}

/// The antenna's last update by `time_s`, and the number of hops made by then. Each update
/// determines which tags have power, on its own carrier.
struct LastUpdate {
  double stamp_s = 0.0;
  double hop = 0.0;
};
LastUpdate last_update(const AntennaParameters& antenna, double time_s) {
  const double stamp_s = std::floor(time_s * antenna.rate_hz + 1e-9) / antenna.rate_hz;
  return {stamp_s, std::floor(stamp_s / physical(antenna)->plan.dwell_s + 1e-9)};
}

/// Adds a port's turn, in pieces with one carrier each.
void add_turn(const ForecastRequest& request, std::size_t port, double begin_s, double end_s,
              std::vector<Turn>& turns) {
  const AntennaParameters& antenna = request.ports[port].antenna;
  // Reads after the antenna's last update are no longer reported.
  end_s = std::min(end_s, last_update(antenna, request.duration_s).stamp_s);
  double at = begin_s;
  while (at < end_s - 1e-9) {
    const LastUpdate now = last_update(antenna, at);
    double until = now.stamp_s;
    do {
      until += 1.0 / antenna.rate_hz;
    } while (until < end_s && last_update(antenna, until).hop == now.hop);
    const double end = std::min({until, end_s, at + kPiece_s});
    turns.push_back({port, at, end, now.stamp_s});
    at = end;
  }
}

/// Turns of all readers' ports, in chronological order.
std::vector<Turn> turns_of(const ForecastRequest& request) {
  std::vector<AntennaParameters> antennas;
  for (const ForecastPort& port : request.ports) antennas.push_back(port.antenna);
  std::vector<Turn> turns;
  const Time end = time_from_seconds(request.duration_s);
  for (const PortCycle& cycle : port_cycles(antennas)) {
    const std::vector<PortCycle> alone = {cycle};
    Time begin{};
    while (begin < end) {
      const Time change = std::min(next_change(alone, begin).value_or(end), end);
      add_turn(request, port_named(request, antenna_on_turn(cycle, begin)), to_seconds(begin),
               to_seconds(change), turns);
      begin = change;
    }
  }
  std::stable_sort(turns.begin(), turns.end(),
                   [](const Turn& a, const Turn& b) { return a.begin_s < b.begin_s; });
  return turns;
}

bool takes_turns(const ForecastPort& port) {
  const RadioModel* const model = physical(port.antenna);
  return model != nullptr && takes_inventory(*model);
}

struct Link {
  std::size_t tag = 0;
  const ForecastLink* link = nullptr;
};

/// The links of a port that are valid at a given time; times must not decrease.
class HoldingLinks {
 public:
  /// `links` must be sorted by their begin.
  explicit HoldingLinks(const std::vector<Link>& links) : links_(links) {}

  const std::vector<Link>& at(double time_s) {
    holding_.erase(std::remove_if(holding_.begin(), holding_.end(),
                                  [&](const Link& link) { return link.link->end_s <= time_s; }),
                   holding_.end());
    for (; next_ < links_.size() && links_[next_].link->begin_s <= time_s; ++next_) {
      if (links_[next_].link->end_s > time_s) holding_.push_back(links_[next_]);
    }
    return holding_;
  }

 private:
  const std::vector<Link>& links_;
  std::size_t next_ = 0;
  std::vector<Link> holding_;
};

class Sampler {
 public:
  explicit Sampler(const ForecastRequest& request);
  /// Runs one sample: what it reads by group and tag, and by tag and port.
  void sample(std::size_t first, std::size_t place, Forecast& forecast,
              std::vector<std::vector<CountedReads>>& by_port) const;

 private:
  /// Called with tag, port and channel; returns whether it was the first read of that tag by that
  /// port.
  using OnRead = std::function<bool(std::size_t, std::size_t, std::size_t)>;
  [[nodiscard]] std::size_t channel_on(std::size_t number, std::size_t port, double time_s) const;
  [[nodiscard]] std::size_t sampled_carrier(std::size_t port, std::size_t channel) const;
  [[nodiscard]] std::vector<TagOnAir> heard_in(std::size_t number, const Turn& turn,
                                               const std::vector<std::size_t>& places,
                                               HoldingLinks& holding) const;
  void run_inventories(std::size_t number, const std::vector<std::size_t>& places,
                       const OnRead& on_read) const;
  [[nodiscard]] std::vector<std::unique_ptr<Inventory>> inventories_of(std::size_t number,
                                                                       TagMemories& memories) const;
  [[nodiscard]] std::size_t pairs_heard(const std::vector<std::size_t>& places) const;
  void read_updates(std::size_t number, const std::vector<std::size_t>& places,
                    const OnRead& on_read) const;

  const ForecastRequest& request_;
  std::vector<Turn> turns_;
  std::vector<Time> changes_;             ///< When turns begin or end, in ascending order.
  std::vector<std::vector<Link>> links_;  ///< By port.
  std::vector<std::size_t> group_of_;
  std::vector<std::size_t> turn_of_;  ///< By port: the number of its reader.
};

Sampler::Sampler(const ForecastRequest& request)
    : request_(request), turns_(turns_of(request)), links_(request.ports.size()) {
  for (std::size_t tag = 0; tag < request.tags.size(); ++tag) {
    for (const ForecastLink& link : request.tags[tag].links) {
      const bool is_there =
          link.states != nullptr ? !link.states->is_empty() : link.update_probability > 0.0;
      if (is_there) links_[link.port].push_back({tag, &link});
    }
  }
  for (std::vector<Link>& links : links_) {
    std::stable_sort(links.begin(), links.end(), [](const Link& a, const Link& b) {
      return a.link->begin_s < b.link->begin_s;
    });
  }
  for (const Turn& turn : turns_) {
    changes_.push_back(time_from_seconds(turn.begin_s));
    changes_.push_back(time_from_seconds(turn.end_s));
  }
  std::sort(changes_.begin(), changes_.end());
  changes_.erase(std::unique(changes_.begin(), changes_.end()), changes_.end());
  std::vector<std::string> groups;
  for (const ForecastPort& port : request.ports) {
    const auto known = std::find(groups.begin(), groups.end(), port.group);
    group_of_.push_back(static_cast<std::size_t>(known - groups.begin()));
    if (known == groups.end()) groups.push_back(port.group);
  }
  std::vector<AntennaParameters> hopping;
  for (const ForecastPort& port : request.ports) {
    if (physical(port.antenna) != nullptr) hopping.push_back(port.antenna);
  }
  for (const ForecastPort& port : request.ports) {
    turn_of_.push_back(
        physical(port.antenna) != nullptr ? reader_number(hopping, port.antenna.reader) : 0);
  }
}

/// The reader's current channel: it hops over all channels of its plan in a random order, drawn for
/// each sample, as readers do (channel_at()).
std::size_t Sampler::channel_on(std::size_t number, std::size_t port, double time_s) const {
  const RadioModel& model = *physical(request_.ports[port].antenna);
  if (hopped_channels(model) < 2) return 0;
  RandomStream stream(request_.seed, Purpose::kForecast, number, 0, 1);
  return channel_at(model.plan, time_from_seconds(std::max(0.0, time_s)),
                    stream_key(model.plan.name), stream(), turn_of_[port]);
}

/// The carrier of the link states that represents a channel.
std::size_t Sampler::sampled_carrier(std::size_t port, std::size_t channel) const {
  const RadioModel& model = *physical(request_.ports[port].antenna);
  return hopped_channels(model) < 2 ? 0 : sampled_carrier_of(model, channel);
}

/// Antennas without an inventory: each update reads all tags that are heard on its carrier.
void Sampler::read_updates(std::size_t number, const std::vector<std::size_t>& places,
                           const OnRead& on_read) const {
  for (std::size_t port = 0; port < request_.ports.size(); ++port) {
    if (takes_turns(request_.ports[port]) || links_[port].empty()) continue;
    const AntennaParameters& antenna = request_.ports[port].antenna;
    const auto updates =
        static_cast<std::size_t>(std::floor(request_.duration_s * antenna.rate_hz + 1e-9)) + 1;
    RandomStream stream(request_.seed, Purpose::kForecast, number, stream_key(antenna.name), 0);
    const bool is_paper = physical(antenna) == nullptr;
    HoldingLinks holding(links_[port]);
    for (std::size_t update = 0; update < updates; ++update) {
      const double time_s = static_cast<double>(update) / antenna.rate_hz;
      const std::size_t channel = is_paper ? 0 : channel_on(number, port, time_s);
      const std::size_t carrier = is_paper ? 0 : sampled_carrier(port, channel);
      // The paper's range is drawn once per update, for all tags.
      const double draw = uniform(stream);
      for (const Link& link : holding.at(time_s)) {
        const bool is_heard =
            is_paper ? draw < link.link->update_probability
                     : link.link->states->margin_db(places[link.tag], carrier) >= request_.less_db;
        if (is_heard) on_read(link.tag, port, channel);
      }
    }
  }
}

/// The tags that take part in a turn. All replies are equally strong, so there is no capture.
std::vector<TagOnAir> Sampler::heard_in(std::size_t number, const Turn& turn,
                                        const std::vector<std::size_t>& places,
                                        HoldingLinks& holding) const {
  const std::size_t carrier =
      sampled_carrier(turn.port, channel_on(number, turn.port, turn.carrier_s));
  std::vector<TagOnAir> heard;
  for (const Link& link : holding.at(0.5 * (turn.begin_s + turn.end_s))) {
    if (link.link->states->margin_db(places[link.tag], carrier) < request_.less_db) continue;
    heard.push_back({static_cast<std::uint32_t>(link.tag), kReply_dbm, 1.0});
  }
  return heard;
}

/// Number of pairs of a tag and a port with an inventory that can hear it at all.
std::size_t Sampler::pairs_heard(const std::vector<std::size_t>& places) const {
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t port = 0; port < request_.ports.size(); ++port) {
    if (!takes_turns(request_.ports[port])) continue;
    for (const Link& link : links_[port]) {
      if (link.link->states->share_heard(places[link.tag], request_.less_db) > 0.0) {
        pairs.insert({link.tag, port});
      }
    }
  }
  return pairs.size();
}

/// An inventory for each port that takes turns and hears anything; null for the others.
std::vector<std::unique_ptr<Inventory>> Sampler::inventories_of(std::size_t number,
                                                                TagMemories& memories) const {
  std::vector<std::unique_ptr<Inventory>> inventories(request_.ports.size());
  for (std::size_t port = 0; port < request_.ports.size(); ++port) {
    if (!takes_turns(request_.ports[port]) || links_[port].empty()) continue;
    const AntennaParameters& antenna = request_.ports[port].antenna;
    const Gen2Reader& gen2 = *physical(antenna)->gen2;
    const std::uint64_t key = stream_key(antenna.name);
    RandomStream seeds(request_.seed, Purpose::kForecast, number, key, ~std::uint64_t{0});
    inventories[port] =
        std::make_unique<Inventory>(gen2.link, gen2.inventory, memories, seeds(), key);
  }
  return inventories;
}

/// Runs the inventories, slot by slot, between changes of which antenna transmits and which tags
/// are heard. Ends when nothing is left to be read for the first time, as reported by `on_read`,
/// unless all reads are counted.
void Sampler::run_inventories(std::size_t number, const std::vector<std::size_t>& places,
                              const OnRead& on_read) const {
  TagMemories memories;
  const std::vector<std::unique_ptr<Inventory>> inventories = inventories_of(number, memories);
  std::vector<HoldingLinks> holding;
  holding.reserve(links_.size());
  for (const std::vector<Link>& links : links_) holding.emplace_back(links);
  std::size_t left =
      request_.counts_reads ? std::numeric_limits<std::size_t>::max() : pairs_heard(places);
  std::vector<Time> sends_until(request_.ports.size(), Time::min());
  std::vector<std::size_t> channel(request_.ports.size(), 0);
  std::vector<Singulation> read;
  auto turn = turns_.begin();
  for (std::size_t i = 0; i + 1 < changes_.size() && left > 0; ++i) {
    const Time now = changes_[i];
    auto begun = turn;
    for (; turn != turns_.end() && time_from_seconds(turn->begin_s) == now; ++turn) {
      sends_until[turn->port] = time_from_seconds(turn->end_s);
    }
    for (std::size_t port = 0; port < inventories.size(); ++port) {
      if (inventories[port] && sends_until[port] <= now) inventories[port]->stop(now);
    }
    for (; begun != turn; ++begun) {
      if (!inventories[begun->port]) continue;
      inventories[begun->port]->set_field(now,
                                          heard_in(number, *begun, places, holding[begun->port]));
      inventories[begun->port]->start(now);
      channel[begun->port] = channel_on(number, begun->port, begun->carrier_s);
    }
    for (Time until = now; until < changes_[i + 1];) {
      until = std::min(changes_[i + 1], until + kReadersSideBySide);
      for (std::size_t port = 0; port < inventories.size(); ++port) {
        if (!inventories[port] || !inventories[port]->on()) continue;
        read.clear();
        inventories[port]->run_until(until, read);
        for (const Singulation& one : read) left -= on_read(one.tag, port, channel[port]) ? 1U : 0U;
      }
    }
  }
}

void Sampler::sample(std::size_t first, std::size_t place, Forecast& forecast,
                     std::vector<std::vector<CountedReads>>& by_port) const {
  const std::size_t number = first + place;
  const std::size_t count = request_.tags.size();
  RandomStream stream(request_.seed, Purpose::kForecast, number);
  std::vector<std::size_t> places(count);
  for (std::size_t tag = 0; tag < count; ++tag) {
    const auto drawn =
        static_cast<std::size_t>(uniform(stream) * static_cast<double>(kFadingPositions));
    places[tag] = request_.tags[tag].place.value_or(drawn);
  }
  const auto on_read = [&](std::size_t tag, std::size_t port, std::size_t channel) {
    CountedReads& counted = by_port[tag][port];
    const bool is_first = counted.reads == 0.0;
    forecast.read[place][tag] = 1;
    forecast.read_by_group[place][group_of_[port]][tag] = 1;
    counted.reads += 1.0;
    if (const RadioModel* const model = physical(request_.ports[port].antenna)) {
      const std::vector<double>& carriers_hz = model->plan.carriers_hz;
      const double off_hz = carriers_hz[channel] - carriers_hz.front();
      counted.sum_hz += off_hz;
      counted.squares_hz += off_hz * off_hz;
    }
    return is_first;
  };
  run_inventories(number, places, on_read);
  read_updates(number, places, on_read);
}

}  // namespace

double CountedReads::spread() const {
  return reads > 0.0 ? std::max(0.0, squares_hz - sum_hz * sum_hz / reads) : 0.0;
}

Forecasted range_of(const std::vector<double>& samples, double most) {
  const auto count = static_cast<double>(samples.size());
  Forecasted range;
  for (const double sample : samples) range.mean += sample / count;
  range.low = range.high = range.mean;
  if (samples.size() < 2) return range;
  double variance = 0.0;
  for (const double sample : samples) {
    variance += (sample - range.mean) * (sample - range.mean) / (count - 1.0);
  }
  const double half = student_975(count - 1.0) * std::sqrt(variance * (1.0 + 1.0 / count)) + 0.5;
  range.low = std::max(0.0, range.mean - half);
  range.high = std::min(most, range.mean + half);
  return range;
}

Forecast forecast(const ForecastRequest& request) {
  if (request.ports.empty()) throw Error("a forecast needs an antenna");
  if (request.samples < 1) throw Error("a forecast needs a sample");
  const std::size_t tags = request.tags.size();
  const Sampler sampler(request);
  Forecast result;
  for (const ForecastPort& port : request.ports) {
    if (std::find(result.groups.begin(), result.groups.end(), port.group) == result.groups.end()) {
      result.groups.push_back(port.group);
    }
  }
  result.read.assign(request.samples, std::vector<char>(tags, 0));
  result.read_by_group.assign(
      request.samples,
      std::vector<std::vector<char>>(result.groups.size(), std::vector<char>(tags, 0)));
  // Sum in the order of the samples, so that results don't depend on the threads.
  std::vector<std::vector<std::vector<CountedReads>>> by_port(request.samples);
  parallel_for(request.samples, request.threads, [&](std::size_t sample) {
    by_port[sample].resize(tags);
    for (std::size_t tag = 0; tag < tags; ++tag) {
      if (!request.tags[tag].links.empty()) by_port[sample][tag].resize(request.ports.size());
    }
    sampler.sample(request.first_sample, sample, result, by_port[sample]);
  });
  result.probability.assign(tags, 0.0);
  result.by_port.assign(tags, {});
  std::vector<double> counts(request.samples, 0.0);
  const double weight = 1.0 / static_cast<double>(request.samples);
  for (std::size_t sample = 0; sample < request.samples; ++sample) {
    for (std::size_t tag = 0; tag < tags; ++tag) {
      const double read = result.read[sample][tag] != 0 ? 1.0 : 0.0;
      counts[sample] += read;
      result.probability[tag] += weight * read;
      const std::vector<CountedReads>& ports = by_port[sample][tag];
      if (!ports.empty()) result.by_port[tag].resize(request.ports.size(), 0.0);
      for (std::size_t port = 0; port < ports.size(); ++port) {
        result.by_port[tag][port] += ports[port].reads > 0.0 ? weight : 0.0;
      }
    }
  }
  result.tags_read = range_of(counts, static_cast<double>(tags));
  if (request.counts_reads) result.reads = std::move(by_port);
  return result;
}

}  // namespace tagfield
