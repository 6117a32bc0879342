// SPDX-License-Identifier: Apache-2.0
#include "adapters/mqtt/mqtt_outlet.h"

#include "tagfield/events/event_json.h"

namespace tagfield {

MqttOutlet::MqttOutlet(const std::string& url, Time start, const MqttOptions& options)
    : url_(mqtt_url(url)), start_(start), client_(url_, options) {}

void MqttOutlet::on_antenna_added(const AntennaInfo& antenna) {
  ports_.port_of(antenna.reader, antenna.name);
}

void MqttOutlet::on_read(const TagRead& read) {
  std::string json;
  append_json(read, start_, ports_, json);
  client_.publish(url_.prefix + "/reads/" + topic_level(read.reader), json);
}

void MqttOutlet::on_presence(const PresenceEvent& event) {
  publish_event(to_json_line(event, start_));
}

void MqttOutlet::on_cycle(const CycleReports& reports) {
  publish_event(to_json_line(reports, start_));
}

void MqttOutlet::publish_event(std::string line) {
  line.pop_back();  // the line end
  client_.publish(url_.prefix + "/events", line);
}

}  // namespace tagfield
