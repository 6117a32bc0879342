// SPDX-License-Identifier: Apache-2.0
/// @file
/// libmosquitto, loaded on the first connection to a broker.
#pragma once

#include <mosquitto.h>

#include "tagfield/base/loaded_library.h"

namespace tagfield {

/// Functions of libmosquitto, named without the prefix "mosquitto_".
struct LibMosquitto : LoadedLibrary {
  LibMosquitto() : LoadedLibrary("MQTT", TAGFIELD_LIBMOSQUITTO) {}
  decltype(&mosquitto_connack_string) connack_string = function("mosquitto_connack_string");
  decltype(&mosquitto_connect_async) connect_async = function("mosquitto_connect_async");
  decltype(&mosquitto_connect_callback_set) connect_callback_set =
      function("mosquitto_connect_callback_set");
  decltype(&mosquitto_destroy) destroy = function("mosquitto_destroy");
  decltype(&mosquitto_disconnect) disconnect = function("mosquitto_disconnect");
  decltype(&mosquitto_disconnect_callback_set) disconnect_callback_set =
      function("mosquitto_disconnect_callback_set");
  decltype(&mosquitto_int_option) int_option = function("mosquitto_int_option");
  decltype(&mosquitto_lib_init) lib_init = function("mosquitto_lib_init");
  decltype(&mosquitto_loop) loop = function("mosquitto_loop");
  decltype(&mosquitto_max_inflight_messages_set) max_inflight_messages_set =
      function("mosquitto_max_inflight_messages_set");
  decltype(&mosquitto_new) new_ = function("mosquitto_new");
  decltype(&mosquitto_publish) publish = function("mosquitto_publish");
  decltype(&mosquitto_publish_callback_set) publish_callback_set =
      function("mosquitto_publish_callback_set");
  decltype(&mosquitto_reconnect_async) reconnect_async = function("mosquitto_reconnect_async");
  decltype(&mosquitto_strerror) strerror = function("mosquitto_strerror");
  decltype(&mosquitto_threaded_set) threaded_set = function("mosquitto_threaded_set");
  decltype(&mosquitto_username_pw_set) username_pw_set = function("mosquitto_username_pw_set");
};

inline const LibMosquitto& libmosquitto() { return loaded<LibMosquitto>(); }

}  // namespace tagfield
