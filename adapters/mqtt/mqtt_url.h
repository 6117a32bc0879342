// SPDX-License-Identifier: Apache-2.0
/// @file
/// URLs of MQTT brokers.
#pragma once

#include <set>
#include <string>

#include "tagfield/base/error.h"

namespace tagfield {

/// Parts of "mqtt://[user[:password]@]host[:port][/prefix]", or "mqtts://…" with TLS.
struct MqttUrl {
  bool has_tls = false;
  std::string user;                 ///< "" for none.
  std::string password;             ///< "" for none.
  std::string host;                 ///< A name or an address; IPv6 without brackets.
  int port = 1883;                  ///< Default with TLS: 8883.
  std::string prefix = "tagfield";  ///< Of all topics, without a trailing '/'.
};

/// User, password and prefix may contain %XX. Throws Error, which names the URL without its
/// password, if it is malformed.
MqttUrl mqtt_url(const std::string& text);

/// "host:port", for messages.
std::string broker_name(const MqttUrl& url);

/// A name as one level of a topic: '/', '+', '#' and control characters become '_'.
std::string topic_level(const std::string& name);

/// Warns of each reader whose topic has another name. Throws Error if two readers would share a
/// topic: their subscribers could not tell them apart.
void check_reader_topics(const std::set<std::string>& readers, Diagnostics& diagnostics);

}  // namespace tagfield
