// SPDX-License-Identifier: Apache-2.0
#include "adapters/http/live_feed.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "adapters/http/live_json.h"

namespace tagfield::http {
namespace {

/// Twenty per second: pages interpolate in between.
constexpr std::chrono::milliseconds kFrameEvery(50);

bool antenna_moves(const AntennaSpec& spec) {
  return !spec.on.empty() || spec.lift.travel_m > 0.0 || !spec.recorded.empty();
}

Json named_pose(const std::string& name, const RigidTransform& X) {
  Json row = {name};
  for (const Json& number : pose_json(X)) row.push_back(number);
  return row;
}

}  // namespace

void LiveFeed::add(std::weak_ptr<FrameClient> client) {
  const std::lock_guard<std::mutex> guard(lock_);
  frame_clients_.push_back(std::move(client));
  has_frame_clients_ = true;
  has_new_client_ = true;
}

void LiveFeed::add(std::weak_ptr<ReadClient> client) {
  const std::lock_guard<std::mutex> guard(lock_);
  read_clients_.push_back(std::move(client));
  has_read_clients_ = true;
}

void LiveFeed::on_read(const TagRead& read) {
  ++count_;
  if (has_read_clients_) fresh_.push_back(read);
  if (!has_frame_clients_) return;
  LastRead& last = last_[{read.tag, read.antenna}];
  last.read = read;
  ++last.count;
}

template <class Client, class Message>
void LiveFeed::tell(std::vector<std::weak_ptr<Client>>& clients, std::atomic<bool>& any,
                    const Message& message, void (Client::*take)(Message)) {
  const std::lock_guard<std::mutex> guard(lock_);
  const auto is_gone = [&](const std::weak_ptr<Client>& weak) {
    const std::shared_ptr<Client> client = weak.lock();
    if (client) ((*client).*take)(message);
    return client == nullptr;
  };
  clients.erase(std::remove_if(clients.begin(), clients.end(), is_gone), clients.end());
  any = !clients.empty();
}

void LiveFeed::on_step(LiveWorld& world, Time /*now*/) {
  if (has_read_clients_) tell_reads(world);
  if (!has_frame_clients_) return;
  const auto wall = std::chrono::steady_clock::now();
  if (wall < framed_ + kFrameEvery) return;
  framed_ = wall;
  tell_frame(world);
}

void LiveFeed::on_tasks(LiveWorld& world) {
  // Changes by clients are shown even while the world is paused.
  if (has_frame_clients_ && world.is_paused()) tell_frame(world);
}

void LiveFeed::tell_reads(const LiveWorld& world) {
  if (fresh_.empty()) return;
  // Numbered as in the world, and not in the order in which they are first read.
  for (const LiveAntenna& antenna : world.antennas()) {
    ports_.set(antenna.spec.parameters.reader, antenna.spec.parameters.name, antenna.port);
  }
  auto batch = std::make_shared<ReadLines>();
  batch->lines.reserve(fresh_.size());
  for (const TagRead& read : fresh_)
    batch->lines.push_back(read_to_json_line(read, start_, ports_));
  batch->reads.swap(fresh_);
  tell(read_clients_, has_read_clients_, std::shared_ptr<const ReadLines>(batch),
       &ReadClient::on_reads);
}

void LiveFeed::tell_frame(const LiveWorld& world) {
  const Going going{world.now(), world.is_paused(), world.speed(), world.revision()};
  const bool is_new = has_new_client_.exchange(false);
  const bool has_estimates = estimates_ && estimates_->newest() != estimate_sent_;
  if (going == sent_ && last_.empty() && !has_estimates && !is_new) return;
  const auto frame = std::make_shared<const std::string>(frame_of(world, going, is_new));
  sent_ = going;
  last_.clear();
  tell(frame_clients_, has_frame_clients_, frame, &FrameClient::on_frame);
}

std::string LiveFeed::frame_of(const LiveWorld& world, const Going& going, bool is_new) {
  Json frame = {{"time", to_seconds(going.now)},
                {"pace", world.pace()},
                {"paused", going.is_paused},
                {"speed", going.speed}};
  for (const char* key : {"robots", "antennas", "tags", "reads"}) frame[key] = Json::array();
  for (const LivePose& robot : world.robots()) {
    frame["robots"].push_back(named_pose(robot.name, robot.X_W));
  }
  for (const LiveAntenna& antenna : world.antennas()) {
    if (!antenna_moves(antenna.spec)) continue;
    frame["antennas"].push_back(
        named_pose(antenna.spec.parameters.name, world.antenna_pose(antenna)));
  }
  for (const LivePose& tag : world.moving_tags()) {
    const Eigen::Vector3d& p = tag.X_W.translation;
    frame["tags"].push_back({tag.name, p.x(), p.y(), p.z()});
  }
  for (const auto& [key, last] : last_) {
    const TagRead& read = last.read;
    frame["reads"].push_back({read.tag, read.antenna, read.rssi_dbm, read.phase_rad,
                              read.frequency_hz, to_seconds(read.stamp), last.count});
  }
  if (going.revision != sent_.revision) frame["changed"] = true;
  if (estimates_) {
    const auto fresh = estimates_->since(is_new ? 0 : estimate_sent_);
    if (!fresh.empty()) estimate_sent_ = fresh.back().number;
    frame["estimates"] = estimate_rows(fresh);
  }
  if (lasers_) {
    Json scans = lasers_->scans(world, is_new);
    if (!scans.is_null()) frame["scans"] = std::move(scans);
  }
  return json_text(frame);
}

}  // namespace tagfield::http
