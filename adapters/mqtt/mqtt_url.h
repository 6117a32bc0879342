// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where a broker of MQTT is, as one word.
#pragma once

#include <string>

namespace tagfield {

/// Parts of "mqtt://[user[:password]@]host[:port][/prefix]", or "mqtts://…" with TLS.
struct MqttUrl {
  bool has_tls = false;
  std::string user;                 ///< "" for nobody.
  std::string password;             ///< "" for none.
  std::string host;                 ///< A name, or an address; of IPv6 without its brackets.
  int port = 1883;                  ///< With TLS 8883 where none is given.
  std::string prefix = "tagfield";  ///< Of all topics, without a '/' at its end.
};

/// User, password and prefix may have %XX. Throws Error that names the URL, its password left out,
/// where it is none.
MqttUrl mqtt_url(const std::string& text);

/// "host:port", for messages.
std::string broker_name(const MqttUrl& url);

/// A name as one level of a topic: '/', '+', '#' and control characters become '_'.
std::string topic_level(const std::string& name);

}  // namespace tagfield
