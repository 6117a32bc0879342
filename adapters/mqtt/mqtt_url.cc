// SPDX-License-Identifier: Apache-2.0
#include "adapters/mqtt/mqtt_url.h"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <map>
#include <optional>

#include "tagfield/epc/epc.h"

namespace tagfield {
namespace {

constexpr int kTlsPort = 8883;

std::string without_password(const std::string& text) {
  const std::size_t at = text.rfind('@');
  const std::size_t begin = text.find("://");
  if (at == std::string::npos || begin == std::string::npos || at < begin) return text;
  return text.substr(0, begin + 3) + "…" + text.substr(at);
}

/// Text with %XX decoded; none if malformed.
std::optional<std::string> decoded(const std::string& text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      plain += text[i];
      continue;
    }
    const std::string digits = text.substr(i + 1, 2);
    if (digits.size() != 2 || !is_hexadecimal(digits)) return std::nullopt;
    plain += static_cast<char>(std::stoi(digits, nullptr, 16));
    i += 2;
  }
  return plain;
}

bool parse_port(const std::string& text, int& port) {
  const char* const end = text.data() + text.size();
  const auto [rest, fault] = std::from_chars(text.data(), end, port);
  return fault == std::errc{} && rest == end && port >= 1 && port <= 65535;
}

/// "host", "host:port", "[address]" or "[address]:port".
bool parse_place(const std::string& text, MqttUrl& url) {
  const std::size_t bracket = text.find(']');
  const bool is_address = !text.empty() && text.front() == '[';
  if (is_address && bracket == std::string::npos) return false;
  const std::size_t end = is_address ? bracket + 1 : text.find(':');
  url.host = is_address ? text.substr(1, bracket - 1) : text.substr(0, end);
  if (url.host.empty()) return false;
  if (end == std::string::npos || end == text.size()) return true;
  return text[end] == ':' && parse_port(text.substr(end + 1), url.port);
}

bool parse_user(const std::string& text, MqttUrl& url) {
  const std::size_t colon = text.find(':');
  const auto user = decoded(text.substr(0, colon));
  const auto password = decoded(colon == std::string::npos ? "" : text.substr(colon + 1));
  if (!user || !password || user->empty()) return false;
  url.user = *user;
  url.password = *password;
  return true;
}

bool parse_prefix(const std::string& text, MqttUrl& url) {
  const auto prefix = decoded(text);
  if (!prefix || prefix->find_first_of(std::string("+#\0", 3)) != std::string::npos) return false;
  const std::size_t last = prefix->find_last_not_of('/');
  if (last != std::string::npos) url.prefix = prefix->substr(0, last + 1);
  return true;
}

bool parse(std::string rest, MqttUrl& url) {
  url.has_tls = rest.rfind("mqtts://", 0) == 0;
  if (!url.has_tls && rest.rfind("mqtt://", 0) != 0) return false;
  if (url.has_tls) url.port = kTlsPort;
  rest.erase(0, rest.find("://") + 3);
  const std::size_t at = rest.rfind('@', rest.find('/'));
  if (at != std::string::npos) {
    if (!parse_user(rest.substr(0, at), url)) return false;
    rest.erase(0, at + 1);
  }
  const std::size_t slash = rest.find('/');
  if (slash != std::string::npos && !parse_prefix(rest.substr(slash + 1), url)) return false;
  return parse_place(rest.substr(0, slash), url);
}

}  // namespace

MqttUrl mqtt_url(const std::string& text) {
  MqttUrl url;
  if (parse(text, url)) return url;
  throw Error(fmt::format("'{}' must be mqtt://[user:password@]host[:port][/prefix], or mqtts://",
                          without_password(text)));
}

std::string broker_name(const MqttUrl& url) {
  const bool is_address = url.host.find(':') != std::string::npos;
  return fmt::format(fmt::runtime(is_address ? "[{}]:{}" : "{}:{}"), url.host, url.port);
}

std::string topic_level(const std::string& name) {
  std::string level = name;
  for (char& c : level) {
    if (c == '/' || c == '+' || c == '#' || std::iscntrl(static_cast<unsigned char>(c)) != 0)
      c = '_';
  }
  return level;
}

void check_reader_topics(const std::set<std::string>& readers, Diagnostics& diagnostics) {
  std::map<std::string, std::string> readers_of;
  for (const std::string& reader : readers) {
    const auto [other, is_new] = readers_of.emplace(topic_level(reader), reader);
    if (!is_new) {
      throw Error(
          fmt::format("--mqtt: readers '{}' and '{}' would have the same topic, …/reads/{}: "
                      "expected names that differ by more than '/', '+', '#' and '_'",
                      other->second, reader, other->first));
    }
    if (other->first == reader) continue;
    diagnostics.warn(
        fmt::format("--mqtt: the topic of reader '{}' is …/reads/{}, as topics can't "
                    "have '/', '+', '#' or control characters in a name",
                    reader, other->first));
  }
}

}  // namespace tagfield
